"""Learning from demonstration: the mathematics. Arrays in, arrays out; no process, no message, no clock."""
