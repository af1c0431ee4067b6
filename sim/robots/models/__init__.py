"""The robots that ship: a file each, whose `ROBOT` says all that is known of it."""
