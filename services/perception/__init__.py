"""The perception process: where the object is, from the head camera's pictures."""
