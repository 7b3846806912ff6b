"""Journal bearings: geometry, film laws, maps, and how a film ruptures."""

from .arc_pressure import middle_pressure, tension
from .bearing import JournalBearing
from .bearing_losses import bearing_losses, has_losses
from .build_groove_map import build_groove_map
from .extrapolated_film import ExtrapolatedFilm
from .film_state import FilmState, film_state
from .grooves.groove_table import GrooveMapTable
from .grooves.grooved_film import GroovedMapFilm
from .grooves.openings import is_mappable
from .heat.balanced_bearing import BalancedBearing
from .heat.field.energy_film import MeanTemperature
from .heat.field.heated_film import HeatedFilm
from .heat.field.heated_state import HeatAccount, HeatedState
from .heat.field.layers_film import LayeredTemperature
from .heat.field.walls import AdiabaticWalls, BushRing, HeldWalls, Walls
from .heat.heated_bearing import HeatedBearing
from .map.map_film import MapFilm
from .map.own_tables import bearing_table
from .reynolds_film import ReynoldsFilm
from .rupture.complementarity_arc import ComplementarityArc
from .rupture.reynolds_arc import ReynoldsArc
from .rupture.rupture import FixedArc, RotatingArc, Rupture
from .short_film import ShortFilm
from .splitting.spectral_film import SpectralArcFilm
from .splitting.splitting_film import SplittingFilm

__all__ = [
    "AdiabaticWalls",
    "BalancedBearing",
    "BushRing",
    "ComplementarityArc",
    "ExtrapolatedFilm",
    "FilmState",
    "FixedArc",
    "GrooveMapTable",
    "GroovedMapFilm",
    "HeatAccount",
    "HeatedBearing",
    "HeatedFilm",
    "HeatedState",
    "HeldWalls",
    "JournalBearing",
    "LayeredTemperature",
    "MapFilm",
    "MeanTemperature",
    "ReynoldsArc",
    "ReynoldsFilm",
    "RotatingArc",
    "Rupture",
    "ShortFilm",
    "SpectralArcFilm",
    "SplittingFilm",
    "Walls",
    "bearing_losses",
    "bearing_table",
    "build_groove_map",
    "film_state",
    "has_losses",
    "is_mappable",
    "middle_pressure",
    "tension",
]
