"""The thesis' analyses, made again with its method and with the default model, and a report of what came out."""
