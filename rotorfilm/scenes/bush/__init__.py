"""Scenes of bushes: table, runs, remarks."""
