"""Reduction: the same rotor in fewer coordinates, with the error that this makes."""

from .rotor import Reduction, reduce_rotor

__all__ = ["Reduction", "reduce_rotor"]
