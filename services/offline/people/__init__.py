"""People who are there without a browser: they sit at the page, lead by its devices, and press its buttons."""
