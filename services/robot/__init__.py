"""The robot process: owns one arm, executes trajectories, merges corrections, and is the authority on safety."""
