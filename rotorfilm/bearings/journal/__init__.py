"""Journal bearings: geometry, film laws, maps, and how a film ruptures."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from ..differences import extrapolated_value
    from ..oil.heat_balance import heat_surplus
    from ..oil.heated_bearing import HeatedBearing as HeatedBearing
    from .arc_pressure import middle_pressure, tension
    from .bearing import JournalBearing as JournalBearing, fitted_bearing
    from .bearing_losses import bearing_losses, has_losses
    from .build_groove_map import build_groove_map as build_groove_map
    from .conserved.heated_jfo import HeatedJFOFilm as HeatedJFOFilm, HeatedJFOState as HeatedJFOState
    from .conserved.jfo_film import JFOFilm as JFOFilm
    from .conserved.jfo_state import JFOState as JFOState
    from .conserved.rupture_error import (
        RUPTURE_CELLS,
        RuptureError as RuptureError,
        both_films,
        rupture_error as rupture_error,
    )
    from .extrapolated_film import ExtrapolatedFilm as ExtrapolatedFilm
    from .film_state import FilmState, film_state as film_state
    from .fitting import film_name
    from .grooves.groove_table import GrooveMapTable as GrooveMapTable
    from .grooves.grooved_film import GroovedMapFilm as GroovedMapFilm
    from .grooves.openings import is_mappable
    from .heat.balanced_bearing import BalancedBearing as BalancedBearing
    from .heat.field.energy_film import MeanTemperature as MeanTemperature
    from .heat.field.heat_rounds import FilmProfile
    from .heat.field.heated_film import HeatedFilm as HeatedFilm
    from .heat.field.heated_state import HeatAccount, HeatedState as HeatedState
    from .heat.field.layers_film import LayeredTemperature as LayeredTemperature
    from .heat.field.walls import (
        AdiabaticWalls as AdiabaticWalls,
        BushRing as BushRing,
        HeldWalls as HeldWalls,
        Walls,
    )
    from .heat.heat_numbers import HeatNumbers as HeatNumbers, heat_numbers as heat_numbers
    from .map.map_film import MapFilm as MapFilm
    from .map.own_tables import bearing_table
    from .reynolds_film import ReynoldsFilm as ReynoldsFilm
    from .rupture.complementarity_arc import ComplementarityArc as ComplementarityArc
    from .rupture.reynolds_arc import ReynoldsArc as ReynoldsArc
    from .rupture.rupture import FixedArc as FixedArc, RotatingArc as RotatingArc, Rupture
    from .rupture.slit_arc import SlitArc as SlitArc
    from .short_film import ShortFilm as ShortFilm
    from .splitting.spectral_film import SpectralArcFilm as SpectralArcFilm
    from .splitting.splitting_film import SplittingFilm as SplittingFilm
else:
    show(__name__)
