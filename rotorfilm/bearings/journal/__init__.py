"""Journal bearings: geometry, film laws, maps, and how a film ruptures."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from ..films.geometry import is_mappable
    from ..formulas import extrapolated_value
    from ..oil.heated_bearing import HeatedBearing as HeatedBearing, heat_surplus
    from .bearing import (
        BalancedBearing as BalancedBearing,
        HeatNumbers as HeatNumbers,
        JournalBearing as JournalBearing,
        film_name,
        fitted_bearing,
        has_losses,
        heat_numbers as heat_numbers,
    )
    from .build_groove_map import build_groove_map as build_groove_map
    from .complementarity import ComplementarityArc as ComplementarityArc
    from .energy_equation import (
        AdiabaticWalls as AdiabaticWalls,
        BushRing as BushRing,
        FilmProfile,
        HeatAccount,
        HeldWalls as HeldWalls,
        LayeredTemperature as LayeredTemperature,
        MeanTemperature as MeanTemperature,
        Walls,
    )
    from .film_state import FilmState, film_state as film_state, middle_pressure, tension
    from .full_stress import full_stress_forces
    from .groove_map import GrooveMapTable as GrooveMapTable
    from .grooved_film import GroovedMapFilm as GroovedMapFilm
    from .heated_film import (
        HeatedFilm as HeatedFilm,
        HeatedJFOFilm as HeatedJFOFilm,
        HeatedJFOState as HeatedJFOState,
        HeatedState as HeatedState,
    )
    from .held_tilt import HeldTilt as HeldTilt
    from .jfo_film import (
        RUPTURE_CELLS,
        JFOFilm as JFOFilm,
        JFOState as JFOState,
        MomentCarryingJFOFilm as MomentCarryingJFOFilm,
        RuptureError as RuptureError,
        both_films,
        rupture_error as rupture_error,
        tilts,
    )
    from .map_film import MapFilm as MapFilm, bearing_table
    from .mobile_map import MobileMapFilm, MobileMapTable
    from .moment_carrying_journal import (
        USUAL_CORRECTION,
        MomentCarryingJournal as MomentCarryingJournal,
        TiltEstimate as TiltEstimate,
        TiltLevel as TiltLevel,
        is_mapped,
    )
    from .reynolds_film import (
        ExtrapolatedFilm as ExtrapolatedFilm,
        ReynoldsFilm as ReynoldsFilm,
        ShortFilm as ShortFilm,
    )
    from .rupture import (
        FixedArc as FixedArc,
        ReynoldsArc as ReynoldsArc,
        RotatingArc as RotatingArc,
        Rupture,
        SlitArc as SlitArc,
    )
    from .splitting_film import SpectralArcFilm as SpectralArcFilm, SplittingFilm as SplittingFilm
    from .tilt_map import has_tilt_map
else:
    show(__name__)
