"""Questions about bearings made of pads."""
