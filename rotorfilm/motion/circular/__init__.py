"""Synchronous circular orbits of a rotor in a damper, in closed form."""
