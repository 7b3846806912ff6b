"""A rotor as the bearings see it: its linear part in modes, whatever its size, and the forces it feels.

With x = (q, q') and weak springs and dampers at the journals, which the films give back, the rotor is

    x' = A x + B u,    u = (film force + K0 p + C0 p' at each journal, r(t)),

r(t) being the unbalance's pair and x counted from the rest under weight on those springs. In the modes
A V = V Lambda everything linear is exact and costs as many operations as there are modes; without the springs
a rotor that is free to move would have no complete set of modes. Of each conjugate pair one is kept.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...errors import ConvergenceError, InputError
from ...model import Array, Dynamic, Reaction
from ...rotors import (
    BaseMotion,
    FlexibleRotor,
    MountedRotor,
    RigidRotor,
    ShakenBaseRotor,
    SpeedProfile,
    translations,
)
from ...rotors.structure import NOMINAL_LENGTH, Structure, solved_equations
from .film_calls import FilmCall, film_call

Complex = np.ndarray

SUPPORTS = ((1.0, 0.3), (3.0, 0.3), (0.3, 0.3), (1.0, 1.0), (10.0, 1.0), (0.1, 0.1))
"""Springs and dampers at the journals, relative to their natural size, tried until the modes are distinct."""

GOOD_CONDITION = 1e6
"""Condition of the modes, in scaled coordinates, that is taken at once."""

LARGEST_CONDITION = 1e10


class Parts(NamedTuple):
    """A mounted rotor taken apart: matrices, speed, and bearings at some of the stations.

    Attributes
    ----------
    structure : Structure
    profile : SpeedProfile
    bearings : tuple of Reaction
    names : tuple of str
        Stations of the bearings.
    rows : ndarray, shape (2 n_bearings, N)
        Displacement of their journals.
    base : BaseMotion or None
        Of the ground; None where it is still.
    moved : ndarray, shape (N, 2)
        Coordinates of a translation of the rotor along x and y, none where the ground is still.
    """

    structure: Structure
    profile: SpeedProfile
    bearings: tuple[Reaction, ...]
    names: tuple[str, ...]
    rows: Array
    base: BaseMotion | None = None
    moved: Array = np.zeros((0, 0))

    @property
    def lengths(self) -> Array:
        """Typical displacement of each journal: its clearance, shape (n_bearings,) [m]."""
        sizes = [bearing.clearance for bearing in self.bearings]
        return np.array([size if math.isfinite(size) else NOMINAL_LENGTH for size in sizes])

    @property
    def nominal_speed(self) -> float:
        """Largest angular speed [rad/s], 0 where it does not turn."""
        return max(abs(value) for value in self.profile.speeds)

    @property
    def turns(self) -> bool:
        """Whether the matrices depend on the speed: a gyroscopic effect or rotating damping."""
        return bool(np.any(self.structure.gyroscopic) or np.any(self.structure.circulation))

    @property
    def speed(self) -> float:
        """The constant speed [rad/s]; raise InputError where it changes, or the ground shakes."""
        if self.base is not None:
            raise InputError("ground must be still for a periodic motion, got a ShakenBaseRotor")
        speeds = set(self.profile.speeds)
        if len(speeds) != 1:
            raise InputError(f"speed must be constant, got a profile over {self.profile.times!r} s")
        return float(speeds.pop())


class ModalRotor(NamedTuple):
    """The linear part of a mounted rotor in modes, at one speed.

    Attributes
    ----------
    parts : Parts
    values : ndarray of complex, shape (n_modes,) [1/s]
    shapes : ndarray of complex, shape (2 N, n_modes)
        State per modal coordinate: the state is the real part of their sum.
    inverse : ndarray of complex, shape (n_modes, 2 N)
    push : ndarray of complex, shape (n_modes, 2 n_bearings + 2)
        Modal force per film force and per unbalance pair; two columns more where the ground shakes.
    sense : ndarray of complex, shape (4 n_bearings, n_modes)
        x, y, vx, vy of each journal per modal coordinate.
    rest : ndarray, shape (2 N,)
        State under weight on the springs.
    spring, damper : ndarray, shape (2 n_bearings,) [N/m], [N s/m]
        K0 and C0.
    calls : tuple of FilmCall
    condition : float [1]
    """

    parts: Parts
    values: Complex
    shapes: Complex
    inverse: Complex
    push: Complex
    sense: Complex
    rest: Array
    spring: Array
    damper: Array
    calls: tuple[FilmCall, ...]
    condition: float

    @property
    def journal_rest(self) -> Array:
        """x, y, vx, vy of each journal at `rest`, shape (4 n_bearings,)."""
        return journal_rows(self.parts) @ self.rest

    def modal(self, state: Array) -> Complex:
        """Return the modal coordinates of a state (2 N,)."""
        return self.inverse @ (state - self.rest)

    def physical(self, modal: Complex) -> Array:
        """Return the states of modal coordinates (n_modes, ...)."""
        rest = self.rest.reshape(-1, *[1] * (modal.ndim - 1))
        return np.asarray((self.shapes @ modal).real + rest)


def take_apart(mounted: MountedRotor) -> Parts:
    """Return structure, speed and bearings of a rotor that rests in bearings without states.

    Raises
    ------
    InputError
        If the rotor is none with matrices, rests in no bearing, or in one with states.
    """
    found = mounted.all_bearings
    bare = mounted.bare
    structure, profile = _structure(bare.rotor if isinstance(bare, ShakenBaseRotor) else bare)
    names = [name for name in structure.stations if name in found]
    bearings = [found[name] for name in names]
    if not names:
        raise InputError("rotor must rest in at least one bearing: mount(rotor, {station: bearing})")
    moving = [name for name in names if found[name].states]
    if moving:
        raise InputError(
            f"bearings must have no states of their own here, got some at the stations {moving}: "
            "simulate(rotor, bearings) takes them, and unbalance_response their small motion"
        )
    places = [structure.stations.index(name) for name in names]
    rows = np.concatenate([structure.journals[2 * k : 2 * k + 2] for k in places])
    parts = Parts(structure, profile, tuple(bearings), tuple(names), rows)
    if isinstance(bare, ShakenBaseRotor):
        return parts._replace(base=bare.base, moved=translations(bare.rotor))
    return parts


def _structure(rotor: Dynamic) -> tuple[Structure, SpeedProfile]:
    if not isinstance(rotor, RigidRotor | FlexibleRotor):
        raise InputError(f"rotor must be a RigidRotor or a FlexibleRotor in its bearings, got {rotor!r}")
    if rotor.structure.hysteresis is not None:
        raise InputError("loss_factor must be 0 in large motion, where hysteresis is not a force")
    return rotor.structure, rotor.profile


def journal_rows(parts: Parts) -> Array:
    """Return the rows that make x, y, vx, vy of each journal out of (q, q'), shape (4 n_bearings, 2 N)."""
    count, size = parts.rows.shape
    rows = np.zeros((count // 2, 4, 2 * size))
    rows[:, :2, :size] = rows[:, 2:, size:] = parts.rows.reshape(-1, 2, size)
    return rows.reshape(2 * count, 2 * size)


def state_matrices(parts: Parts, speed: float) -> tuple[Array, Array, Array]:
    """Return A (2 N, 2 N) without films, B (2 N, 2 n_bearings + 2), the weight's acceleration (2 N,)."""
    model = solved_equations(parts.structure)
    places = [2 * parts.structure.stations.index(name) + axis for name in parts.names for axis in range(2)]
    pushes = [model.push[:, places], model.unbalance]
    if parts.base is not None:
        pushes.append(np.vstack([np.zeros_like(parts.moved), -parts.moved]))
    return (
        model.steady + speed * model.spin,
        np.hstack(pushes),
        model.weight,
    )


def spin_rates(modal: ModalRotor) -> tuple[Array, Array]:
    """Return what a rad/s more than the speed of the modes adds to the rates of the modal coordinates.

    Returns
    -------
    matrix : ndarray, shape (2 n_modes, 2 n_modes)
        Per real and imaginary part, of real and imaginary part.
    rest : ndarray, shape (2 n_modes,)
        At the rest.
    """
    spin = modal.inverse @ solved_equations(modal.parts.structure).spin
    seen, rest = spin @ np.hstack([modal.shapes.real, -modal.shapes.imag]), spin @ modal.rest
    return np.vstack([seen.real, seen.imag]), np.concatenate([rest.real, rest.imag])


def modal_rotor(parts: Parts, speed: float) -> ModalRotor:
    """Return the linear part of a rotor at one speed in modes.

    Raises
    ------
    ConvergenceError
        If no springs at the journals make its modes distinct.
    """
    A, B, weight = state_matrices(parts, speed)
    stiffness, rate = _natural_support(parts, speed)
    best: tuple[tuple[Complex, Complex, Complex, float], Array, Array, Array] | None = None
    for spring, damper in SUPPORTS:
        K0 = spring * np.outer(stiffness, (1.0, 1.3)).ravel()
        C0 = damper / spring * K0 / rate
        shifted = A - B[:, : len(K0)] @ _support_rows(parts, K0, C0)
        found = modes(shifted, rate)
        if best is None or found[3] < best[0][3]:
            best = found, K0, C0, shifted
        if found[3] < GOOD_CONDITION:
            break
    assert best is not None
    (values, shapes, inverse, condition), K0, C0, shifted = best
    if not condition < LARGEST_CONDITION:
        raise ConvergenceError(f"modes of the rotor must be distinct, got a condition of {condition:.3g}")
    return ModalRotor(
        parts=parts,
        values=values,
        shapes=shapes,
        inverse=inverse,
        push=inverse @ B,
        sense=journal_rows(parts) @ shapes,
        rest=np.asarray(-np.linalg.solve(shifted, weight)),
        spring=K0,
        damper=C0,
        calls=tuple(film_call(bearing) for bearing in parts.bearings),
        condition=condition,
    )


def _natural_support(parts: Parts, speed: float) -> tuple[Array, float]:
    """Return the size of the stiffness at each bearing [N/m], and a typical rate [1/s]."""
    count, s = len(parts.bearings), parts.structure
    load = float(np.linalg.norm(s.weight)) / count
    # A rigid translation is what the journals' rows see with a weight of one.
    mass = float(np.trace(s.mass)) / (2.0 * count)
    stiffness = load / parts.lengths + 0.01 * mass * speed**2
    if not np.all(stiffness > 0.0):
        stiffness = np.full(count, float(np.abs(s.stiffness).max()) or 1.0)
    return stiffness, abs(speed) or math.sqrt(float(stiffness.max()) / mass)


def _support_rows(parts: Parts, spring: Array, damper: Array) -> Array:
    return np.hstack([spring[:, None] * parts.rows, damper[:, None] * parts.rows])


def modes(A: Array, rate: float) -> tuple[Complex, Complex, Complex, float]:
    """Return eigenvalues, shapes, their inverse and condition; one of each pair, real parts to be added."""
    n = len(A) // 2
    scale = np.repeat([1.0, rate], n)
    values, vectors = np.linalg.eig(A * scale / scale[:, None])
    try:
        inverse = np.linalg.inv(vectors)
    except np.linalg.LinAlgError:
        return values, vectors, vectors, np.inf
    condition = float(np.linalg.norm(vectors, 1) * np.linalg.norm(inverse, 1))
    inverse = inverse / scale
    kept = values.imag >= 0.0
    weight = np.where(values.imag > 0.0, 2.0, 1.0)
    return (
        values[kept].astype(complex),
        (scale[:, None] * vectors * weight)[:, kept],
        inverse[kept],
        condition,
    )
