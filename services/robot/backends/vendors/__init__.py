"""Whose hardware can be driven: one file a maker, with a class `Driver`, by whose name a configuration calls it."""
