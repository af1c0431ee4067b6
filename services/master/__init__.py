"""The master process: owns one input device and renders the force locally, at the device's own rate."""
