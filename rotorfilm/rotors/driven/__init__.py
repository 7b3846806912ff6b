"""Rotors that a torque drives."""
