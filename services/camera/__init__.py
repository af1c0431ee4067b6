"""The camera process: head and wrist pictures, drawn from the published state of the simulated world."""
