"""The processes and what they share: bus, clock, runner, configuration, command line."""
