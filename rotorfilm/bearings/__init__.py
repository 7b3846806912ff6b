"""Bearings: physics by family, and what all families share."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .at_frequency import (
        MemoryCoefficients as MemoryCoefficients,
        ReducedCoefficients as ReducedCoefficients,
    )
    from .bush import *
    from .contact import *
    from .damper import *
    from .films.cavitation import (
        Cavitation,
        Complementarity,
        FullFilm as FullFilm,
        HalfSommerfeld as HalfSommerfeld,
    )
    from .films.film_start import (
        FilmStart,
        FreeStart as FreeStart,
        HeldLine as HeldLine,
        WidestGap as WidestGap,
    )
    from .films.geometry import FeedHole as FeedHole, FilmGeometry, Groove as Groove, Pad as Pad
    from .films.law import FilmLaw as FilmLaw
    from .films.map_fit import fit_map_table, tabulate_film
    from .films.map_table import MapTable as MapTable
    from .inertial_model import InertialCoefficients as InertialCoefficients
    from .journal import *
    from .linear import LinearBearing as LinearBearing
    from .oil import Cooling as Cooling, Oil as Oil
    from .own_reaction import OwnReaction as OwnReaction, as_reaction as as_reaction
    from .pads import *
    from .parallel import ParallelReaction as ParallelReaction
    from .rolling import *
    from .rub import *
    from .seal import *
    from .sprung import Sprung as Sprung
    from .tabulated import TabulatedBearing as TabulatedBearing
else:
    show(__name__)
