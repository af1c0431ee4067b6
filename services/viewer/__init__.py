"""The viewer process: the only Rerun logger; live view and .rrd recording."""
