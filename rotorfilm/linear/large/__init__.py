"""Rotors of many elements: banded matrices, and the shapes that a range of frequencies needs."""
