"""Journal film laws: pure, dimensionless physics; one law per file."""

from .bush_heat import ApproximateShaft, ContactBalance, ExactShaft, GlobalBalance
from .bush_profile import LocalMelting, SharedMelting
from .cavitation import Cavitation, Complementarity, FullFilm, HalfSommerfeld
from .complementarity_arc import ComplementarityArc
from .geometry import FilmGeometry, Groove, Pad
from .law import FilmLaw
from .map import MapFilm
from .map_fit import fit_map_table, tabulate_film
from .map_table import MapTable
from .reynolds import ReynoldsFilm
from .reynolds_arc import ReynoldsArc
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm

__all__ = [
    "ApproximateShaft",
    "Cavitation",
    "Complementarity",
    "ComplementarityArc",
    "ContactBalance",
    "ExactShaft",
    "FilmGeometry",
    "FilmLaw",
    "FixedArc",
    "FullFilm",
    "GlobalBalance",
    "Groove",
    "HalfSommerfeld",
    "LocalMelting",
    "MapFilm",
    "MapTable",
    "Pad",
    "ReynoldsArc",
    "ReynoldsFilm",
    "RotatingArc",
    "Rupture",
    "SharedMelting",
    "ShortFilm",
    "SpectralArcFilm",
    "SplittingFilm",
    "fit_map_table",
    "tabulate_film",
]
