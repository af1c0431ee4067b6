"""The operator's page: what it shows, what comes from the browser."""
