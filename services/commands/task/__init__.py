"""`retouch task`: which tasks there are; a new one; what is missing in one, and where its robot stands best."""
