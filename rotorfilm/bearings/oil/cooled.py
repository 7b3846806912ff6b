"""What of a bearing its heat follows from."""

from __future__ import annotations

from typing import Any, Protocol, runtime_checkable

from numpy.typing import ArrayLike

from ...model import Array
from ...native.loss_kernels import LossKernel
from ...signals import Signal
from ..film_units import Size
from ..films.kernel_film import BoundKernel
from .cooling import Cooling
from .heat_balance import FilmHeat
from .oil import Oil


@runtime_checkable
class Cooled(Size, Protocol):
    """What a bearing with an oil and cooling offers, as `JournalBearing` and `LobedBearing` do."""

    @property
    def cooled(self) -> tuple[Oil, Cooling]:
        """Its oil and what cools it."""

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y."""

    def at_temperature(self, temperature: float) -> Any:
        """Return the bearing with a film of one temperature [K]."""

    def film_heat(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> FilmHeat:
        """Return the heat that the film makes and takes along at one state."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one temperature, (3, 5)."""

    def film_at_unit_viscosity(self) -> tuple[BoundKernel, LossKernel] | None:
        """Return its compiled film at 1 Pa s with its losses; None if there is none."""
