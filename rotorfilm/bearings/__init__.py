"""Public bearing models: geometry, parameters and validation over a film law."""

from .film_state import FilmState, film_state
from .groove_map import build_groove_map
from .journal import JournalBearing

__all__ = ["FilmState", "JournalBearing", "build_groove_map", "film_state"]
