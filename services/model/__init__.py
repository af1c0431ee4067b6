"""The model process: owns the learnt model; what it has acknowledged is on disk."""
