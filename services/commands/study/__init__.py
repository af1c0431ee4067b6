"""`retouch study`: the human-factors study, a part a file."""
