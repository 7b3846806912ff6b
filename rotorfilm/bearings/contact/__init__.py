"""The lubricated contact of a rolling ball: film, law, motion."""

from typing import TYPE_CHECKING

from ...core.sources import show

if TYPE_CHECKING:
    from .ball_support import BallSupport as BallSupport, ball_transient as ball_transient
    from .contact_grid import (
        ContactGrid as ContactGrid,
        ContactScheme,
        StaggeredScheme as StaggeredScheme,
        UpwindScheme as UpwindScheme,
        checkerboard,
    )
    from .contact_law import ContactLaw as ContactLaw, require_state_space
    from .contact_steps import (
        AdaptiveSteps as AdaptiveSteps,
        ContactRun as ContactRun,
        ContactState as ContactState,
        FixedSteps as FixedSteps,
        SineLoad as SineLoad,
        StepLoad as StepLoad,
    )
    from .film_equations import (
        HIGGINSON_PRESSURE,
        BarusViscosity as BarusViscosity,
        DowsonHigginsonDensity as DowsonHigginsonDensity,
        RoelandsViscosity as RoelandsViscosity,
        roelands_viscosity,
    )
    from .point_contact import (
        ContactStiffness as ContactStiffness,
        MovingContact as MovingContact,
        PointContact as PointContact,
        RollingBall as RollingBall,
        dynamic_stiffness as dynamic_stiffness,
        moes_parameters,
        moving_contact as moving_contact,
        perturbed as perturbed,
    )
    from .reduction import (
        in_series,
        interpolate_contact as interpolate_contact,
        reduce_ball as reduce_ball,
        reduce_contact as reduce_contact,
    )
    from .stationary import HERTZ_LOAD, SmallMotion
else:
    show(__name__)
