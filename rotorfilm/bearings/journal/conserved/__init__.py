"""A journal bearing whose film conserves its oil, with real supply."""
