"""The simulated robot's description, made from packages that are installed."""
