"""A rotor with bearings already in some of its stations: again a Dynamic model, with fewer inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import InputError, require_kind
from ..core.inputs import arguments, quantities
from ..core.model import Array, Dynamic, Linearization
from ..core.port import (
    Bearings,
    Reaction,
    in_time,
    inertial,
    require_reaction,
    require_reactions,
    require_turning,
)
from ..core.signals import JOURNAL_INPUTS, Signal, indices, names
from ..native.spec import HasKernel, NativeSpec
from .profile import SpeedProfile
from .rigid import RigidRotor, native_parameter
from .structure import AroundRotor, FlexibleRotor, Operators, prefixed


@quantities
@dataclass(frozen=True, kw_only=True)
class MountedRotor(AroundRotor):
    """A rotor whose stations of the given names rest in bearings; `mount` makes it.

    The forces of these bearings are no longer inputs, but outputs, of the same names. States and further
    outputs of a bearing get the name of its station in front, as `left_wear_0`.

    Parameters
    ----------
    rotor : Dynamic
        With inputs and outputs of each station by name, as `ShaftRotor`.
    stations : tuple of str
    bearings : tuple of Reaction
        One for each of the stations; one with states is a Dynamic too, as `BushReaction`.

    Raises
    ------
    InputError
        If the rotor has no such station, a bearing with states is not Dynamic or takes other inputs than the
        motion of the journal and the speed, or there are not as many of both.
    """

    rotor: Dynamic
    stations: tuple[str, ...]
    bearings: tuple[Reaction, ...]

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.bearings):
            raise InputError(
                f"bearings must be one for each of the stations {self.stations!r}, got {len(self.bearings)}"
            )
        require_kind("rotor", self.rotor, Dynamic, "a rotor such as a ShaftRotor")
        for station, bearing in zip(self.stations, self.bearings, strict=True):
            require_reaction(f"bearings[{station!r}]", bearing, heavy=True)
            if bearing.states and not isinstance(bearing, Dynamic):
                raise InputError(f"bearings with states must be Dynamic, got {bearing!r}")
            if names(bearing.inputs) != list(JOURNAL_INPUTS):
                raise InputError(
                    f"bearings must have the inputs {list(JOURNAL_INPUTS)}, got {names(bearing.inputs)}"
                )
        _ = self._motion, self.force_places

    @property
    def bare(self) -> Dynamic:
        """The rotor without bearings, also where it was mounted in several steps."""
        return self.rotor.bare if isinstance(self.rotor, MountedRotor) else self.rotor

    @property
    def all_bearings(self) -> dict[str, Reaction]:
        """All bearings by station, also where the rotor was mounted in several steps."""
        further = self.rotor.all_bearings if isinstance(self.rotor, MountedRotor) else {}
        return {**self._own_bearings, **further}

    @property
    def _own_bearings(self) -> dict[str, Reaction]:
        return dict(zip(self.stations, self.bearings, strict=True))

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor that no bearing drives."""
        return tuple(self.rotor.inputs[k] for k in self._free)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor, force_x, force_y of each bearing, and the further outputs of bearings."""
        further = [prefixed(name, s) for name, b in self._own_bearings.items() for s in b.outputs[2:]]
        return (*self.rotor.outputs, *(self.rotor.inputs[k] for k in self._taken), *further)

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, and those of each bearing."""
        of_bearings = [prefixed(name, s) for name, b in self._own_bearings.items() for s in b.states]
        return (*self.rotor.states, *of_bearings)

    @property
    def initial_state(self) -> Array:
        """The states of rotor and bearings at t = 0."""
        of_bearings = [b.initial_state for b in self.bearings if isinstance(b, Dynamic)]
        return np.concatenate([self.rotor.initial_state, *of_bearings])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt with the bearings' forces at this state; FilmContactError as the bearings raise it."""
        own, felt = self._split(t, x)
        forces = self._forces(t, own, [b.output(t, z, m)[:2] for b, z, m in felt], u)
        rates = [b.derivative(t, z, m) for b, z, m in felt if isinstance(b, Dynamic)]
        return np.concatenate([self.rotor.derivative(t, own, self._inputs(forces, u)), *rates])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, the bearings' forces, and their further outputs."""
        own, felt = self._split(t, x)
        values = [b.output(t, z, m) for b, z, m in felt]
        forces = self._forces(t, own, [value[:2] for value in values], u)
        whole = self.rotor.output(t, own, self._inputs(forces, u))
        return np.concatenate([whole, *forces, *(value[2:] for value in values)])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives of rotor and bearings; the speed is held."""
        own, felt = self._split(t, x)
        parts = [b.linearization(t, z, m) for b, z, m in felt]
        values = self._forces(t, own, [b.output(t, z, m)[:2] for b, z, m in felt], u)
        inputs = self._inputs(values, u)
        rotor = self.rotor.linearization(t, own, inputs)
        A, forces, further = _joined(parts, [rotor.C[rows] for rows in self._motion], rotor.C.shape[1])
        taken, free = self._taken, list(self._free)
        driven = np.zeros((len(forces), len(free)))
        if self._heavy:
            rates, sensed = self.rotor.derivative(t, own, inputs), self.rotor.output(t, own, inputs)
            columns = rotor.B[:, taken], rotor.B[:, free]
            forces, driven = self._heavy.slopes(rotor, *columns, sensed, forces, rates)
        states = len(A) - len(rotor.A)
        push = np.hstack([rotor.A, np.zeros((len(rotor.A), states))]) + rotor.B[:, taken] @ forces
        seen = np.hstack([rotor.C, np.zeros((len(rotor.C), states))]) + rotor.D[:, taken] @ forces
        by_input = rotor.B[:, free] + rotor.B[:, taken] @ driven
        return Linearization(
            np.vstack([push, A[len(rotor.A) :]]),
            np.vstack([by_input, np.zeros((states, len(free)))]),
            np.vstack([seen, forces, further]),
            np.vstack([rotor.D[:, free], driven, np.zeros((len(further), len(free)))]),
        )

    def native(self) -> NativeSpec | None:
        """Return rotor and bearings as one kernel of the C library; None if a part of them has none."""
        if type(self) is not MountedRotor:
            return None
        return system_kernel(
            self.rotor,
            self._own_bearings,
            carried=self._taken,
            free=self._free,
            motion=[row for rows in self.motion_places for row in rows],
        )

    def _split(self, t: float, x: ArrayLike) -> tuple[Array, list[tuple[Reaction, Array, Array]]]:
        """Return the state of the rotor; each bearing with its state and what it feels."""
        whole = np.asarray(x, dtype=float)
        own = whole[: self._ends[0]]
        sensed = self.rotor.output(t, own, np.zeros(len(self.rotor.inputs)))
        inner = [whole[a:b] for a, b in pairwise(self._ends)]
        motion = [sensed[rows] for rows in self._motion]
        return own, list(zip(self.bearings, inner, motion, strict=True))

    def _forces(self, t: float, own: Array, forces: list[Array], u: ArrayLike) -> list[Array]:
        """Return the forces of the bearings, with those of their added masses."""
        if not self._heavy:
            return forces
        inputs = self._inputs(forces, u)
        rotor, rates = self.rotor.linearization(t, own, inputs), self.rotor.derivative(t, own, inputs)
        sensed, push = self.rotor.output(t, own, inputs), rotor.B[:, self._taken]
        return np.split(self._heavy.forces(rotor, push, sensed, np.concatenate(forces), rates), len(forces))

    def _inputs(self, forces: Sequence[Array], u: ArrayLike) -> Array:
        whole = np.empty(len(self.rotor.inputs))
        whole[list(self._free)] = np.asarray(u, dtype=float)
        for rows, force in zip(self.force_places, forces, strict=True):
            whole[rows] = force
        return whole

    # Asked once: signals are made when they are asked for, and checks against protocols are slow.
    @cached_property
    def _ends(self) -> list[int]:
        """Where the states of the rotor end, and those of each bearing."""
        counts = [len(self.rotor.states), *(len(b.states) for b in self.bearings)]
        return list(accumulate(counts))

    @cached_property
    def _motion(self) -> list[list[int]]:
        speed = indices("rotor must have the outputs", names(self.rotor.outputs), ["speed"])
        return [rows + speed for rows in self.motion_places]

    @cached_property
    def _heavy(self) -> AddedMassJournals:
        return AddedMassJournals(self.bearings, self._motion)

    @cached_property
    def _taken(self) -> list[int]:
        """Inputs of the rotor that are forces of the bearings."""
        return [k for pair in self.force_places for k in pair]

    @cached_property
    def _free(self) -> tuple[int, ...]:
        return tuple(k for k in range(len(self.rotor.inputs)) if k not in self._taken)


def _joined(parts: Sequence[Linearization], motion: Sequence[Array], size: int) -> tuple[Array, Array, Array]:
    """Return A, forces, further outputs of all bearings by the states of the rotor, `size`, and their own."""
    total = size + sum(len(part.A) for part in parts)
    A, forces, further = np.zeros((total, total)), [np.zeros((0, total))], [np.zeros((0, total))]
    first = size
    for part, sensed in zip(parts, motion, strict=True):
        inner = slice(first, first + len(part.A))
        A[inner, :size], A[inner, inner] = part.B @ sensed, part.A
        seen = np.zeros((len(part.C), total))
        seen[:, :size], seen[:, inner] = part.D @ sensed, part.C
        forces.append(seen[:2])
        further.append(seen[2:])
        first = inner.stop
    return A, np.concatenate(forces), np.concatenate(further)


@arguments
def mount(rotor: Dynamic, bearings: Bearings) -> MountedRotor:
    """Return a rotor with bearings in some of its stations.

    With one station left, the one without a name, `simulate`, `cosimulate` and `closed_loop` take the result
    and the bearing of that station; with none left it is a Dynamic model without inputs.

    Parameters
    ----------
    rotor : Dynamic
        Its outputs do not depend on the forces, as is so for every rotor here.
    bearings : mapping of str to Reaction
        By the name of the station. One whose temperature is left to the balance of its heat gets it as a
        state.

    Raises
    ------
    InputError
        If the rotor has no such station, or a bearing does not fit.
    """
    require_reactions("bearings", bearings, heavy=True)
    for bearing in bearings.values():
        require_turning(bearing, rotor)
    return MountedRotor(
        rotor=rotor, stations=tuple(bearings), bearings=tuple(map(in_time, bearings.values()))
    )


# A rotor with its bearings as a kernel of the C library, where all of them have one.


KINDS = (
    "journal",
    "grooved_journal",
    "short_journal",
    "damper",
    "oil_damper",
    "reynolds_journal",
    "pressure_dam",
    "lobed_journal",
)
"""Kernels that may be a bearing of a system, in the order of `native/systems/mounted_tables.c`."""


def system_kernel(
    rotor: Dynamic, bearings: Bearings, *, carried: Sequence[int], free: Sequence[int], motion: Sequence[int]
) -> NativeSpec | None:
    """Return the kernel of a rotor with bearings; None if a part of it has none.

    Parameters
    ----------
    rotor : Dynamic
        A `FlexibleRotor` or a `RigidRotor`.
    bearings : mapping of str to Reaction
        By station, at least one.
    carried, free : sequence of int
        Inputs of the rotor that are forces of the bearings, and the others.
    motion : sequence of int
        Outputs of the rotor that are x, y, vx, vy of the stations.
    """
    parts = [bearing.native() if isinstance(bearing, HasKernel) else None for bearing in bearings.values()]
    specs = [spec for spec in parts if spec is not None and spec.kernel in KINDS]
    matrices = _operators(rotor)
    if matrices is None or not specs or len(specs) < len(parts):
        return None
    operators, profile = matrices
    speed = () if len(profile.times) > 1 else (native_parameter("constant_speed", profile.speeds[0]),)
    own = [prefixed(name, p) for name, spec in zip(bearings, specs, strict=True) for p in spec.parameters]
    places, sets = _distinct(specs)
    kinds = [KINDS.index(spec.kernel) for spec in specs]
    return NativeSpec(
        kernel="rotor_system",
        parts=tuple(spec.kernel for spec in specs),
        parameters=(*own, *speed),
        tables={
            **_matrices(operators, list(carried), list(free), list(motion)),
            "times": np.array(profile.times),
            "speeds": np.array(profile.speeds),
            "bearings": np.column_stack([kinds, places]).astype(float),
            **{f"{k}.{name}": table for k, spec in enumerate(sets) for name, table in spec.tables.items()},
        },
    )


def _operators(rotor: Dynamic) -> tuple[Operators, SpeedProfile] | None:
    elastic = isinstance(rotor, FlexibleRotor) and rotor.structure.hysteresis is None
    if isinstance(rotor, FlexibleRotor | RigidRotor) and (elastic or type(rotor) is RigidRotor):
        return rotor.operators, rotor.profile
    return None


def _matrices(model: Operators, carried: list[int], free: list[int], motion: list[int]) -> dict[str, Array]:
    """Return the tables of the kernel; its rates of displacements are the states' second half already."""
    n = len(model.weight) // 2
    return {
        "steady": model.steady[n:],
        "spin": model.spin[n:],
        "push": model.push[n:, free],
        "carry": model.push[n:, carried],
        "weight": model.weight[n:, None],
        "unbalance": model.unbalance[n:],
        "sense": model.sense,
        "motion": model.sense[motion],
    }


def _distinct(specs: Sequence[NativeSpec]) -> tuple[list[int], list[NativeSpec]]:
    """Return for each kernel the number of its tables among those that differ, and one kernel for each."""
    places: list[int] = []
    different: list[NativeSpec] = []
    for spec in specs:
        same = (k for k, other in enumerate(different) if _equal(spec, other))
        places.append(next(same, len(different)))
        if places[-1] == len(different):
            different.append(spec)
    return places, different


def _equal(one: NativeSpec, other: NativeSpec) -> bool:
    return one.tables.keys() == other.tables.keys() and all(
        np.array_equal(table, other.tables[name]) for name, table in one.tables.items()
    )


# A rotor in bearings whose oil adds mass: the forces that solve the accelerations of both at once.
#
# A bearing answers F - M a, a = V f(x, u) being the acceleration of its journal, f linear in the
# forces u, so
#
# (1 + M V B) (u - F) = -M V f(x, F)
#
# is solved for the forces, whatever the rotor: no exchange of accelerations, which diverges where the
# oil is heavier than the rotor.


class AddedMassJournals:
    """The journals of a rotor, by their places in its inputs and outputs.

    Parameters
    ----------
    bearings : sequence of Reaction
        One for each journal, those without mass too.
    motion : sequence of list of int
        Places of x, y, vx, vy, speed of each among the rotor's outputs.
    """

    def __init__(self, bearings: Sequence[Reaction], motion: Sequence[Sequence[int]]) -> None:
        self.heavy: list[Any] = [inertial(bearing) for bearing in bearings]
        self.motion = [list(rows) for rows in motion]

    def __bool__(self) -> bool:
        return any(bearing is not None for bearing in self.heavy)

    def forces(self, rotor: Linearization, push: Array, sensed: Array, forces: Array, rates: Array) -> Array:
        """Return the forces of all bearings on the journals [N], shape (2 n,).

        Parameters
        ----------
        rotor : Linearization
        push : ndarray, shape (n_states, 2 n)
            Columns of its B for these forces.
        sensed : ndarray, shape (n_outputs,)
            Outputs of the rotor.
        forces : ndarray, shape (2 n,) [N]
            Of the bearings without their mass.
        rates : ndarray, shape (n_states,)
            dx/dt of the rotor under those.
        """
        mass, along = self._mass(sensed), self._velocity(rotor)
        return forces - np.linalg.solve(np.eye(len(mass)) + mass @ along @ push, mass @ along @ rates)

    def slopes(
        self, rotor: Linearization, push: Array, free: Array, sensed: Array, slopes: Array, rates: Array
    ) -> tuple[Array, Array]:
        """Return the derivatives of these forces, by the whole state and by the free inputs.

        Parameters
        ----------
        rotor, push, sensed
            As in `forces`.
        free : ndarray, shape (n_states, n_free)
            Columns of B for the free inputs.
        slopes : ndarray, shape (2 n, n_whole)
            Of the forces without mass by the whole state, which begins with that of the rotor.
        rates : ndarray, shape (n_states,)
            dx/dt of the rotor under the forces that `forces` returns.
        """
        mass, along = self._mass(sensed), self._velocity(rotor)
        moved, size = slopes.copy(), len(rotor.A)
        moved[:, :size] -= mass @ along @ rotor.A
        for k, (bearing, rows) in enumerate(zip(self.heavy, self.motion, strict=True)):
            if bearing is not None:
                at = sensed[rows]
                by_place = bearing.mass_slopes(at[:2], at[2:4], at[4])
                by_motion = np.einsum("ijk,j->ik", by_place, rotor.C[rows[2:4]] @ rates)
                moved[2 * k : 2 * k + 2, :size] -= by_motion @ rotor.C[rows]
        joint = np.eye(len(mass)) + mass @ along @ push
        by_state = np.asarray(np.linalg.solve(joint, moved), dtype=float)
        by_input = -np.asarray(np.linalg.solve(joint, mass @ along @ free), dtype=float)
        return by_state, by_input

    def _mass(self, sensed: Array) -> Array:
        """Return the added masses of all journals, shape (2 n, 2 n) [kg]."""
        mass = np.zeros((2 * len(self.heavy), 2 * len(self.heavy)))
        for k, (bearing, rows) in enumerate(zip(self.heavy, self.motion, strict=True)):
            if bearing is not None:
                own = slice(2 * k, 2 * k + 2)
                mass[own, own] = bearing.mass(sensed[rows[:2]], sensed[rows[2:4]], sensed[rows[4]])
        return mass

    def _velocity(self, rotor: Linearization) -> Array:
        """Return the rows of the velocities of the journals, shape (2 n, n_states)."""
        return np.concatenate([rotor.C[rows[2:4]] for rows in self.motion])


def with_mass(rotor: Linearization, mass: ArrayLike, force: list[int], motion: list[int]) -> Linearization:
    """Return a rotor whose journal carries an added mass: its forces accelerate both.

    Parameters
    ----------
    rotor : Linearization
        Without feedthrough.
    mass : array_like, shape (2, 2) [kg]
    force : list of int
        Inputs that are the force on the journal.
    motion : list of int
        Outputs that are x, y, vx, vy of the journal.

    Returns
    -------
    Linearization
        With two outputs more: minus the added mass times the acceleration of the journal [N].
    """
    M, V, push = np.asarray(mass, dtype=float), rotor.C[motion[2:]], rotor.B[:, force]
    joint = np.eye(2) + M @ V @ push
    by_state, by_input = (-np.linalg.solve(joint, M @ V @ part) for part in (rotor.A, rotor.B))
    return Linearization(
        rotor.A + push @ by_state,
        rotor.B + push @ by_input,
        np.vstack([rotor.C, by_state]),
        np.vstack([rotor.D, by_input]),
    )
