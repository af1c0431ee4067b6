"""`retouch camera`: the process that publishes pictures; which cameras there are, and how they are calibrated."""
