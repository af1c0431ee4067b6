"""How a camera sees and where it is fixed, measured with a board of squares and markers."""
