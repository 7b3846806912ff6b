"""Public bearing models: geometry, parameters and validation over a film law."""

from .contact import PointContact, perturbed
from .contact_law import ContactLaw, reduce_ball, reduce_contact
from .film_state import FilmState, film_state
from .journal import JournalBearing
from .ride import ride
from .rolling_ball import RollingBall

__all__ = [
    "ContactLaw",
    "FilmState",
    "JournalBearing",
    "PointContact",
    "RollingBall",
    "film_state",
    "perturbed",
    "reduce_ball",
    "reduce_contact",
    "ride",
]
