"""Damper."""
