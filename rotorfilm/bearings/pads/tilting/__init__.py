"""Tilting pads: bearings, pads at rest, and the coefficients that a journal feels."""
