"""Bearings: physics by family, and what all families share."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from ..core.results import (
        FrequencyDependentCoefficients as FrequencyDependentCoefficients,
        InertialCoefficients as InertialCoefficients,
        ReducedCoefficients as ReducedCoefficients,
    )
    from ..core.sources import show
    from .assemblies import Parallel as Parallel, with_springs as with_springs
    from .bush import *
    from .contact import *
    from .damper import *
    from .films.geometry import (
        AlignedOpenings,
        Cavitation,
        Complementarity,
        FeedHole as FeedHole,
        FilmGeometry,
        FilmOnset,
        FixedOnset as FixedOnset,
        FreeOnset as FreeOnset,
        FullFilm as FullFilm,
        Groove as Groove,
        HalfSommerfeld as HalfSommerfeld,
        MaximumGapOnset as MaximumGapOnset,
        Pad as Pad,
        Pocket,
        aligned_openings,
    )
    from .films.law import FilmLaw as FilmLaw, FilmOptions, gap_shear, options, static_rate
    from .films.map_fit import fit_map_table, tabulate_film
    from .films.map_table import MapTable as MapTable
    from .films.mobility import Mobility, mobility_of
    from .films.turbulence import Turbulence
    from .journal import *
    from .linear import LinearBearing as LinearBearing, TabulatedBearing as TabulatedBearing
    from .linear_system import FrequencyDependentReaction as FrequencyDependentReaction
    from .oil import Cooling as Cooling, Oil as Oil
    from .own_reaction import OwnReaction as OwnReaction, as_reaction as as_reaction
    from .pads import *
    from .rolling import *
    from .rub import RubContact as RubContact, RubRing as RubRing
    from .seal import AnnularSeal as AnnularSeal, HirsFriction as HirsFriction, SealFlow as SealFlow
    from .series import Body as Body, Series as Series
    from .thrust import *
else:
    show(__name__)
