"""Transient."""
