"""Bearings of pads, each with its own center of curvature."""
