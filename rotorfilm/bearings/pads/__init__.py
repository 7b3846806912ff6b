"""Bearings made of pads: fixed ones, lobes and offset halves, and tilting ones."""
