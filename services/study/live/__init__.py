"""Live trials: people, or whoever rehearses, teach the simulated robot, in processes of their own for each part."""
