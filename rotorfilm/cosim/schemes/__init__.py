"""Schemes that couple a rotor and its bearings over macro steps."""
