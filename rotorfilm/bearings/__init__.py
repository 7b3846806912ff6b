"""Public bearing models: geometry, parameters and validation over a film law."""

from .film_state import FilmState, film_state
from .journal import JournalBearing

__all__ = ["FilmState", "JournalBearing", "film_state"]
