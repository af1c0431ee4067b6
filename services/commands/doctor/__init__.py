"""`retouch doctor`: what is wrong between two machines, in one line each, and what to do."""
