"""The station process: the operator's page and the teaching workflow (Algorithm 1)."""
