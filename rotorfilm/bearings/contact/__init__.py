"""The lubricated contact of a rolling ball: film, law, motion."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .ball_support import BallSupport as BallSupport
    from .contact_law import ContactLaw as ContactLaw, require_state_space
    from .contact_stiffness import (
        ContactStiffness as ContactStiffness,
        dynamic_stiffness as dynamic_stiffness,
    )
    from .film.checkerboard import checkerboard
    from .film.contact_grid import ContactGrid as ContactGrid
    from .film.contact_scheme import (
        ContactScheme,
        StaggeredScheme as StaggeredScheme,
        UpwindScheme as UpwindScheme,
    )
    from .film.pressure_fluid import (
        HIGGINSON_PRESSURE,
        BarusViscosity as BarusViscosity,
        DowsonHigginsonDensity as DowsonHigginsonDensity,
        RoelandsViscosity as RoelandsViscosity,
        roelands_viscosity,
    )
    from .film.small_motion import SmallMotion
    from .film.stationary import HERTZ_LOAD
    from .film_formulas import moes_parameters
    from .motion.contact_state import ContactRun as ContactRun, ContactState as ContactState
    from .motion.contact_steps import AdaptiveSteps as AdaptiveSteps, FixedSteps as FixedSteps
    from .motion.loads import SineLoad as SineLoad, StepLoad as StepLoad
    from .moving_contact import MovingContact as MovingContact, moving_contact as moving_contact
    from .point_contact import PointContact as PointContact, perturbed as perturbed
    from .reduction import (
        in_series,
        interpolate_contact as interpolate_contact,
        reduce_ball as reduce_ball,
        reduce_contact as reduce_contact,
    )
    from .ride import ride as ride
    from .rolling_ball import RollingBall as RollingBall
else:
    show(__name__)
