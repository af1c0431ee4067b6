"""What is kept on disk: demonstrations and fitted models."""
