"""Grooves."""
