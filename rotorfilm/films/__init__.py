"""Journal film laws: pure, dimensionless physics; one law per file."""

from .cavitation import Cavitation, Complementarity, FullFilm, HalfSommerfeld
from .geometry import FilmGeometry, Groove, Pad
from .law import FilmLaw
from .reynolds import ReynoldsFilm
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm

__all__ = [
    "Cavitation",
    "Complementarity",
    "FilmGeometry",
    "FilmLaw",
    "FixedArc",
    "FullFilm",
    "Groove",
    "HalfSommerfeld",
    "Pad",
    "ReynoldsFilm",
    "RotatingArc",
    "Rupture",
    "ShortFilm",
    "SpectralArcFilm",
    "SplittingFilm",
]
