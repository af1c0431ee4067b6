"""The simulated world: assembled, staged, moved by physics, looked at by cameras."""
