"""Shaft."""
