"""Journal film laws: pure, dimensionless physics; one law per file."""

from .law import FilmLaw
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm

__all__ = ["FilmLaw", "FixedArc", "RotatingArc", "Rupture", "ShortFilm", "SpectralArcFilm", "SplittingFilm"]
