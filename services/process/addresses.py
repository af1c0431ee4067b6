"""Host names: which of them mean this machine only, and which every address of it."""

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})

EVERYWHERE = frozenset({"0.0.0.0", "::"})
"""A server that listens there is reached under every name and address of its machine."""
