"""Questions about ball bearings by their dimensions."""
