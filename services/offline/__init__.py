"""The whole pipeline in one process, as fast as it goes: to teach many conditions, and to see what that changed."""
