"""Rotors: what a bearing carries, as Dynamic models."""

from .profile import SpeedProfile
from .rigid import RigidRotor

__all__ = ["RigidRotor", "SpeedProfile"]
