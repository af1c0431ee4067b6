"""The page's own 3-D view: what the browser loads once, and what it is told afterwards."""
