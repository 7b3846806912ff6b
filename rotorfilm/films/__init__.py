"""Film laws of journals and point contacts: pure, dimensionless physics; one law per file."""

from .arc_pressure import middle_pressure, tension
from .cavitation import Cavitation, Complementarity, FullFilm, HalfSommerfeld
from .complementarity_arc import ComplementarityArc
from .contact_checkerboard import checkerboard
from .contact_fluid import BarusViscosity, DowsonHigginsonDensity, RoelandsViscosity
from .contact_grid import ContactGrid
from .contact_loads import SineLoad, StepLoad
from .contact_scheme import StaggeredScheme, UpwindScheme
from .contact_state import ContactRun, ContactState
from .contact_steps import AdaptiveSteps, FixedSteps
from .extrapolated import ExtrapolatedFilm
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
    "AdaptiveSteps",
    "BarusViscosity",
    "Cavitation",
    "Complementarity",
    "ComplementarityArc",
    "ContactGrid",
    "ContactRun",
    "ContactState",
    "DowsonHigginsonDensity",
    "ExtrapolatedFilm",
    "FilmGeometry",
    "FilmLaw",
    "FixedArc",
    "FixedSteps",
    "FullFilm",
    "Groove",
    "HalfSommerfeld",
    "MapFilm",
    "MapTable",
    "Pad",
    "ReynoldsArc",
    "ReynoldsFilm",
    "RoelandsViscosity",
    "RotatingArc",
    "Rupture",
    "ShortFilm",
    "SineLoad",
    "SpectralArcFilm",
    "SplittingFilm",
    "StaggeredScheme",
    "StepLoad",
    "UpwindScheme",
    "checkerboard",
    "fit_map_table",
    "middle_pressure",
    "tabulate_film",
    "tension",
]
