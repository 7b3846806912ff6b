"""Rotors in modes on films: what drives the loops of the C library over them."""
