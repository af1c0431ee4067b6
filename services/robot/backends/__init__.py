"""What moves: one file a backend, behind one small protocol."""
