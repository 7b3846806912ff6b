"""The static equilibrium of a flexible rotor in several bearings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np

from ..core import port
from ..core.dynamic_stiffness import quasi_static
from ..core.errors import (
    HEARD,
    ConvergenceError,
    EquilibriumError,
    FilmContactError,
    InputError,
    UnloadedPadWarning,
    ValidityWarning,
    require_number,
    silencing,
    warn_user,
)
from ..core.inputs import arguments
from ..core.model import Array
from ..core.readable import Item, Readable
from ..core.results import Coefficients, by_freedom
from ..core.signals import FREEDOMS, PLANAR
from ..rotors import FlexibleRotor, require_flexible
from ..rotors.structure import Structure, hysteresis_matrices, untouched
from . import modal_reduction
from .coefficients import film_coefficients
from .equilibrium import equilibrium
from .threads import one_blas_thread

KELVIN = 1e-7
"""Change of temperatures [K] below which they are settled."""

WARMINGS = 60
"""Most rounds of rest at given temperatures and temperatures at given rest."""

JUMP = 1e-2
"""Change [K] that may remain where rounds go to and fro: where a pad gains or loses its film, the power jumps
by that of the pad, so that no temperature balances it better."""


@dataclass(frozen=True, kw_only=True)
class RotorEquilibrium(Readable):
    """A rotor at rest in its bearings.

    Attributes
    ----------
    speed : float [rad/s]
    coefficients : dict of str to Coefficients
        Stiffness, damping and journal position of each bearing, by station. A bearing with an added mass has
        `InertialCoefficients`, with that mass.
    loads : dict of str to ndarray, shape (2,) [N]
        Static load on each bearing, by station. For a bearing with n other freedoms it has the shape (n,) and
        includes moments [N m].
    displacement : ndarray, shape (N,)
        Coordinates of the rotor.
    residual : float [1]
        Largest imbalance of forces / weight; [N] without weight.
    temperatures : dict of str to float [K]
        Temperatures of the films whose temperature follows from the balance of their heat, by station.
    work : dict of str to int
        Steps of Newton's method (newton_steps).
    """

    speed: float
    coefficients: dict[str, Coefficients]
    loads: dict[str, Array]
    displacement: Array
    residual: float
    temperatures: dict[str, float] = field(default_factory=dict)
    work: dict[str, int] = field(default_factory=dict, compare=False)

    def _entries(self, items: Iterator[Item]) -> Iterator[Item]:
        """Yield items; the load on a bearing of other motions than x and y entry by entry, moments in N m."""
        for item in items:
            film = self.coefficients.get(item.name.removeprefix("loads_"))
            if film is None or not item.name.startswith("loads_"):
                yield item
                continue
            for one in by_freedom((item._replace(name="load"),), film.freedoms):
                yield one._replace(name=one.name.replace("load", item.name, 1))


@one_blas_thread
@arguments
def rotor_equilibrium(rotor: FlexibleRotor, bearings: port.Bearings, speed: float) -> RotorEquilibrium:
    """Return the static equilibrium of a rotor in its bearings under its weight.

    With two bearings the loads follow from statics; with more they also depend on the stiffness of the shaft.

    Parameters
    ----------
    rotor : FlexibleRotor
        Its own speed is not used.
    bearings : mapping of str to Reaction
        Bearings by the name of the station; a station without a bearing is free. A rotor without weight need
        not be held. A bearing with other freedoms than x, y needs a station that has them too.
    speed : float [rad/s]
        Angular speed about +z, of either sign.

    Raises
    ------
    InputError
        If there is no such station.
    EquilibriumError
        If a film cannot carry its load, the bearings do not hold the rotor, or the search does not converge.
    UndefinedDerivativeError
        If a film has no derivative at the equilibrium.

    Warns
    -----
    ValidityWarning
        Where motion at the frequency of the rotation is too fast for the added mass of a film.

    Notes
    -----
    With the displacement q of the rotor and p of the journals in their bearings,
    (K + w H) q = weight + T' F(p) and T q = s p. At s = 0 the bearings are rigid, which gives the first
    loads. Then s goes to 1, each step by Newton's method with the exact Jacobian.
    """
    require_flexible(rotor)
    speed = require_number("speed", speed)
    model = next(modal_reduction.models(rotor, modal_reduction.usual_frequency(rotor, 0.0)))
    with modal_reduction.counted("newton_steps") as work:
        at = rest(model.structure, bearings, speed)
    return replace(
        at, displacement=model.lifted(at.displacement), work={"newton_steps": work["newton_steps"]}
    )


def rest(
    structure: Structure, bearings: port.Bearings, speed: float, near: Sequence[RotorEquilibrium] = ()
) -> RotorEquilibrium:
    """Return where a rotor of these matrices rests, from other speeds on, as `rotor_equilibrium`."""
    if near and _is_the_same_at_any_speed(structure, bearings):
        return _at_speed(near[0], speed)
    modal_reduction.tally("equilibria")
    port.require_reactions("bearings", bearings, heavy=True)
    for bearing in bearings.values():
        if heavy := port.inertial(bearing):
            heavy.require_range(abs(speed))
    system = RestEquations(structure, bearings, speed)
    found = _from_near(system, near) if near else None
    if found is not None:
        return found
    q, loads = system.on_rigid_bearings()
    alone = system.each_alone(system.split(loads))
    p = np.concatenate([np.zeros(0), *(position for position, _ in alone)])
    temperatures = [temperature for _, temperature in alone]
    change = np.zeros(len(temperatures))
    for _ in range(WARMINGS):
        system.warm(temperatures)
        q, p = system.rest(q, p)
        last, temperatures = temperatures, system.balanced(p)
        before, change = change, _change(last, temperatures)
        if np.abs(change).max(initial=0.0) <= KELVIN:
            return _result(system, q, p, temperatures)
        if np.abs(change).max() <= JUMP and np.abs(change + before).max() <= 1e-3 * np.abs(change).max():
            return _result(system, q, p, last)
    raise EquilibriumError(
        f"rotor must have an equilibrium at the temperatures of its films, and {WARMINGS} rounds did not "
        f"find it: the last round changed them from {last} to {temperatures} K"
    )


class EquilibriumSearch:
    """Equilibria of a rotor, each found once: every search begins at those of the nearest speeds.

    Parameters
    ----------
    bearings : mapping of str to Reaction
        As in `rotor_equilibrium`.
    warns : bool
        Whether every speed may give a warning that the flow of a film is not laminar, not only the first.
    """

    def __init__(self, bearings: port.Bearings, *, warns: bool = True) -> None:
        self.bearings, self._warns = bearings, warns
        self._known: dict[int, tuple[Structure, dict[float, RotorEquilibrium]]] = {}

    def known(self, structure: Structure) -> dict[float, RotorEquilibrium]:
        """Return the equilibria of these matrices so far, by their speeds [rad/s]."""
        return self._known.setdefault(id(structure), (structure, {}))[1]

    def at(self, structure: Structure, speed: float) -> RotorEquilibrium:
        """Return the equilibrium of a rotor of these matrices at a speed [rad/s]; see `rest`."""
        known = self.known(structure)
        if speed not in known:
            near = sorted(known.values(), key=lambda one: abs(one.speed - speed))[:3]
            known[speed] = rest(structure, self.bearings, speed, near)
            for bearing in self.bearings.values() if near and self._warns else ():
                port.warn_of_flow(bearing, speed)
        return known[speed]


def _is_the_same_at_any_speed(structure: Structure, bearings: port.Bearings) -> bool:
    """Return whether all bearings are springs and dampers, and no damping that turns presses on them."""
    turning = structure.hysteresis is not None or abs(structure.circulation).max() > 0.0
    return not turning and all(map(port.is_constant, bearings.values()))


def _at_speed(at: RotorEquilibrium, speed: float) -> RotorEquilibrium:
    found = {name: replace(one, speed=speed) for name, one in at.coefficients.items()}
    return replace(at, speed=speed, coefficients=found)


def _change(last: list[float | None], now: list[float | None]) -> Array:
    """Return the changes of the temperatures [K], 0 of films that do not warm."""
    pairs = zip(last, now, strict=True)
    return np.array([0.0 if a is None or b is None else b - a for a, b in pairs])


def _from_near(system: RestEquations, near: Sequence[RotorEquilibrium]) -> RotorEquilibrium | None:
    """Return the rest by Newton's method from those at other speeds; None where that leads nowhere."""
    if near[0].temperatures or len(near[0].displacement) != len(system.weight):
        return None
    shares = _shares([one.speed for one in near], system.speed)

    def place(one: RotorEquilibrium) -> Array:
        return np.concatenate([one.displacement, *(one.coefficients[name].position for name in system.names)])

    start = sum((share * place(one) for share, one in zip(shares, near, strict=False)), np.zeros(()))
    try:
        q, p = np.split(start, [len(system.weight)])
        q, p = system.solve(q, p, 1.0)
    except (EquilibriumError, FilmContactError):
        return None
    return _result(system, q, p, [None] * len(system.names))


def _shares(known: list[float], speed: float) -> list[float]:
    """Return the weights of values at some speeds on the parabola through three: the first if far from it."""
    if len(set(known)) < 3 or abs(known[0] - speed) > abs(known[0] - known[2]):
        return [1.0]
    return [
        math.prod((speed - other) / (own - other) for other in known[:3] if other != own) for own in known[:3]
    ]


def _result(system: RestEquations, q: Array, p: Array, temperatures: list[float | None]) -> RotorEquilibrium:
    forces = system.forces(p)
    imbalance = system.residual(q, p, 1.0, forces)[0]
    places = dict(zip(system.names, system.split(p), strict=True))
    films = dict(zip(system.names, system.bearings, strict=True))
    for name, at in places.items():
        _warn_of_pads(name, films[name], at, system.speed)
    return RotorEquilibrium(
        speed=system.speed,
        coefficients={name: film_coefficients(films[name], at, system.speed) for name, at in places.items()},
        loads=dict(zip(system.names, system.split(-forces), strict=True)),
        displacement=q,
        residual=float(np.abs(imbalance).max()) / system.size,
        temperatures={n: T for n, T in zip(system.names, temperatures, strict=True) if T is not None},
    )


def _warn_of_pads(name: str, film: Any, position: Array, speed: float) -> None:
    """Warn of unloaded pads at the equilibrium, once in a call for each station."""
    still = quasi_static(film)
    if still is film:
        return
    heard: list[tuple[str, type[Warning]]] = []
    token = HEARD.set(heard)
    try:
        port.static_force(still, position, np.zeros_like(position), speed)
    finally:
        HEARD.reset(token)
    for message, category in heard:
        if category is UnloadedPadWarning:
            told = f"in the bearing at {name!r} at {speed:.6g} rad/s {message}"
            warn_user(told, category, (name, message))


# The equations of a flexible rotor at rest in its bearings, and Newton's method for them.


TOLERANCE = 1e-10
"""Largest imbalance of forces, and misfit of displacements, relative to their scale, above roundoff."""

CONTINUATION = 8
"""Steps in which the bearings' displacements are handed to the shaft when one step does not converge."""

_NEWTON_STEPS = 40

FREE_STEPS = 12
"""Number of whole Newton steps; later steps are halved until the imbalance falls.

Where a tilting pad gets its film, its load grows as the square root of the way, and whole steps only swing
around the equilibrium.
"""

_HALVINGS, _OVERSHOOT, _LEFT = 60, 0.5, 0.9

_SINGULAR = 1e15


class RestEquations:
    """The equations of a rotor at rest: displacements in units of the smallest clearance."""

    def __init__(self, structure: Structure, bearings: port.Bearings, speed: float) -> None:
        unknown = sorted(set(bearings) - set(structure.stations))
        if unknown:
            raise InputError(f"bearings must be in the stations {list(structure.stations)}, got {unknown}")
        self.names = [name for name in structure.stations if name in bearings]
        self.bare = [name for name in structure.stations if name not in bearings]
        self.given = [bearings[name] for name in self.names]
        self.bearings = list(self.given)
        self.speed = speed
        self.sizes = [len(port.freedoms_of(bearing)) for bearing in self.given]
        self.parts = [
            slice(end - size, end) for end, size in zip(np.cumsum(self.sizes), self.sizes, strict=True)
        ]
        self.journals = modal_reduction.all_rows(structure, {name: bearings[name] for name in self.names})
        self.stiffness = structure.stiffness + speed * structure.circulation
        if structure.hysteresis is not None:
            self.stiffness = self.stiffness + np.sign(speed) * hysteresis_matrices(structure)[0]
        self.weight = structure.weight
        self.size = float(np.abs(structure.weight).sum()) or 1.0
        # Axial and torsional motion that nothing presses on stays where it is.
        still = 2 * len(structure.coordinates) + np.flatnonzero(untouched(structure, self.journals))
        self.stiffness[still] = self.stiffness[:, still] = 0.0
        self.stiffness[still, still] = self.size / 1e-4
        self.terms = np.abs(self.stiffness), np.abs(self.journals)
        self.lengths = np.repeat([min(port.clearance_of(one), 1e-4) for one in self.given], self.sizes)
        n, m = len(self.weight), len(self.journals)
        self.matrix = np.zeros((n + m, n + m))
        self.matrix[:n, :n], self.matrix[n:, :n] = self.stiffness, self.journals
        self.pressed: tuple[Array, Array] | None = None

    def split(self, values: Array) -> list[Array]:
        """Return what a vector over the rows of all bearings has of each."""
        return [values[part] for part in self.parts]

    def on_rigid_bearings(self) -> tuple[Array, Array]:
        """Return the displacement of the rotor, and the loads on bearings that do not give way."""
        n, m = len(self.weight), len(self.journals)
        saddle = np.block([[self.stiffness, self.journals.T], [self.journals, np.zeros((m, m))]])
        # Rows and columns are scaled alike: stiffness is some 1e6 to 1e9 N/m.
        largest = max(float(np.abs(self.stiffness).max()), self.size / 1e-4)
        scale = np.concatenate([np.full(n, largest**-0.5), np.ones(m)])
        scale[n:] = 1.0 / scale[0]
        matrix = saddle * np.outer(scale, scale)
        wanted = scale * np.concatenate([self.weight, np.zeros(m)])
        if np.linalg.cond(matrix) < _SINGULAR:
            solved = scale * np.linalg.solve(matrix, wanted)
            return solved[:n], solved[n:]
        if not self.weight.any():
            return np.zeros(n), np.zeros(m)
        left, sizes, right = np.linalg.svd(matrix)
        known = sizes > sizes[0] / _SINGULAR
        if np.linalg.norm(right[~known, :n]) > 0.5:
            raise self.free()
        # Bearings of one node share its load, for a start alike.
        solved = scale * (right[known].T @ ((left.T @ wanted)[known] / sizes[known]))
        return solved[:n], solved[n:]

    def free(self) -> EquilibriumError:
        """Return what to raise of bearings that leave the rotor free."""
        return EquilibriumError(
            f"bearings must hold the rotor, got {self.names} that leave it free to move{self._without()}"
        )

    def _without(self) -> str:
        """Return which stations have no bearing, for a message."""
        return f"; the stations {self.bare} have no bearing" if self.bare else ""

    def alone(self, k: int, load: Array) -> tuple[Array, float | None]:
        """Return the position of one journal under its load, and the temperature of a film that warms."""
        bearing: Any = self.given[k]
        middle = np.zeros(self.sizes[k])
        if np.linalg.norm(load) <= 1e-9 * self.size or not math.isfinite(port.clearance_of(bearing)):
            return middle, port.rest_temperature(bearing, middle, self.speed)
        if len(middle) > 2:
            # Moments that rigid bearings would have push loose balls far away: a start without them.
            straight = [
                0.0 if FREEDOMS[f].turns else part
                for f, part in zip(port.freedoms_of(bearing), load.tolist(), strict=True)
            ]
            told = port.rest_place(bearing, straight, self.speed)
            return middle if told is None else np.asarray(told), None
        # These pads may be unloaded and those at rest in the rotor not, or the other way round.
        with silencing(UnloadedPadWarning):
            at = equilibrium(bearing, load, self.speed)
        return at.position, at.temperature

    def each_alone(self, loads: list[Array]) -> list[tuple[Array, float | None]]:
        """Return all as `alone` does, what is overloaded in the middle; EquilibriumError if all are."""
        found, failed = [], []
        for k, load in enumerate(loads):
            try:
                found.append(self.alone(k, load))
            except EquilibriumError as failure:
                # As a seal, which carries little: others may have its load.
                failed.append(failure)
                middle = np.zeros(self.sizes[k])
                found.append((middle, port.rest_temperature(self.given[k], middle, self.speed)))
        if failed and len(failed) == len(loads):
            raise failed[0]
        return found

    def warm(self, temperatures: list[float | None]) -> None:
        """Take the films at these temperatures; None for those that have theirs."""
        pairs = zip(self.given, temperatures, strict=True)
        self.pressed = None
        self.bearings = [b if T is None else cast(Any, b).at_temperature(T) for b, T in pairs]

    def balanced(self, p: Array) -> list[float | None]:
        """Return the temperatures of the films that warm, for these positions of the journals."""
        pairs = zip(self.given, self.split(p), strict=True)
        return [port.rest_temperature(b, at, self.speed) for b, at in pairs]

    def rest(self, q: Array, p: Array) -> tuple[Array, Array]:
        """Return (q, p) at rest, downhill among balls or by continuation where one step does not converge."""
        # A state that the search only passes through is nobody's answer; that of the result is warned of.
        with silencing(ValidityWarning):
            with suppress(EquilibriumError):
                return self.solve(q, p, 1.0)
            if min(self.sizes, default=0) > 2:
                with suppress(EquilibriumError, ConvergenceError):
                    return self.solve(q, p, 1.0, downhill=True)
            for s in np.arange(1, CONTINUATION + 1) / CONTINUATION:
                q, p = self.solve(q, p, float(s))
            return q, p

    def forces(self, p: Array) -> Array:
        """Return the forces of the bearings, one after the other; those of the last p are remembered."""
        if self.pressed is None or self.pressed[0] is not p:
            pairs = zip(self.bearings, self.split(p), strict=True)
            found = (modal_reduction.force_at(b, at, self.speed) for b, at in pairs)
            self.pressed = p, np.concatenate([np.zeros(0), *found])
        return self.pressed[1]

    def slopes(self, p: Array) -> Array:
        """Return d(forces)/dp, block by block."""
        found = np.zeros((len(p), len(p)))
        for part, bearing in zip(self.parts, self.bearings, strict=True):
            found[part, part] = modal_reduction.slopes_at(bearing, p[part], self.speed)
        return found

    def residual(self, q: Array, p: Array, s: float, pressed: Array) -> tuple[Array, Array]:
        """Return what is left of the forces on the rotor, and of the displacements of its journals.

        `pressed` are the forces of the bearings at p.
        """
        forces = self.stiffness @ q - self.weight - self.journals.T @ pressed
        return forces, self.journals @ q - s * p

    def tolerances(self, q: Array, p: Array, s: float, pressed: Array) -> tuple[Array, Array]:
        """Return the residuals at which the rotor rests: TOLERANCE, and roundoff of what cancels in them."""
        stiffness, journals = self.terms
        forces = np.abs(self.weight) + stiffness @ np.abs(q) + journals.T @ np.abs(pressed)
        misfit = journals @ np.abs(q) + s * np.abs(p)
        roundoff = max(len(q), 10) * np.finfo(float).eps
        allowed = TOLERANCE * self.size + roundoff * forces
        if self.weight.any():
            # Where bearings hardly hold the rotor, it moves so far that roundoff is more than its weight.
            allowed = np.minimum(allowed, port.MOST_LEFT * self.size)
        return allowed, TOLERANCE * self.lengths + roundoff * misfit

    def solve(self, q: Array, p: Array, s: float, *, downhill: bool = False) -> tuple[Array, Array]:
        """Return (q, p) by Newton's method, its steps kept within the clearances or such as lower energy."""
        n, left = len(q), math.inf
        for count in range(_NEWTON_STEPS):
            modal_reduction.tally("newton_steps")
            pressed = self.forces(p)
            forces, misfit = self.residual(q, p, s, pressed)
            before, left = left, float(np.abs(forces).max())
            near = left <= port.MOST_LEFT * self.size  # beyond it no weight is at rest
            if near or not self.weight.any():
                force_limit, misfit_limit = self.tolerances(q, p, s, pressed)
                if np.all(np.abs(forces) <= force_limit) and np.all(np.abs(misfit) <= misfit_limit):
                    return q, p
            # Else the slopes of the last step lead there too: they leave the same part once more.
            if not count or left * left > TOLERANCE * self.size * before:
                self.matrix[:n, n:] = -self.journals.T @ self.slopes(p)
            self.matrix[n:, n:] = -s * np.eye(len(p))
            try:
                step = np.linalg.solve(self.matrix, -np.concatenate([forces, misfit]))
            except np.linalg.LinAlgError:
                raise self.free() from None
            share = self._downhill(q, p, step, s) if downhill else self._within(p, step[n:])
            share = self._without_contact(p, step[n:], share)
            if count >= FREE_STEPS and not downhill:
                nearer = self._nearer(q, p, step, s, share)
                pads = any(quasi_static(one) is not one for one in self.bearings)
                if not nearer and pads and near and np.all(np.abs(misfit) <= misfit_limit):
                    return q, p  # at the onset of a pad's film, a last digit of p is more than is left
                share = nearer or share
            q, p = q + share * step[:n], p + share * step[n:]
        raise EquilibriumError(
            f"rotor must have an equilibrium at speed {self.speed!r} rad/s, and the search found none: "
            f"the imbalance is {np.abs(forces).max() / self.size:.3g} of the weight{self._too_far(p)}"
            f"{self._without()}"
        )

    def _too_far(self, p: Array) -> str:
        """Return how far the shaft sags where its journal is closest to contact, if that is out of reach."""
        if not self.names:
            return ""
        films = [port.relative_film(b, at) for b, at in zip(self.bearings, self.split(p), strict=True)]
        k = int(np.argmin(films))
        row, clearance = sum(self.sizes[:k]), port.clearance_of(self.bearings[k])
        others = copy(self)
        others.journals = np.delete(self.journals, np.s_[row : row + self.sizes[k]], axis=0)
        try:
            q, _ = others.on_rigid_bearings()
        except EquilibriumError:
            return ""
        sag = math.hypot(*(self.journals[row : row + 2] @ q))
        if sag <= clearance:
            return ""
        return (
            f"; without the bearing at {self.names[k]!r} the shaft sags {sag:.3g} m there, and its clearance "
            f"is {clearance:.3g} m"
        )

    def _downhill(self, q: Array, p: Array, step: Array, s: float) -> float:
        """Return the part of a step after which the force along it is about gone, as `native/rolling` does.

        Shaft and balls have a convex energy, apart from gyroscopic moments, so that force only falls. What
        joins shaft and journals is linear, so that a first whole step makes it fit.
        """
        dq, dp = np.split(step, [len(q)])
        low, high, share = 0.0, 1.0, 1.0
        pressed = self.forces(p)
        forces, misfit = self.residual(q, p, s, pressed)
        if np.any(np.abs(misfit) > self.tolerances(q, p, s, pressed)[1]):
            return share
        full = -float(forces @ dq)
        for _ in range(_HALVINGS):
            at = p + share * dp
            left = -float(self.residual(q + share * dq, at, s, self.forces(at))[0] @ dq)
            if left >= -_OVERSHOOT * full and (share == 1.0 or left <= _LEFT * full):
                break
            low, high = (low, share) if left < 0.0 else (share, high)
            share = 0.5 * (low + high)
        return share

    def _nearer(self, q: Array, p: Array, step: Array, s: float, share: float) -> float:
        """Return the part of a step, `share` at most, after which less is left of forces and misfits.

        It is 0 where no part that moves a journal by more than roundoff does so.
        """
        dq, dp = np.split(step, [len(q)])
        length = min(map(port.clearance_of, self.bearings), default=math.inf)

        def left(part: float) -> float:
            at = p + part * dp
            forces, misfit = self.residual(q + part * dq, at, s, self.forces(at))
            return math.hypot(*(forces / self.size), *(misfit / min(length, 1e-4)))

        most, least = left(0.0), 4.0 * np.finfo(float).eps * np.abs(p).max(initial=0.0)
        for _ in range(_HALVINGS):
            if share * np.abs(dp).max(initial=0.0) <= least:
                break
            if left(share) < most:
                return share
            share *= 0.5
        return 0.0

    def _without_contact(self, p: Array, step: Array, share: float) -> float:
        """Return the part of a step after which no tilted journal touches, which its center does not tell."""
        for bearing, at, move in zip(self.bearings, self.split(p), self.split(step), strict=True):
            for _ in range(_HALVINGS if len(at) > 2 else 0):
                with suppress(FilmContactError):
                    modal_reduction.force_at(bearing, at + share * move, self.speed)
                    break
                share *= 0.5
        return share

    def _within(self, p: Array, step: Array) -> float:
        """Return the part of a step that leaves every journal at least half of its gap."""
        share = 1.0
        for bearing, at, move in zip(self.bearings, self.split(p), self.split(step), strict=True):
            if port.freedoms_of(bearing)[:2] != PLANAR:
                continue
            # Balls push back wherever the shaft goes: no gap, but a way on which their force may change much.
            gap = port.clearance_of(bearing) if len(at) > 2 else float(port.minimum_film(bearing, at))
            length = math.hypot(*move[:2])
            share = min(share, 0.5 * gap / length if length > 0.5 * gap else 1.0)
        return share
