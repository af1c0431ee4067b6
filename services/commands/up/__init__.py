"""`retouch up`: starts every process, watches over it, reports."""
