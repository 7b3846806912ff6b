"""Public bearing models: geometry, parameters and validation over a film law."""

from .journal import JournalBearing

__all__ = ["JournalBearing"]
