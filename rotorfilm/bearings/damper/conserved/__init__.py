"""Squeeze-film dampers whose film conserves its oil, with real supply."""
