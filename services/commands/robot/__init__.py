"""`retouch robot`: the process that owns the arm; which robots there are, what is missing in one, how it looks."""
