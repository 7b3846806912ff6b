"""Journal film laws: pure, dimensionless physics; one law per file."""

from .complementarity_arc import ComplementarityArc
from .law import FilmLaw
from .map import MapFilm
from .map_fit import fit_map_table, tabulate_film
from .map_table import MapTable
from .reynolds_arc import ReynoldsArc
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm

__all__ = [
    "ComplementarityArc",
    "FilmLaw",
    "FixedArc",
    "MapFilm",
    "MapTable",
    "ReynoldsArc",
    "RotatingArc",
    "Rupture",
    "ShortFilm",
    "SpectralArcFilm",
    "SplittingFilm",
    "fit_map_table",
    "tabulate_film",
]
