"""Ball bearings by their dimensions in scene files."""
