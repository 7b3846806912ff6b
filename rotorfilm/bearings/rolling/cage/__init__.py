"""Ball bearings whose cage turns, and all five degrees of freedom as a model."""

from typing import TYPE_CHECKING

from ....sources import show

if TYPE_CHECKING:
    from .five_degree_balls import FiveDegreeBalls as FiveDegreeBalls
    from .turning_balls import TurningBalls as TurningBalls
else:
    show(__name__)
