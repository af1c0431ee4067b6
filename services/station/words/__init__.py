"""Every word that a person reads at the station."""
