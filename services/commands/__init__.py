"""The commands of `retouch`, one file each."""
