"""The human-factors study: run it, resume it, analyse it, publish it."""
