"""Who is who on a network: an authority of one's own, and a certificate for each process, router and person."""
