"""The bus: what every process sees of the transport, in memory and over Zenoh."""
