"""Periodic orbits: harmonic balance, continuation, stability, basins."""
