"""Input devices: one file each, behind one small protocol."""
