"""Bearings: physics by family, and what all families share."""

from . import bush, contact, damper, journal
from .bush import *
from .contact import *
from .damper import *
from .films.cavitation import Cavitation, Complementarity, FullFilm, HalfSommerfeld
from .films.geometry import FilmGeometry, Groove, Pad
from .films.law import FilmLaw
from .films.map_fit import fit_map_table, tabulate_film
from .films.map_table import MapTable
from .journal import *
from .linear import LinearBearing
from .oil import Cooling, Oil
from .sprung import Sprung
from .tabulated import TabulatedBearing

__all__ = [
    "Cavitation",
    "Complementarity",
    "Cooling",
    "FilmGeometry",
    "FilmLaw",
    "FullFilm",
    "Groove",
    "HalfSommerfeld",
    "LinearBearing",
    "MapTable",
    "Oil",
    "Pad",
    "Sprung",
    "TabulatedBearing",
    "fit_map_table",
    "tabulate_film",
]
__all__ += bush.__all__
__all__ += contact.__all__
__all__ += damper.__all__
__all__ += journal.__all__
