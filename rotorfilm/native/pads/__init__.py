"""Bearings of tilting pads in compiled code."""
