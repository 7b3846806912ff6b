"""Rotors whose shaft is cracked."""
