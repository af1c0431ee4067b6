"""The default model: a trend, what it does not explain, and corrections that act as far as they surprise."""
