"""What stands in for the world: robot and scene in MuJoCo, cameras, haptic stylus, the operator's hand."""
