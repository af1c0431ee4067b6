"""What happened at a robot, written where nobody can change a line of it unnoticed."""
