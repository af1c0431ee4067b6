"""The teaching workflow (Algorithm 1): a pure function of state and view."""
