"""Journal film laws: pure, dimensionless physics; one law per file."""

from .arc_pressure import middle_pressure, tension
from .bush_heat import ApproximateShaft, ContactBalance, ExactShaft, GlobalBalance
from .bush_profile import LocalMelting, SharedMelting
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
from .groove_map import GroovedMapFilm
from .groove_table import GrooveMapTable
from .law import FilmLaw
from .map import MapFilm
from .map_fit import fit_map_table, tabulate_film
from .map_own import bearing_table
from .map_table import MapTable
from .reynolds import ReynoldsFilm
from .reynolds_arc import ReynoldsArc
from .rupture import FixedArc, RotatingArc, Rupture
from .short import ShortFilm
from .spectral import SpectralArcFilm
from .splitting import SplittingFilm
from .squeeze_laws import FiniteSqueeze, PublishedSqueeze, ShortSqueeze
from .squeeze_map import FiniteMapSqueeze, MapSqueeze

__all__ = [
    "AdaptiveSteps",
    "ApproximateShaft",
    "BarusViscosity",
    "Cavitation",
    "Complementarity",
    "ComplementarityArc",
    "ContactBalance",
    "ContactGrid",
    "ContactRun",
    "ContactState",
    "DowsonHigginsonDensity",
    "ExactShaft",
    "ExtrapolatedFilm",
    "FilmGeometry",
    "FilmLaw",
    "FiniteMapSqueeze",
    "FiniteSqueeze",
    "FixedArc",
    "FixedSteps",
    "FullFilm",
    "GlobalBalance",
    "Groove",
    "GrooveMapTable",
    "GroovedMapFilm",
    "HalfSommerfeld",
    "LocalMelting",
    "MapFilm",
    "MapSqueeze",
    "MapTable",
    "Pad",
    "PublishedSqueeze",
    "ReynoldsArc",
    "ReynoldsFilm",
    "RoelandsViscosity",
    "RotatingArc",
    "Rupture",
    "SharedMelting",
    "ShortFilm",
    "ShortSqueeze",
    "SineLoad",
    "SpectralArcFilm",
    "SplittingFilm",
    "StaggeredScheme",
    "StepLoad",
    "UpwindScheme",
    "bearing_table",
    "checkerboard",
    "fit_map_table",
    "middle_pressure",
    "tabulate_film",
    "tension",
]
