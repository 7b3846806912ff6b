"""Transient motion: rotor and film integrated as one system."""

from .simulate import simulate

__all__ = ["simulate"]
