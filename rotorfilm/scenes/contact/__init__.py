"""Scenes of rolling contacts: table, motions, remarks."""
