"""Models that learn motions over a condition; `model.py` is the seam."""
