"""Scenes of dampers: table, films, runs, remarks."""
