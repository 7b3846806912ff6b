"""Scenes of flexible rotors: table, export, remarks."""
