"""Flexible rotors: elements, assembly, reduction."""
