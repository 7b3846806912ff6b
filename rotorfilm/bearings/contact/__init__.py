"""The lubricated contact of a rolling ball: film, law, motion."""

from .ball_support import BallSupport
from .contact_law import ContactLaw
from .film.checkerboard import checkerboard
from .film.contact_grid import ContactGrid
from .film.contact_scheme import ContactScheme, StaggeredScheme, UpwindScheme
from .film.pressure_fluid import HIGGINSON_PRESSURE, BarusViscosity, DowsonHigginsonDensity, RoelandsViscosity
from .film.small_motion import SmallMotion
from .film.stationary import HERTZ_LOAD
from .film_formulas import moes_parameters
from .motion.contact_state import ContactRun, ContactState
from .motion.contact_steps import AdaptiveSteps, FixedSteps
from .motion.loads import SineLoad, StepLoad
from .moving_contact import MovingContact, moving_contact
from .point_contact import PointContact, perturbed
from .reduction import interpolate_contact, reduce_ball, reduce_contact
from .ride import ride
from .rolling_ball import RollingBall

__all__ = [
    "HERTZ_LOAD",
    "HIGGINSON_PRESSURE",
    "AdaptiveSteps",
    "BallSupport",
    "BarusViscosity",
    "ContactGrid",
    "ContactLaw",
    "ContactRun",
    "ContactScheme",
    "ContactState",
    "DowsonHigginsonDensity",
    "FixedSteps",
    "MovingContact",
    "PointContact",
    "RoelandsViscosity",
    "RollingBall",
    "SineLoad",
    "SmallMotion",
    "StaggeredScheme",
    "StepLoad",
    "UpwindScheme",
    "checkerboard",
    "interpolate_contact",
    "moes_parameters",
    "moving_contact",
    "perturbed",
    "reduce_ball",
    "reduce_contact",
    "ride",
]
