"""The way in where others reach the page: who somebody is, shown by a password, and for how long that counts."""
