"""Scenes of journal bearings: films, remarks, candidates."""
