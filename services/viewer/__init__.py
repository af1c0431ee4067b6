"""The viewer process: the only Rerun logger; its page, to inspect everything on, and .rrd recordings."""
