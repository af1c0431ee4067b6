"""The human-factors study: people, methods, measurements, and what they come to."""
