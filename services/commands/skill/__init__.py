"""`retouch skill`: what a robot has learnt, by name."""
