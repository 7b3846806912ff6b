"""Ball bearings by their dimensions: contacts, loads of the balls, stiffness in five degrees of freedom."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from ..formulas import elliptic_integrals
    from .ball_bearing import (
        BallBearing as BallBearing,
        BearingPair as BearingPair,
        RollingMaterial as RollingMaterial,
        Waviness as Waviness,
        back_to_back as back_to_back,
        face_to_face as face_to_face,
        tandem as tandem,
    )
    from .ball_element import (
        FRICTION_LIMITS,
        MOST_PRESSURE,
        BallEquilibrium as BallEquilibrium,
        BallLoads as BallLoads,
        EllipticContact as EllipticContact,
        RaceControl as RaceControl,
        RunningBalls as RunningBalls,
        StaticBalls as StaticBalls,
    )
    from .lubricated_balls import (
        FilmDamping as FilmDamping,
        LubricatedBalls as LubricatedBalls,
        RaceFilm as RaceFilm,
        ball_films as ball_films,
        film_damping as film_damping,
        film_parameter as film_parameter,
        lubricated_balls as lubricated_balls,
        race_films as race_films,
    )
    from .moment_carrying_balls import (
        BALL_FREEDOMS as BALL_FREEDOMS,
        MomentCarryingBalls as MomentCarryingBalls,
        VariableComplianceBalls as VariableComplianceBalls,
    )
    from .palmgren_balls import (
        PalmgrenBalls as PalmgrenBalls,
        load_integrals as load_integrals,
        palmgren_stiffness as palmgren_stiffness,
        stribeck_load as stribeck_load,
    )
else:
    show(__name__)
