"""The participant's page and the experimenter's console."""
