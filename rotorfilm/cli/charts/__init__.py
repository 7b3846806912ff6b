"""The commands `rotorfilm chart ...`."""
