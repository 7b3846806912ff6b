"""Ball bearings by their dimensions: contacts, loads of the balls, stiffness in five degrees of freedom."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from ..ellipse import elliptic_integrals
    from .ball_bearing import BallBearing as BallBearing
    from .ball_degrees import MOST_PRESSURE
    from .ball_films import (
        ball_films as ball_films,
        film_parameter as film_parameter,
        race_films as race_films,
    )
    from .ball_law import (
        FRICTION_LIMITS,
        RaceControl as RaceControl,
        RunningBalls as RunningBalls,
        StaticBalls as StaticBalls,
    )
    from .ball_results import BallLoads as BallLoads, BallRest as BallRest
    from .bearing_pair import (
        BearingPair as BearingPair,
        back_to_back as back_to_back,
        face_to_face as face_to_face,
        tandem as tandem,
    )
    from .cage.five_degree_balls import FiveDegreeBalls as FiveDegreeBalls
    from .cage.turning_balls import TurningBalls as TurningBalls
    from .elliptic_contact import EllipticContact as EllipticContact
    from .film_damping import FilmDamping as FilmDamping, film_damping as film_damping
    from .load_zone import (
        load_integrals as load_integrals,
        palmgren_stiffness as palmgren_stiffness,
        stribeck_load as stribeck_load,
    )
    from .lubricated_balls import (
        LubricatedBalls as LubricatedBalls,
        lubricated_balls as lubricated_balls,
    )
    from .palmgren_balls import PalmgrenBalls as PalmgrenBalls
    from .race_film import RaceFilm as RaceFilm
    from .rolling_material import RollingMaterial as RollingMaterial
    from .tilting_balls import TiltingBalls as TiltingBalls
    from .waviness import Waviness as Waviness
else:
    show(__name__)
