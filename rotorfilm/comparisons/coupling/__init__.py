"""Coupling schemes beside the monolithic solution."""
