"""Motions as values, and what is done with them: sampled anew, aligned, refined, taught by waypoints."""
