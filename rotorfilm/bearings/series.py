"""A reaction behind another one, with a body between them, as a ball bearing in a damper."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.dynamic_stiffness import newton_root, no_rest, quasi_static, rest_state, states_rest
from ..core.errors import (
    EquilibriumError,
    InputError,
    UndefinedDerivativeError,
    require_finite,
    require_positive,
)
from ..core.inputs import quantities
from ..core.model import Array, Linearization
from ..core.port import (
    Reaction,
    carries_load,
    clearance_of,
    force_noise,
    freedoms_of,
    inertial,
    mass_of,
    require_range,
    static_force,
    static_slopes,
)
from ..core.signals import FREEDOMS, Signal, place_names
from .assemblies import (
    AssemblyAtRest,
    PartAtRest,
    leaking_part,
    named_states,
    part_linearization,
    reached_place,
    require_part,
    state_rates,
    told_place,
)
from .linear_system import HoldingStiffness
from .reaction import input_vector

_CREEP = 1e-6
"""Rates, in nominal ones, at which a part has slopes that has none at rest."""


def _slopes_near_rest(part: Any, position: Array, speed: float) -> Array:
    """Return the derivatives of a force at rest by places; of one that has none, in very slow motion."""
    n, still = len(position), quasi_static(part)
    try:
        return static_slopes(still, position, np.zeros(n), speed)[:, :n]
    except UndefinedDerivativeError:
        creep = _CREEP * np.array([signal.nominal for signal in part.inputs[n : 2 * n]])
        return static_slopes(still, position, creep, speed)[:, :n]


@quantities
@dataclass(frozen=True)
class Body:
    """A rigid body between two reactions that does not turn, such as the outer ring of a bearing in a damper.

    Parameters
    ----------
    mass : float [kg]
    inertia : float or None [kg m2]
        Moment of inertia about a diameter; None for a body that does not tilt.

    Raises
    ------
    InputError
        If one of them is not positive.
    """

    mass: float
    inertia: float | None = None

    def __post_init__(self) -> None:
        require_positive("mass", self.mass)
        if self.inertia is not None:
            require_positive("inertia", self.inertia)


@quantities
@dataclass(frozen=True)
class Series:
    """One reaction between ground and a body, and another one between the body and the shaft.

    The force on the shaft is that of the inner reaction, at the position of the shaft relative to the body
    and at the shaft speed. The outer reaction acts on the body alone, at speed 0. The body moves along the
    freedoms of both reactions and is held otherwise. The states are the positions and velocities of the body
    (body_x, body_vx, ...), then those of the inner and the outer reaction (inner_tilt_1, outer_state_0, ...).

    Parameters
    ----------
    outer : Reaction
        Outer reaction such as a damper on its springs; its added mass is added to the body.
    body : Body
        The body between both, such as the outer ring of a ball bearing.
    inner : Reaction
        Inner reaction such as a ball bearing; it must have no added mass.

    Raises
    ------
    InputError
        If an argument is no Reaction, its heat balance determines its temperature, the inner reaction adds a
        mass, or both have no freedom in common.

    Examples
    --------
    >>> from rotorfilm import LinearBearing
    >>> spring = LinearBearing(stiffness=1e6)
    >>> [state.name for state in Series(spring, Body(2.0), spring).states]
    ['body_x', 'body_y', 'body_vx', 'body_vy']
    """

    outer: Reaction
    body: Body
    inner: Reaction

    def __post_init__(self) -> None:
        require_part("outer", self.outer)
        require_part("inner", self.inner)
        if inertial(self.inner) is not None:
            raise InputError(
                f"inner must not add a mass, which would feel shaft and body at once, got {self.inner!r}"
            )
        if not self._shared:
            both = " and ".join(", ".join(freedoms_of(part)) for part in (self.outer, self.inner))
            raise InputError(f"outer and inner must react to one motion that the body has, got {both}")

    @property
    def freedoms(self) -> tuple[str, ...]:
        """The same as those of the inner reaction."""
        return freedoms_of(self.inner)

    @property
    def clearance(self) -> float:
        """Largest displacement of the shaft [m]: the sum of both clearances."""
        return clearance_of(self.inner) + clearance_of(self.outer)

    @property
    def carries_load(self) -> bool:
        """Whether both reactions are bearings, not seals."""
        return carries_load(self.inner) and carries_load(self.outer)

    def force_noise(self, speed: float) -> float:
        """Return the roundoff error of both forces [N]."""
        return force_noise(self.inner, speed) + force_noise(self.outer, 0.0)

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The same as those of the inner reaction."""
        return self.inner.inputs

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The forces of the inner reaction."""
        return self.inner.outputs[: len(self.freedoms)]

    @cached_property
    def states(self) -> tuple[Signal, ...]:
        """Places and rates of the body, and the states of the inner and of the outer reaction."""
        felt = {signal.name: signal for signal in self.outer.inputs}
        moved = [
            replace(felt[name], name=f"body_{name}", description=f"{name} of the body between both reactions")
            for name in place_names(self._shared)
        ]
        return (*moved, *named_states("inner", self.inner), *named_states("outer", self.outer))

    @property
    def initial_state(self) -> Array:
        """The body at rest in the center, and the initial states of both reactions."""
        parts: Any = [part for part in (self.inner, self.outer) if part.states]
        return np.concatenate([np.zeros(2 * len(self._shared)), *(part.initial_state for part in parts)])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the forces on the shaft at u = (places, rates, speed)."""
        (state, felt), _ = self._felt(x, u)
        return np.asarray(self.inner.output(t, state, felt))[: len(self.freedoms)]

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states."""
        inner, outer = self._felt(x, u)
        k = len(self._shared)
        return np.concatenate(
            [
                np.asarray(x, dtype=float)[k : 2 * k],
                self._acceleration(t, inner, outer),
                state_rates(self.inner, t, *inner),
                state_rates(self.outer, t, *outer),
            ]
        )

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives."""
        inner, outer = self._felt(x, u)
        heavy, still = inertial(self.outer), np.zeros((len(self._shared), len(outer[1])))
        if heavy is not None:
            n, rows = len(outer[1]) // 2, self._rows[1]
            slopes = heavy.mass_slopes(outer[1][:n], outer[1][n : 2 * n], 0.0)[np.ix_(rows, rows)]
            still = np.einsum("ijk,j->ik", slopes, self._acceleration(t, inner, outer))
        return self._joined(
            self.inner.linearization(t, *inner), self.outer.linearization(t, *outer), outer[1], still
        )

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the equilibrium states for a shaft at rest at a position (n,).

        Raises
        ------
        EquilibriumError
            If the body has no equilibrium, for example in a ruptured film without springs.
        """
        q = require_finite("position", position)
        b = self._resting_body(q, speed)
        inner, outer = self._apart(q, b)
        return np.concatenate(
            [b, np.zeros_like(b), rest_state(self.inner, inner, speed), rest_state(self.outer, outer, 0.0)]
        )

    @cached_property
    def leaking(self) -> Series:
        """The same with a small decay of states where some integrate."""
        outer, inner = leaking_part(self.outer), leaking_part(self.inner)
        held = outer is self.outer and inner is self.inner
        return self if held else replace(self, outer=outer, inner=inner)

    def at_rest(self) -> AssemblyAtRest:
        """Return the reaction with its states at their equilibrium for a shaft at rest."""
        return AssemblyAtRest(self.leaking)

    def parts_at_rest(self, position: Array, speed: float) -> list[PartAtRest]:
        """Return both reactions for a shaft at rest at a position (n,)."""
        inner, outer = self._apart(position, self._resting_body(position, speed))
        return [PartAtRest(self.inner, inner, speed), PartAtRest(self.outer, outer, 0.0)]

    def rest_place(self, load: Sequence[float], speed: float) -> Array | None:
        """Return a first guess of the equilibrium, with the outer reaction replaced by springs."""
        push = np.array(load)
        place = told_place(self.inner, push, speed)
        if place is None:
            return None
        (own, other), still = self._rows, np.zeros(len(freedoms_of(self.outer)))
        with suppress(EquilibriumError, UndefinedDerivativeError, np.linalg.LinAlgError):
            slopes = _slopes_near_rest(self.outer, still, 0.0)[np.ix_(other, other)]
            place[own] -= np.linalg.solve(slopes, push[own])
        return reached_place(self, place, speed)

    def require_range(self, frequency: float) -> None:
        """Warn or raise InputError if one of the models is not valid for motion at a frequency [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of the motion.
        """
        require_range(self.inner, frequency)
        require_range(self.outer, frequency)

    def dynamic_stiffness(self, position: ArrayLike, speed: float) -> HoldingStiffness:
        """Return K(s) of small motion; see `core.port`."""
        return HoldingStiffness(self.rest_linearization(position, speed))

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the derivatives with all states in equilibrium; see `core.port`."""
        q = require_finite("position", position)
        inner, outer = self._apart(q, self._resting_body(q, speed))
        felt = np.concatenate([outer, np.zeros(len(outer) + 1)])
        still = np.zeros((len(self._shared), len(felt)))
        return self._joined(
            part_linearization(self.inner, inner, speed, states_rest(self.inner)),
            part_linearization(self.outer, outer, 0.0, states_rest(self.outer)),
            felt,
            still,
        )

    @cached_property
    def _shared(self) -> tuple[str, ...]:
        """Motions of the body."""
        tilts = self.body.inertia is not None
        known = [name for name in FREEDOMS if not FREEDOMS[name].turns or (tilts and name != "twist")]
        return tuple(name for name in self.freedoms if name in freedoms_of(self.outer) and name in known)

    @cached_property
    def _rows(self) -> tuple[list[int], list[int]]:
        """Where the motions of the body are among those of the inner and of the outer reaction."""
        inner, outer = self.freedoms, freedoms_of(self.outer)
        return [inner.index(name) for name in self._shared], [outer.index(name) for name in self._shared]

    def _apart(self, q: Array, b: Array) -> tuple[Array, Array]:
        """Return the places that both feel with shaft and body at places q and b."""
        inner, outer = np.array(q), np.zeros(len(freedoms_of(self.outer)))
        inner[self._rows[0]] -= b
        outer[self._rows[1]] = b
        return inner, outer

    def _felt(self, x: ArrayLike, u: ArrayLike) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Return states and inputs of both."""
        state, values = require_finite("x", x), input_vector(u, self.freedoms)
        if state.shape != (len(self.states),):
            raise InputError(f"x must have shape ({len(self.states)},), got shape {state.shape}")
        n, k = len(self.freedoms), len(self._shared)
        place, moved = self._apart(values[:n], state[:k])
        rate, moving = self._apart(values[n : 2 * n], state[k : 2 * k])
        end = 2 * k + len(self.inner.states)
        inner = state[2 * k : end], np.concatenate([place, rate, values[-1:]])
        return inner, (state[end:], np.concatenate([moved, moving, [0.0]]))

    def _mass(self, felt: Array) -> Array:
        """Return the mass of the body, with what the outer reaction adds, shape (k, k)."""
        n, rows = len(felt) // 2, self._rows[1]
        tilt = self.body.inertia or 0.0
        own = [tilt if FREEDOMS[name].turns else self.body.mass for name in self._shared]
        return np.diag(own) + mass_of(self.outer, felt[:n], felt[n : 2 * n], 0.0)[np.ix_(rows, rows)]

    def _acceleration(self, t: float, inner: tuple[Array, Array], outer: tuple[Array, Array]) -> Array:
        pull, push = self.inner.output(t, *inner)[self._rows[0]], self.outer.output(t, *outer)[self._rows[1]]
        return np.asarray(np.linalg.solve(self._mass(outer[1]), push - pull))

    def _resting_body(self, q: Array, speed: float) -> Array:
        """Return where the body rests with the shaft at a place, shape (k,)."""
        inner, outer, (own, other) = quasi_static(self.inner), quasi_static(self.outer), self._rows
        n, m, k = len(self.freedoms), len(freedoms_of(self.outer)), len(self._shared)

        def pull(b: Array) -> Array:
            there, here = self._apart(q, b)
            push = static_force(outer, here, np.zeros(m), 0.0)[other]
            return np.asarray(push - static_force(inner, there, np.zeros(n), speed)[own])

        def slopes(b: Array) -> Array:
            there, here = self._apart(q, b)
            push = _slopes_near_rest(self.outer, here, 0.0)[np.ix_(other, other)]
            return np.asarray(push + _slopes_near_rest(self.inner, there, speed)[np.ix_(own, own)])

        gaps = np.array([clearance_of(self.inner), clearance_of(self.outer)])
        share = np.argmax(gaps) if np.isinf(gaps).any() else gaps[1] / gaps.sum()
        nominal = np.array([signal.nominal for signal in self.states[:k]])
        try:
            found = newton_root(pull, slopes, share * q[own], nominal)
        except UndefinedDerivativeError as error:
            raise no_rest(self, q, speed) from error
        if found is None:
            raise no_rest(self, q, speed)
        return found

    def _joined(
        self, inner: Linearization, outer: Linearization, felt: Array, slopes: Array
    ) -> Linearization:
        """Return the derivatives of both and of the body.

        Parameters
        ----------
        inner, outer : Linearization
        felt : ndarray, shape (2 m + 1,)
            Input of the outer reaction.
        slopes : ndarray, shape (k, 2 m + 1)
            Slopes of the mass of the body times its acceleration by that, with the acceleration held.
        """
        n, m, k = len(self.freedoms), len(felt) // 2, len(self._shared)
        size, (own, other) = 2 * k + len(inner.A) + len(outer.A), self._rows
        there, here = np.zeros((2 * n + 1, size)), np.zeros((2 * m + 1, size))
        there[[*own, *(n + row for row in own)], range(2 * k)] = -1.0
        here[[*other, *(m + row for row in other)], range(2 * k)] = 1.0
        kept, held = np.eye(len(inner.A), size, 2 * k), np.eye(len(outer.A), size, 2 * k + len(inner.A))
        force = inner.C[:n] @ kept + inner.D[:n] @ there
        push = (outer.C[:m] @ held + outer.D[:m] @ here)[other] - slopes @ here
        moved = np.linalg.solve(self._mass(felt), np.hstack([push - force[own], -inner.D[own]]))
        A = [np.eye(k, size, k), moved[:, :size], inner.A @ kept + inner.B @ there]
        B = [np.zeros((k, 2 * n + 1)), moved[:, size:], inner.B, np.zeros((len(outer.A), 2 * n + 1))]
        return Linearization(
            np.vstack([*A, outer.A @ held + outer.B @ here]), np.vstack(B), force, inner.D[:n].copy()
        )
