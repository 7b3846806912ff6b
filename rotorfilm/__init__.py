"""Bearing reactions for rotor dynamics, handed to any simulator."""
