"""Participants who are simulated: marked as such in every row, file and figure."""
