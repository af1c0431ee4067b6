"""Where a model succeeds, before and after a correction."""
