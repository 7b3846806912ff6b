"""Scenes of bearings made of pads: tables, candidates, remarks."""
