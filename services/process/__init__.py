"""What every process needs: clock, configuration, the step loop, failures."""
