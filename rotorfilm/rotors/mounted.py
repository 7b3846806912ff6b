"""A rotor with bearings already in some of its stations: again a Dynamic model, with fewer inputs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core import port
from ..core.errors import ConvergenceError, InputError, require_inside, require_kind
from ..core.inputs import arguments, quantities
from ..core.model import Array, Dynamic, Linearization, Model, static_linearization
from ..core.signals import PLANAR, Signal, indices, names
from ..native.spec import HasKernel, NativeSpec
from .prescribed_speed import SpeedInputRotor
from .profile import SpeedProfile
from .rigid import RigidRotor, native_parameter
from .structure import AroundRotor, FlexibleRotor, Operators, prefixed, station_names, unbalance_columns


class Mount(NamedTuple):
    """A reaction in its station, wired to the rotor by the names of the signals.

    Attributes
    ----------
    station : str
    reaction : Reaction
    motion, force : list of int
        Outputs of the rotor that the reaction takes: places, rates, speed; inputs that take its forces.
    inner : slice
        Its states in the state of the system.
    call : Force or None
        Force of a planar reaction without states, for plain numbers.
    alone : bool
        Whether its forces are all its outputs.
    clearance : float [m]
        Radius of the circle in which its journal stays; infinite where the reaction says itself what touches.
    """

    station: str
    reaction: port.Reaction
    motion: list[int]
    force: list[int]
    inner: slice
    call: port.Force | None
    alone: bool
    clearance: float

    @property
    def size(self) -> int:
        """Number of its freedoms."""
        return len(self.force)

    def push(self, t: float, x: Array, at: Array) -> Array:
        """Return the forces of the reaction at the whole state and what it feels.

        Raises
        ------
        FilmContactError
            If the journal is not inside its clearance.
        ConvergenceError
            If the reaction answers with something that is not finite.
        """
        return self._checked(t, x, at)[: self.size]

    def output(self, t: float, x: Array, at: Array) -> Array:
        """Return all outputs of the reaction, its forces first; it raises what `push` raises."""
        if self.call is None or self.alone:
            return self._checked(t, x, at)
        return np.asarray(self.reaction.output(t, x[self.inner], at))

    def _checked(self, t: float, x: Array, at: Array) -> Array:
        if self.clearance < np.inf:
            require_inside(at[:2], self.clearance, f" at t = {t:.9g} s")
        if self.call is None:
            found = np.asarray(self.reaction.output(t, x[self.inner], at))
        else:
            found = np.array(self.call(*at.tolist()))
        if not np.all(np.isfinite(found)):
            raise ConvergenceError(f"film force must be finite, got {found} at t = {t:.9g} s")
        return found

    def rates(self, t: float, x: Array, at: Array) -> Array:
        """Return the rates of the states of the reaction."""
        if self.inner.start == self.inner.stop:
            return np.zeros(0)
        return np.asarray(self.reaction.derivative(t, x[self.inner], at))  # type: ignore[attr-defined]

    def slopes(self, t: float, x: Array, at: Array) -> Linearization:
        """Return the derivatives of the reaction at the same arguments."""
        if self.call is None or not self.alone:
            return self.reaction.linearization(t, x[self.inner], at)
        return static_linearization(port.static_slopes(self.reaction, at[:2], at[2:4], at[4]))


class UnbalancePlane(NamedTuple):
    """An unbalance that is a parameter of the compiled system.

    Attributes
    ----------
    station : str
        Station of the rotor at the node of this plane, without a bearing.
    unbalance : float [kg m]
        Unbalance of the rotor in this plane.
    unbalance_angle : float [rad]
    """

    station: str
    unbalance: float
    unbalance_angle: float


def wired(rotor: Model, bearings: port.Bearings, name: str) -> list[Mount]:
    """Return reactions in the stations of a rotor.

    Parameters
    ----------
    rotor : Model
    bearings : mapping of str to Reaction
        Bearings by station; the empty name is that of a rotor with one journal.
    name : str
        Name of the argument, for messages.

    Raises
    ------
    InputError
        If the rotor lacks an output that a reaction needs or an input for its force, a reaction takes
        further inputs, or has states and no derivative.
    """
    inputs, outputs = names(rotor.inputs), names(rotor.outputs)
    mounts, last = [], np.size(getattr(rotor, "initial_state", ()))
    for station, bearing in bearings.items():
        argument = f"{name}[{station!r}]" if station else name
        port.require_reaction(argument, bearing, heavy=True, over_time=True)
        port.require_terminals(argument, bearing)
        freedoms, states = port.freedoms_of(bearing), len(bearing.states)
        motion, force = station_names(station, freedoms)
        mounts.append(
            Mount(
                station=station,
                reaction=bearing,
                motion=indices("rotor must have the outputs", outputs, [*motion, "speed"]),
                force=indices("rotor must have the inputs", inputs, force),
                inner=slice(last, last + states),
                call=port.prepared_force(bearing) if freedoms == PLANAR and not states else None,
                alone=len(bearing.outputs) == len(freedoms),
                clearance=np.inf
                if port.has_wall(bearing) or freedoms[:2] != PLANAR
                else port.clearance_of(bearing),
            )
        )
        last += states
    return mounts


@quantities
@dataclass(frozen=True, kw_only=True)
class MountedRotor(AroundRotor):
    """A rotor with bearings in some of its stations; `mount` makes it.

    The forces of these bearings are no longer inputs but outputs, with the same names. Names of states and
    further outputs of a bearing begin with the name of its station, for example `left_wear_0`.

    Parameters
    ----------
    rotor : Dynamic
        Rotor with inputs and outputs of each station by name, as `ShaftRotor`.
    stations : tuple of str
    bearings : tuple of Reaction
        One bearing for each of the stations; one with states is a Dynamic model too, such as `BushReaction`.
    planes : tuple of UnbalancePlane
        Unbalances of the rotor that a simulator may set in the compiled system.

    Raises
    ------
    InputError
        If the rotor has no such station or not all freedoms of its bearing, a bearing with states is not
        Dynamic or takes other inputs than motion and speed, or the numbers of stations and bearings differ.
    """

    rotor: Dynamic
    stations: tuple[str, ...]
    bearings: tuple[port.Reaction, ...]
    planes: tuple[UnbalancePlane, ...] = ()

    def __post_init__(self) -> None:
        if len(self.stations) != len(self.bearings):
            raise InputError(
                f"bearings must be one for each of the stations {self.stations!r}, got {len(self.bearings)}"
            )
        require_kind("rotor", self.rotor, Dynamic, "a rotor such as a ShaftRotor")
        _ = self.mounts

    @property
    def bare(self) -> Dynamic:
        """The rotor without bearings, also where it was mounted in several steps."""
        return self.rotor.bare if isinstance(self.rotor, MountedRotor) else self.rotor

    @property
    def all_bearings(self) -> dict[str, port.Reaction]:
        """All bearings by station in the order of their states, also of a rotor mounted in several steps."""
        before = self.rotor.all_bearings if isinstance(self.rotor, MountedRotor) else {}
        return {**before, **self._own_bearings}

    @property
    def _own_bearings(self) -> dict[str, port.Reaction]:
        return dict(zip(self.stations, self.bearings, strict=True))

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """The inputs of the rotor that no bearing drives."""
        return tuple(self.rotor.inputs[k] for k in self._free)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """The outputs of the rotor, the forces of each bearing, and the further outputs of bearings."""
        further = [prefixed(m.station, s) for m in self.mounts for s in m.reaction.outputs[m.size :]]
        return (*self.rotor.outputs, *(self.rotor.inputs[k] for k in self._taken), *further)

    @property
    def states(self) -> tuple[Signal, ...]:
        """The states of the rotor, and those of each bearing."""
        of_bearings = [prefixed(name, s) for name, b in self._own_bearings.items() for s in b.states]
        return (*self.rotor.states, *of_bearings)

    @property
    def initial_state(self) -> Array:
        """The states of rotor and bearings at t = 0."""
        of_bearings = [b.initial_state for b in self.bearings if b.states]  # type: ignore[attr-defined]
        return np.concatenate([self.rotor.initial_state, *of_bearings])

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return dx/dt with the bearings' forces at this state; FilmContactError as the bearings raise it."""
        whole, own, sensed = self._sensed(t, x, u)
        inputs = self._inputs(self._forces(t, own, self._pushes(t, whole, sensed), u), u)
        rates = [mount.rates(t, whole, sensed[mount.motion]) for mount in self.mounts]
        return np.concatenate([self.rotor.derivative(t, own, inputs), *rates])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the outputs of the rotor, the bearings' forces, and their further outputs."""
        whole, own, sensed = self._sensed(t, x, u)
        values = [mount.output(t, whole, sensed[mount.motion]) for mount in self.mounts]
        forces = self._forces(t, own, [v[: m.size] for m, v in zip(self.mounts, values, strict=True)], u)
        further = [value[mount.size :] for mount, value in zip(self.mounts, values, strict=True)]
        return np.concatenate([self.rotor.output(t, own, self._inputs(forces, u)), *forces, *further])

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives of rotor and bearings; the speed is held unless it is an input."""
        whole, _, sensed = self._sensed(t, x, u)
        parts = [mount.slopes(t, whole, sensed[mount.motion]) for mount in self.mounts]
        return self.joined(t, whole, u, parts)

    def joined(self, t: float, whole: Array, u: ArrayLike, parts: Sequence[Linearization]) -> Linearization:
        """Return the derivatives of rotor and bearings together, for given derivatives of the bearings."""
        own, sensed = self._sensed(t, whole, u)[1:]
        inputs = self._inputs(self._forces(t, own, self._pushes(t, whole, sensed), u), u)
        rotor, masses = self.rotor.linearization(t, own, inputs), None
        if self._heavy:
            rates = self.rotor.derivative(t, own, inputs)
            pairs = zip(self.mounts, parts, strict=True)
            parts = [_with_mass_slopes(mount, part, sensed, rotor, rates) for mount, part in pairs]
            masses = self._masses(sensed)
        return join(rotor, self.mounts, parts, self._free, masses)

    def native(self) -> NativeSpec | None:
        """Return rotor and bearings as one kernel of the C library; None if a part of them has none."""
        if type(self) is not MountedRotor or any(mount.size != len(PLANAR) for mount in self.mounts):
            return None
        return system_kernel(
            self.rotor,
            self._own_bearings,
            carried=self._taken,
            free=self._free,
            motion=[row for mount in self.mounts for row in mount.motion[:-1]],
            planes=self.planes,
        )

    def _sensed(self, t: float, x: ArrayLike, u: ArrayLike) -> tuple[Array, Array, Array]:
        """Return the whole state, that of the rotor, and the outputs of the rotor, which need no forces."""
        whole, given = np.asarray(x, dtype=float), np.zeros(self._input_count)
        given[list(self._free)] = np.asarray(u, dtype=float)
        own = whole[: self._split]
        return whole, own, self.rotor.output(t, own, given)

    def _pushes(self, t: float, whole: Array, sensed: Array) -> list[Array]:
        return [mount.push(t, whole, sensed[mount.motion]) for mount in self.mounts]

    def _forces(self, t: float, own: Array, forces: list[Array], u: ArrayLike) -> list[Array]:
        """Return the forces of the bearings, with those of their added masses.

        A bearing answers F - M a, a = V f(x, u) being the acceleration of its journal, f linear in the forces
        u, so (1 + M V B) (u - F) = -M V f(x, F) is solved for the forces, whatever the rotor: no exchange of
        accelerations, which diverges where the oil is heavier than the rotor.
        """
        if not self._heavy:
            return forces
        inputs = self._inputs(forces, u)
        rotor, rates = self.rotor.linearization(t, own, inputs), self.rotor.derivative(t, own, inputs)
        along = self._masses(self.rotor.output(t, own, inputs)) @ _velocities(rotor, self.mounts)
        joint = np.eye(len(along)) + along @ rotor.B[:, self._taken]
        whole = np.concatenate(forces) - np.linalg.solve(joint, along @ rates)
        return np.split(whole, np.cumsum([mount.size for mount in self.mounts])[:-1])

    def _masses(self, sensed: Array) -> Array:
        """Return the added masses of all journals [kg], block by block."""
        found = []
        for mount in self.mounts:
            at, n = sensed[mount.motion], mount.size
            found.append(port.mass_of(mount.reaction, at[:n], at[n : 2 * n], at[-1]))
        return block_diagonal(found)

    def _inputs(self, forces: Sequence[Array], u: ArrayLike) -> Array:
        whole = np.empty(self._input_count)
        whole[list(self._free)] = np.asarray(u, dtype=float)
        for mount, force in zip(self.mounts, forces, strict=True):
            whole[mount.force] = force
        return whole

    # Asked once: signals are made when they are asked for.
    @cached_property
    def mounts(self) -> list[Mount]:
        """Each bearing in its station."""
        return wired(self.rotor, self._own_bearings, "bearings")

    @cached_property
    def _split(self) -> int:
        return len(self.rotor.states)

    @cached_property
    def _input_count(self) -> int:
        return len(self.rotor.inputs)

    @cached_property
    def _heavy(self) -> bool:
        return any(port.inertial(bearing) is not None for bearing in self.bearings)

    @cached_property
    def _taken(self) -> list[int]:
        """Inputs of the rotor that are forces of the bearings."""
        return [k for mount in self.mounts for k in mount.force]

    @cached_property
    def _free(self) -> tuple[int, ...]:
        return tuple(k for k in range(self._input_count) if k not in self._taken)


def join(
    rotor: Linearization,
    mounts: Sequence[Mount],
    parts: Sequence[Linearization],
    free: Sequence[int],
    masses: Array | None = None,
) -> Linearization:
    """Return a rotor and reactions in its stations as one linear system.

    Parameters
    ----------
    rotor : Linearization
        Rotor without feedthrough of the reactions' forces to the outputs that they take.
    mounts : sequence of Mount
    parts : sequence of Linearization
        Parts of the reactions, over what each feels.
    free : sequence of int
        Inputs of the rotor that stay inputs; one that takes the force of a reaction is a load beside it.
    masses : ndarray, optional [kg]
        Added masses of all reactions, block by block.

    Returns
    -------
    Linearization
        States: of the rotor and of each reaction. Outputs: of the rotor, the forces of all reactions with
        those of their added masses, their further outputs.
    """
    A, forces, further = _reacting(mounts, parts, rotor.C)
    taken, free, size = [k for mount in mounts for k in mount.force], list(free), len(rotor.A)
    push, load = rotor.B[:, taken], rotor.B[:, free]
    inner, driven, beside = _driven(mounts, parts, rotor.D[:, free])
    if masses is not None:
        along = masses @ _velocities(rotor, mounts)
        joint = np.eye(len(masses)) + along @ push
        forces[:, :size] -= along @ rotor.A
        forces = np.asarray(np.linalg.solve(joint, forces), dtype=float)
        driven = np.asarray(np.linalg.solve(joint, driven - along @ load), dtype=float)
    A[:size] = push @ forces
    A[:size, :size] += rotor.A
    seen = rotor.D[:, taken] @ forces
    seen[:, :size] += rotor.C
    return Linearization(
        A,
        np.vstack([load + push @ driven, inner]),
        np.vstack([seen, forces, further]),
        np.vstack([rotor.D[:, free], driven, beside]),
    )


def _driven(
    mounts: Sequence[Mount], parts: Sequence[Linearization], through: Array
) -> tuple[Array, Array, Array]:
    """Return rates, forces and further outputs of all reactions by inputs of the rotor that they feel."""
    none = np.zeros((0, through.shape[1]))
    felt = [through[mount.motion] for mount in mounts]
    seen = [part.D @ one for part, one in zip(parts, felt, strict=True)]
    return (
        np.concatenate([none, *(part.B @ one for part, one in zip(parts, felt, strict=True))]),
        np.concatenate([none, *(rows[: mount.size] for mount, rows in zip(mounts, seen, strict=True))]),
        np.concatenate([none, *(rows[mount.size :] for mount, rows in zip(mounts, seen, strict=True))]),
    )


def _reacting(
    mounts: Sequence[Mount], parts: Sequence[Linearization], sense: Array
) -> tuple[Array, Array, Array]:
    """Return A, forces, further outputs of all reactions by the states of the rotor and their own."""
    size = sense.shape[1]
    total = size + sum(len(part.A) for part in parts)
    A, forces, further = np.zeros((total, total)), [np.zeros((0, total))], [np.zeros((0, total))]
    first = size
    for mount, part in zip(mounts, parts, strict=True):
        inner, felt = slice(first, first + len(part.A)), sense[mount.motion]
        A[inner, :size], A[inner, inner] = part.B @ felt, part.A
        seen = np.zeros((len(part.C), total))
        seen[:, :size], seen[:, inner] = part.D @ felt, part.C
        forces.append(seen[: mount.size])
        further.append(seen[mount.size :])
        first = inner.stop
    return A, np.concatenate(forces), np.concatenate(further)


def _with_mass_slopes(
    mount: Mount, part: Linearization, sensed: Array, rotor: Linearization, rates: Array
) -> Linearization:
    """Return the derivatives of a reaction with those of its added mass times the present acceleration."""
    heavy = port.inertial(mount.reaction)
    if heavy is None:
        return part
    at, n = sensed[mount.motion], mount.size
    slopes = heavy.mass_slopes(at[:n], at[n : 2 * n], at[-1])
    D = part.D.copy()
    D[:n] -= np.einsum("ijk,j->ik", slopes, rotor.C[mount.motion[n : 2 * n]] @ rates)
    return part._replace(D=D)


def _velocities(rotor: Linearization, mounts: Sequence[Mount]) -> Array:
    """Return the rows of the rates of all freedoms over the states of the rotor."""
    return np.concatenate([rotor.C[mount.motion[mount.size : 2 * mount.size]] for mount in mounts])


def block_diagonal(blocks: Sequence[Array]) -> Array:
    """Return a matrix with these square ones along its diagonal."""
    size = sum(map(len, blocks))
    whole, first = np.zeros((size, size)), 0
    for block in blocks:
        whole[first : first + len(block), first : first + len(block)] = block
        first += len(block)
    return whole


@arguments
def mount(rotor: Dynamic, bearings: port.Bearings) -> MountedRotor:
    """Return a rotor with bearings in some of its stations.

    If only the station without a name is left, `simulate`, `cosimulate` and `closed_loop` accept the result
    together with the bearing of that station. If none is left, it is a Dynamic model without inputs.

    Parameters
    ----------
    rotor : Dynamic
        The rotor; its outputs must not depend directly on the forces, as is true for every rotor of
        rotorfilm.
    bearings : mapping of str to Reaction
        Bearings by the name of the station. If a heat balance determines the temperature of a bearing, the
        temperature becomes a state.

    Raises
    ------
    InputError
        If the rotor has no such station, or a bearing does not fit.
    """
    port.require_reactions("bearings", bearings, heavy=True)
    for bearing in bearings.values():
        port.require_turning(bearing, rotor)
    return MountedRotor(
        rotor=rotor, stations=tuple(bearings), bearings=tuple(map(port.in_time, bearings.values()))
    )


# A rotor with its bearings as a kernel of the C library, where all of them have one.


KINDS = (
    "journal",
    "grooved_journal",
    "short_journal",
    "damper",
    "oil_damper",
    "short_damper",
    "polar_damper",
    "polar_journal",
    "reynolds_journal",
    "pressure_dam",
    "lobed_journal",
    "turbulent_journal",
)
"""Kernels that may be a bearing of a system, in the order of `native/systems/mounted_tables.c`."""


def system_kernel(
    rotor: Dynamic,
    bearings: port.Bearings,
    *,
    carried: Sequence[int],
    free: Sequence[int],
    motion: Sequence[int],
    planes: Sequence[UnbalancePlane] = (),
) -> NativeSpec | None:
    """Return the kernel of a rotor with bearings; None if a part of it has none.

    Parameters
    ----------
    rotor : Dynamic
        A `FlexibleRotor` or a `RigidRotor`, or one of them with its speed as an input.
    bearings : mapping of str to Reaction
        Bearings by station, at least one.
    carried, free : sequence of int
        Inputs of the rotor that are forces of the bearings, and the others.
    motion : sequence of int
        Outputs of the rotor that are x, y, vx, vy of the stations.
    planes : sequence of UnbalancePlane
        Unbalances that are parameters.
    """
    parts = [bearing.native() if isinstance(bearing, HasKernel) else None for bearing in bearings.values()]
    specs = [spec for spec in parts if spec is not None and spec.kernel in KINDS]
    matrices = _operators(rotor)
    if matrices is None or not specs or len(specs) < len(parts):
        return None
    operators, profile = matrices
    constant = profile is not None and len(profile.times) == 1
    speed = (native_parameter("constant_speed", profile.speeds[0]),) if profile and constant else ()
    free = [k for k in free if k < operators.push.shape[1]]
    own = [prefixed(name, p) for name, spec in zip(bearings, specs, strict=True) for p in spec.parameters]
    places, sets = _distinct(specs)
    kinds = [KINDS.index(spec.kernel) for spec in specs]
    set_there = [
        prefixed(plane.station, native_parameter(name, getattr(plane, name)))
        for plane in planes
        for name in ("unbalance", "unbalance_angle")
    ]
    force = [
        indices("rotor must have the inputs", names(rotor.inputs), station_names(one.station)[1])
        for one in planes
    ]
    return NativeSpec(
        kernel="rotor_system",
        parts=tuple(spec.kernel for spec in specs),
        parameters=(*own, *speed, *set_there),
        tables={
            **_matrices(operators, list(carried), list(free), list(motion)),
            **_unbalances(operators, planes, force),
            **(
                {}
                if profile is None
                else {name: np.array(getattr(profile, name)) for name in ("times", "speeds")}
            ),
            "bearings": np.column_stack([kinds, places]).astype(float),
            **{f"{k}.{name}": table for k, spec in enumerate(sets) for name, table in spec.tables.items()},
        },
    )


def _operators(rotor: Dynamic) -> tuple[Operators, SpeedProfile | None] | None:
    """Return the equations of a rotor and its speed over time, None where the speed is an input."""
    if isinstance(rotor, SpeedInputRotor):
        found = _operators(rotor.rotor)
        return found and (found[0], None)
    elastic = isinstance(rotor, FlexibleRotor) and rotor.structure.hysteresis is None
    if isinstance(rotor, FlexibleRotor | RigidRotor) and (elastic or type(rotor) is RigidRotor):
        return rotor.operators, rotor.profile
    return None


def _matrices(model: Operators, carried: list[int], free: list[int], motion: list[int]) -> dict[str, Array]:
    """Return the tables of the kernel; its rates of displacements are the states' second half already."""
    n = len(model.weight) // 2
    return {
        "steady": model.steady[n:],
        "spin": model.by_speed[n:],
        "push": model.push[n:, free],
        "carry": model.push[n:, carried],
        "weight": model.weight[n:, None],
        "sense": model.sense,
        "motion": model.sense[motion],
    }


def _unbalances(
    model: Operators, planes: Sequence[UnbalancePlane], force: Sequence[list[int]]
) -> dict[str, Array]:
    """Return the unbalance that is no parameter, and the accelerations by unit forces in the planes."""
    n = len(model.weight) // 2
    columns = [model.push[n:, pair] for pair in force]
    rest = model.unbalance[n:].copy()
    for plane, by in zip(planes, columns, strict=True):
        rest -= by @ unbalance_columns(plane.unbalance, plane.unbalance_angle)
    return {"unbalance": rest, "planes": np.hstack([np.zeros((n, 0)), *columns])}


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
