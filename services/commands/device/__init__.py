"""`retouch device`: which input devices there are, what they say, and how they are measured."""
