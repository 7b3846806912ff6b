"""Ball bearings by their dimensions: contacts, loads of the balls, stiffness in five degrees of freedom."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from ..formulas import elliptic_integrals
    from .ball_bearing import (
        BallBearing as BallBearing,
        RollingMaterial as RollingMaterial,
        Waviness as Waviness,
    )
    from .ball_cage import FiveDegreeBalls as FiveDegreeBalls, TurningBalls as TurningBalls
    from .ball_element import (
        FRICTION_LIMITS,
        MOST_PRESSURE,
        BallLoads as BallLoads,
        BallRest as BallRest,
        EllipticContact as EllipticContact,
        RaceControl as RaceControl,
        RunningBalls as RunningBalls,
        StaticBalls as StaticBalls,
    )
    from .bearing_pair import (
        BearingPair as BearingPair,
        TiltingBalls as TiltingBalls,
        back_to_back as back_to_back,
        face_to_face as face_to_face,
        tandem as tandem,
    )
    from .lubricated_balls import (
        FilmDamping as FilmDamping,
        LubricatedBalls as LubricatedBalls,
        film_damping as film_damping,
        lubricated_balls as lubricated_balls,
    )
    from .palmgren_balls import (
        PalmgrenBalls as PalmgrenBalls,
        load_integrals as load_integrals,
        palmgren_stiffness as palmgren_stiffness,
        stribeck_load as stribeck_load,
    )
    from .race_film import (
        RaceFilm as RaceFilm,
        ball_films as ball_films,
        film_parameter as film_parameter,
        race_films as race_films,
    )
else:
    show(__name__)
