"""What every page is served with: guard, files, server, look."""
