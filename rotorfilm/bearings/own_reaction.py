"""A bearing of the user's own: a function of places, rates and speed as a Reaction, for any freedoms."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, brief, require_each, require_inside, require_positive, shortened
from ..core.inputs import arguments, quantities
from ..core.model import Array
from ..core.port import Force
from ..core.signals import FREEDOMS, PLANAR, checked_freedoms, place_names
from .formulas import differences
from .reaction import NOMINAL_SPEED, StaticReaction, broadcast_state

RELATIVE_STEP = 2.0**-8
"""Largest step of differences, relative to the scale of what is moved."""

LARGEST_RELATIVE_STEP = 0.25

LARGEST_ANGLE = 1e-3
"""Scale of tilts [rad], where none is given."""

Law = Callable[..., Any]


@quantities
@dataclass(frozen=True, kw_only=True)
class OwnReaction(StaticReaction):
    """A bearing whose force is a function of the user; `as_reaction` makes it.

    Parameters
    ----------
    law : callable
        The `force` of `as_reaction`.
    slopes : callable or None
        The `jacobian` of `as_reaction`.
    clearance : float [m]
        Radial clearance.
    name : str
        Name in messages and of its FMU.
    nominal_force : float [N]
        Typical force, for nominal values of signals.
    vectorized : bool
        Whether the functions take arrays.
    relative_step : float [1]
        Largest step of the differences.
    freedoms : tuple of str
        Motions of the shaft that it reacts to.
    largest_angle : float [rad]
        Scale of tilts, as the clearance is of lengths.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """

    law: Law
    clearance: float
    name: str
    nominal_force: float
    slopes: Law | None = None
    vectorized: bool = False
    relative_step: float = RELATIVE_STEP
    freedoms: tuple[str, ...] = PLANAR
    largest_angle: float = LARGEST_ANGLE

    def __post_init__(self) -> None:
        object.__setattr__(self, "freedoms", checked_freedoms(self.freedoms))
        taken = [*place_names(self.freedoms), "speed"]
        for argument, function in (("force", self.law), ("jacobian", self.slopes)):
            if not (callable(function) or (argument == "jacobian" and function is None)):
                raise InputError(
                    f"{argument} must be a function of ({', '.join(taken)}), got {brief(function)}"
                )
            _require_taking(argument, function, taken)
        require_each(self, require_positive, "clearance", "nominal_force", "relative_step", "largest_angle")
        if self.relative_step > LARGEST_RELATIVE_STEP:
            raise InputError(
                f"relative_step must be at most {LARGEST_RELATIVE_STEP}, got {self.relative_step!r}"
            )
        if not (isinstance(self.name, str) and self.name.isidentifier()):
            raise InputError(f"name must be an identifier such as 'gas_bearing', got {brief(self.name)}")

    @property
    def component(self) -> str:
        """Name of the component in its FMU."""
        return self.name

    def prepare(self) -> Force:
        """Return the force as a function of plain numbers; see `StaticReaction.prepare`."""
        radial, shape = self._radial, (len(self.freedoms),)

        def force(*state: float) -> Any:
            if not math.hypot(*(state[k] for k in radial)) < self.clearance:
                self.require_film(np.array(state[: shape[0]]))
            return tuple(self._values(self.law, np.array(state), shape).tolist())

        return force

    @property
    def arm(self) -> float:
        """Length that converts angles to displacements: clearance / largest angle [m]."""
        return self.clearance / self.largest_angle

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError unless x and y, as far as they are freedoms, are within the clearance."""
        way = np.hypot.reduce(position[self._radial])
        require_inside(np.stack([way, np.zeros_like(way)]), self.clearance)

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        return self._values(self.law, _state(position, velocity, speed), (len(self.freedoms),))

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        state = _state(position, velocity, speed)
        return self._differences(state)[0] if self.slopes is None else self._given(self.slopes, state)

    def jacobian_error(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the error of `jacobian`, in its units, shape (n, 2 n + 1, ...).

        For differences this is an estimate; for a given `jacobian` it is the distance from differences.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.

        Raises
        ------
        InputError, FilmContactError
            As in `force`.
        """
        q, v, omega = broadcast_state(position, velocity, speed, len(self.freedoms))
        self.require_film(q)
        state = _state(q, v, omega)
        slopes, error = self._differences(state)
        return error if self.slopes is None else np.abs(self._given(self.slopes, state) - slopes)

    def _differences(self, state: Array) -> tuple[Array, Array]:
        shape = (len(self.freedoms),)
        return differences(lambda moved: self._values(self.law, moved, shape), state, self._steps(state))

    @cached_property
    def _radial(self) -> list[int]:
        """Which of the freedoms are x and y."""
        return [k for k, name in enumerate(self.freedoms) if name in PLANAR]

    @cached_property
    def scales(self) -> Array:
        """The clearance of lengths, the largest angle of angles, shape (n,)."""
        turns = [FREEDOMS[name].turns for name in self.freedoms]
        return np.where(turns, self.largest_angle, self.clearance)

    def _steps(self, state: Array) -> Array:
        """Return the largest steps: of the gap that is left, and of the speed and the rate of motion."""
        n = len(self.freedoms)
        scales = self.scales.reshape(n, *(1,) * (state.ndim - 1))
        places = scales + np.zeros_like(state[:n])
        places[self._radial] -= np.hypot.reduce(state[self._radial])
        rates = np.hypot.reduce(state[n : 2 * n] * (self.clearance / scales))
        pace = np.abs(state[-1]) + rates / self.clearance
        pace = np.where(pace > 0.0, pace, NOMINAL_SPEED)
        return self.relative_step * np.concatenate([places, scales * pace, pace[None]])

    def _given(self, slopes: Law, state: Array) -> Array:
        return self._values(slopes, state, (len(self.freedoms), len(state)))

    def _values(self, function: Law, state: Array, shape: tuple[int, ...]) -> Array:
        """Return what a function of the user gives for states (2 n + 1, ...), shape (*shape, ...)."""
        batch = state.shape[1:]
        if self.vectorized and batch:
            return self._checked(function(*state), shape, batch)
        columns = state.reshape(len(state), -1).T.tolist()
        found = np.empty((*shape, len(columns)))
        for k, column in enumerate(columns):
            found[..., k] = self._checked(function(*column), shape, ())
        return found.reshape(*shape, *batch)

    def _checked(self, found: Any, shape: tuple[int, ...], batch: tuple[int, ...]) -> Array:
        """Return numbers or arrays, in rows or not, as one array of shape (*shape, *batch)."""
        try:
            rows = [found] if len(shape) == 1 else found
            entries = [[np.broadcast_to(np.asarray(e, dtype=float), batch) for e in row] for row in rows]
            numbers = np.array(entries)
        except (TypeError, ValueError):
            numbers = np.zeros(0)
        if numbers.shape != (*(1,) * (2 - len(shape)), *shape, *batch) or not np.isfinite(numbers).all():
            what = "force" if len(shape) == 1 else "jacobian"
            raise InputError(
                f"{what} of {self.name!r} must return finite numbers of shape {(*shape, *batch)}, "
                f"got {brief(found)}"
            )
        return numbers.reshape(*shape, *batch)


def _state(position: Array, velocity: Array, speed: Array) -> Array:
    return np.concatenate([position, velocity, speed[None]])


def _require_taking(name: str, function: Law | None, taken: list[str]) -> None:
    """Raise InputError where it is known that a function cannot be called with as many numbers."""
    try:
        known = inspect.signature(function) if function is not None else None
    except (TypeError, ValueError):  # of some that are not written in Python
        return
    if known is None:
        return
    try:
        known.bind(*taken)
    except TypeError:
        raise InputError(
            f"{name} must be a function of ({', '.join(taken)}), got one of {shortened(str(known))}"
        ) from None


@arguments
def as_reaction(
    force: Law,
    *,
    clearance: float,
    name: str | None = None,
    jacobian: Law | None = None,
    vectorized: bool = False,
    relative_step: float = RELATIVE_STEP,
    nominal_force: float | None = None,
    freedoms: Sequence[str] = PLANAR,
    largest_angle: float = LARGEST_ANGLE,
) -> OwnReaction:
    """Return a bearing whose force is a function of yours; it is usable wherever a bearing is.

    Parameters
    ----------
    force : callable
        (x, y, vx, vy, speed) [m, m/s, rad/s] -> (force_x, force_y) [N], the force on the journal. With other
        freedoms (places, rates, speed) -> forces and moments on the shaft [N, N m], one for each of them:
        (z, tilt_x, vz, tilt_rate_x, speed) -> (force_z, moment_x). An FMU carries a function from the top of
        an importable module, or a frozen dataclass with `__call__`.
    clearance : float [m]
        Radial clearance: x and y stay within it, and the force is never evaluated beyond it. It scales the
        steps of differences, also along z.
    name : str, optional
        Name in messages and of the FMU; by default that of the function.
    jacobian : callable, optional
        (x, y, vx, vy, speed) -> 2 rows of 5 numbers, d(force_x, force_y)/d(x, y, vx, vy, speed); n rows of 2
        n + 1 with n freedoms. By default they are differences of sixth order, which take 30 force evaluations
        for each state of a planar bearing. For a smooth force their error is about 1e-11 of the largest
        entry; `OwnReaction.jacobian_error` estimates it at a state.
    vectorized : bool
        Whether the functions take arrays of one shape, and are called once for a batch of states.
    relative_step : float [1]
        Largest step of the differences, relative to the remaining clearance for positions, and to the sum of
        speed and velocity / clearance for rates. A noisy force needs a larger one.
    nominal_force : float [N], optional
        Typical force, for nominal values of signals. By default the force half a clearance from the center at
        100 rad/s; moments count as forces at the arm clearance/largest_angle.
    freedoms : sequence of str
        Motions of the shaft that it reacts to, some of `core.signals.FREEDOMS` in their order.
    largest_angle : float [rad]
        Scale of tilts and twist, as the clearance is that of lengths.

    Returns
    -------
    OwnReaction

    Raises
    ------
    InputError
        If an argument breaks its rule, or the function does not return two finite numbers.

    Examples
    --------
    >>> def spring(x, y, vx, vy, speed):
    ...     return -1e6 * x - 300.0 * vx, -1e6 * y - 300.0 * vy
    >>> bearing = as_reaction(spring, clearance=1e-4)
    >>> bearing(position=[2e-5, 0.0], velocity=[0.0, 0.0], speed=100.0)
    array([-20.,   0.])
    """
    own = name if name is not None else getattr(force, "__name__", "")
    called = own if name is not None or own.isidentifier() else "own_bearing"
    made = OwnReaction(
        law=force,
        clearance=clearance,
        name=called,
        nominal_force=1.0 if nominal_force is None else nominal_force,
        slopes=jacobian,
        vectorized=vectorized,
        relative_step=relative_step,
        freedoms=checked_freedoms(freedoms),
        largest_angle=largest_angle,
    )
    if nominal_force is not None:
        return made
    still = np.zeros(len(made.freedoms))
    aside = np.array([0.5 * made.scales[0], *still[1:]])
    tried = made.force(aside, still, NOMINAL_SPEED) * (made.scales / clearance)
    return replace(made, nominal_force=float(np.hypot.reduce(tried)) or 1.0)
