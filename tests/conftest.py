"""What holds for all tests."""

from hypothesis import settings

# Few examples, always the same ones: the unmarked tests are to take seconds, and a failure is to come again.
settings.register_profile("quick", max_examples=20, deadline=None, derandomize=True)
settings.load_profile("quick")
