"""The simulated operator: a hand on a stylus that corrects as people do."""
