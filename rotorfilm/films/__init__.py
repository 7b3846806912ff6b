"""Journal film laws: pure, dimensionless physics; one law per file."""

from .complementarity_arc import ComplementarityArc
from .law import FilmLaw
from .reynolds_arc import ReynoldsArc
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm

__all__ = [
    "ComplementarityArc",
    "FilmLaw",
    "FixedArc",
    "ReynoldsArc",
    "RotatingArc",
    "Rupture",
    "ShortFilm",
    "SpectralArcFilm",
    "SplittingFilm",
]
