"""A bearing of tilting pads in SI units: a Reaction whose states are the tilts of its pads."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import InputError, UnloadedPadWarning, require_finite, require_number, warn_user
from ...core.inputs import quantities
from ...core.model import Array, Linearization, Tangent
from ...core.readable import Readable
from ...core.results import BearingLosses, Equilibrium
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native import Status
from ...native.pad_kernels import RestPoint, TiltingPoint
from ...native.spec import NativeSpec, journal_spec
from ..oil.heat_balance import FilmHeat, fed_temperature
from ..oil.heated_bearing import HeatedBearing
from ..reaction import (
    NOMINAL_SPEED,
    Called,
    Complex,
    ReducedCoefficients,
    StatesStiffness,
    broadcast_state,
    coefficients_of,
    input_vector,
    without_overflow,
)
from .pad_bearing import PadUnderJournal, losses_of_pads
from .pad_film import PadMapFilm, warn_beyond_map
from .pad_table import LossyPadFilm
from .tilting_pads import (
    TURN,
    PadSlopes,
    TiltingPads,
    directions,
    held_force,
    held_jacobian,
    pad_slopes,
    report_pads,
    turning,
)


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPadBearing(Called, TiltingPads):
    """A journal bearing of equal tilting pads: a Dynamic Reaction, whose states are the tilts.

    x and y are Cartesian from the bearing center, angles are from +x towards +y, rotation is about +z, the
    force acts on the journal. Pads without inertia tilt so that the film has no moment about their pivots;
    they are N states, not stiff. With inertia there are 2 N and the equations are stiff. A pad on a spring
    has the deflection of its pivot as a further state. A pad that loses its film stays as it is until the
    journal returns. Friction of film and pivots on the tilt, of the order clearance / radius, is left out.

    `equilibrium` finds position and pads at rest, `coefficients` what the journal feels, at a frequency that
    the result names, `at_rest().matrices` stiffness and damping of journal and pads together. `force` and
    `jacobian` are those of pads held at their start.

    Its parameters are those of `TiltingPads` and of every `PadBearing`.

    Examples
    --------
    >>> import math
    >>> from rotorfilm import even_pivots
    >>> bearing = TiltingPadBearing(
    ...     radius=0.05, length=0.05, viscosity=0.02, pivots=even_pivots(5), extent=math.pi / 3, preload=0.3,
    ...     assembled_clearance=7e-5)
    >>> [state.name for state in bearing.states]
    ['tilt_1', 'tilt_2', 'tilt_3', 'tilt_4', 'tilt_5']
    """

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.bore_clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, and load_1 .. load_N: the loads of the pivots."""
        force = self.nominal_force
        loads = (
            Signal(name=f"load_{k}", unit="N", nominal=force, description=f"load of the pivot of pad {k}")
            for k in range(1, len(self.pivots) + 1)
        )
        return (*force_outputs(force), *loads)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals tilt_1 .. tilt_N; of pivots on springs pivot_1 .. pivot_N; with inertia their rates."""
        c, pads = self.clearance, range(1, len(self.pivots) + 1)
        rows = [("tilt", "m", c, "tilt of pad {} as a length at the film, positive about +z")]
        if self.pivot_stiffness is not None:
            rows.append(("pivot", "m", c, "place of the pivot of pad {}, negative outward"))
        if self.pad_inertia is not None:
            fast = c * NOMINAL_SPEED
            rows += [(f"{name}_rate", "m/s", fast, f"rate of the {text}") for name, _, _, text in rows]
        return tuple(
            Signal(name=f"{name}_{k}", unit=unit, nominal=nominal, description=text.format(k))
            for name, unit, nominal, text in rows
            for k in pads
        )

    @cached_property
    def initial_state(self) -> Array:
        """State at t = 0, shape (n_states,): `start`, and rates 0."""
        if not self.start:
            return self.at_rest().state(np.zeros(2), 1.0)
        return self.moving(np.array(self.start))

    def at_rest(self) -> TiltingPadsAtRest:
        """Return the force on a journal at rest, each pad in its stable tilt."""
        return TiltingPadsAtRest(self)

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the state with the journal and all pads at rest, shape (n_states,)."""
        return self.at_rest().state(position, speed)

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow under a journal at rest; see `TiltingPadsAtRest.losses`."""
        return self.at_rest().losses(position, velocity, speed, full_gap=full_gap)

    def balanced_temperature(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> float:
        """Return the temperature at which the heat of the film balances under a journal at rest [K].

        Parameters and errors are those of `film_heat`.
        """
        if self.pivot_stiffness is None:
            return super().balanced_temperature(position, velocity, speed)

        # Springs give way to the load of the pads, and with it to the viscosity.
        def heat(temperature: float) -> FilmHeat:
            return self.at_temperature(temperature).film_heat(position, velocity, speed)

        return fed_temperature(heat, *self.cooled)

    def in_time(self, start_temperature: float | None = None) -> HeatedBearing:
        """Raise InputError: the heat of tilting pads is known at rest only."""
        raise InputError(
            "temperature must be stated for tilting pads in time, got None: bearing.at_temperature(T) has one"
        )

    def film_at_unit_viscosity(self) -> None:
        """Return no film for the loops in C over warm films, which know one film only."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Raise InputError: the heat of pads has no slopes."""
        raise InputError("bearing must have slopes of its heat, as a JournalBearing, got tilting pads")

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal with the pads held at their start, shape (2, ...) [N].

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the journal touches a pad; the message names it.
        """
        return self._held(held_force, position, velocity, speed)

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed) with the pads held at their start, shape (2, 5, ...)."""
        return self._held(held_jacobian, position, velocity, speed)

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return forces and pivot loads, shape (2 + N,) [N], at the state x and u = (x, y, vx, vy, speed)."""
        return self.evaluated(x, u).outputs

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, shape (n_states,)."""
        return self.evaluated(x, u).rates

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at the state x and u = (x, y, vx, vy, speed)."""
        found = self.evaluated(x, u, slopes=True).slopes
        assert found is not None
        return found

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        Nor has a subclass. Its parameters are the dimensions, with the clearance of the pads, and the
        viscosity; radius and length are fixed.
        """
        if type(self) is not TiltingPadBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        numbers = (
            *(self.extent, self.pivot_offset, self.preload, self.pivot_stiffness or 0.0),
            *(self.reduced_inertia, self.pad_mass or 0.0, self.slenderness),
        )
        tables = self.film.table(self.extent, self.slenderness).kernel().tables
        lengths = {name: float(getattr(self, name)) for name in ("radius", "length", "clearance")}
        return journal_spec(
            "tilting_journal" if self.pad_inertia is None else "heavy_tilting_journal",
            {"pivots": np.array(self.pivots), "pads": np.array(numbers), **tables},
            {**lengths, "viscosity": self.film_viscosity},
            fixed=True,
        )

    def portable(self) -> TiltingPadBearing:
        """Return this bearing with a film that carries the map it needs; see `model.Reaction`."""
        if not isinstance(self.film, PadMapFilm):
            return self
        table = self.film.table(self.extent, self.slenderness)
        return replace(self, film=replace(self.film, tables=(table,)))

    @property
    def _tilts(self) -> Array:
        return self.initial_state[: len(self.pivots)]

    def _held(
        self,
        answer: Callable[..., Array],
        position: ArrayLike,
        velocity: ArrayLike,
        speed: ArrayLike,
    ) -> Array:
        """Return what `held_force` or `held_jacobian` answers at states of any batch shape."""

        def law(q: Array, v: Array, omega: Array) -> Array:
            found = answer(self, np.stack([*q, *v, omega]).reshape(5, -1), self._tilts)
            return found.reshape(*found.shape[:-1], *omega.shape)

        return without_overflow(law, *broadcast_state(position, velocity, speed))

    def evaluated(self, x: ArrayLike, u: ArrayLike, *, slopes: bool = False) -> TiltingPoint:
        """Return rates and outputs, and if asked for their derivatives, at the state x and the input u."""
        state, values = require_finite("x", x), input_vector(u)
        if state.shape != (self.kernel.states,):
            raise InputError(f"x must have shape ({self.kernel.states},), got shape {state.shape}")
        point = self.kernel.at(values, state, slopes=slopes)
        report_pads(self, point.status, point.pad, values[:2])
        return point


# Tilting pads under a journal at rest: where they stand, what they carry, what a journal feels of them.


@dataclass(frozen=True, kw_only=True)
class TiltedPads(Readable):
    """Tilting pads at rest, one entry for each pad.

    Attributes
    ----------
    pivots : ndarray, shape (pads,) [rad]
        Angles of the pivots.
    tilts : ndarray, shape (pads,) [m]
        Tilt as a length: its angle times the distance from the pivot's center of rotation to the film. Of an
        unloaded pad the end of the tilts at which it has no film.
    pivot_deflections : ndarray, shape (pads,) [m]
        Of pivots on springs, negative outward.
    pad_loads : ndarray, shape (pads,) [N]
        On the pivots.
    film_thickness : ndarray, shape (pads,) [m]
        The least of each pad.
    unloaded : ndarray of bool, shape (pads,)
        Whether a pad has no film: its tilt is then not unique.
    """

    pivots: Array
    tilts: Array
    pivot_deflections: Array
    pad_loads: Array
    film_thickness: Array
    unloaded: NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class PadEquilibrium(Equilibrium):
    """The static position of a journal on tilting pads, and how these stand.

    Eccentricity ratios are in clearances of a pad, the least film is that of all pads.

    Attributes
    ----------
    pads : TiltedPads
        Tilts, loads and films.
    """

    pads: TiltedPads


@dataclass(frozen=True, eq=False)
class TiltingPadsAtRest:
    """The force of tilting pads on a journal at rest, each pad in the stable tilt that it takes there.

    Its slopes are the stiffness in slow motion. It has no damping of its own: see `coefficients`.

    Parameters
    ----------
    bearing : TiltingPads
    """

    bearing: TiltingPads

    @property
    def clearance(self) -> float:
        """Distance [m] that the journal stays within; see `TiltingPads.room`."""
        return self.bearing.room

    def force_noise(self, speed: float) -> float:
        """Return what roundoff leaves of the force [N]; see `PadBearing.force_noise`."""
        return self.bearing.force_noise(speed)

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least gap at a pivot [m]; see `TiltingPads.minimum_film`."""
        return self.bearing.minimum_film(position)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on a journal at rest, shape (2,) [N].

        It warns of pads without film, and of those beyond the map of their film.

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape, or the velocity is not 0.
        FilmContactError
            If the journal touches a pad, or a pad its journal with the leading end; the message names it.
        """
        point = self._point(position, velocity, speed)
        loose = np.flatnonzero(point.pads["unloaded"])
        if loose.size:
            angles = np.rad2deg(np.mod(self.bearing.pivots, 2.0 * np.pi))[loose]
            where = ", ".join(f"{angle:g}" for angle in angles)
            warn_user(
                f"pads {', '.join(map(str, loose + 1))} (pivots at {where} deg) are unloaded: they have no "
                "film and no unique tilt, and may flutter",
                UnloadedPadWarning,
            )
        if point.status == Status.OUTSIDE:
            warn_beyond_map(point.pads["least"], self.bearing.kernel.film)
        return point.force

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5), those by the velocity 0."""
        return self._point(position, velocity, speed).slopes

    def prepare_tangent(self) -> Tangent:
        """Return force and slopes as a function of five numbers."""

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            point = self._point((x, y), (vx, vy), speed)
            force_x, force_y = point.force.tolist()
            return force_x, force_y, point.slopes.ravel().tolist()

        return tangent

    def settled(self, found: Equilibrium) -> PadEquilibrium:
        """Return an equilibrium with the pads, whose clearance and least film are those it tells."""
        pads = self.pad_states(found.position, found.speed)
        known = {one.name: getattr(found, one.name) for one in fields(found)}
        known |= {
            "eccentricity_ratio": math.hypot(*found.position) / self.bearing.clearance,
            "minimum_film": float(pads.film_thickness.min()),
        }
        return PadEquilibrium(**known, pads=pads, reaction=self)

    def pad_states(self, position: ArrayLike, speed: float) -> TiltedPads:
        """Return the pads under a journal at rest.

        Parameters
        ----------
        position : array_like, shape (2,) [m]
        speed : float [rad/s]

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        pads = self._point(position, np.zeros(2), speed).pads
        return TiltedPads(
            pivots=np.array(self.bearing.pivots),
            tilts=pads["tilt"],
            pivot_deflections=pads["pivot"],
            pad_loads=pads["load"],
            film_thickness=pads["least"],
            unloaded=pads["unloaded"] > 0.0,
        )

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow; see `losses_of_pads`. None if the film law has none.

        The opening of a number is the gap behind the pad of that number, in the sense of +theta. Where
        `full_gap` is None, it is that of the cooling, or false. An unloaded pad has streamers only.

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        bearing = self.bearing
        if not isinstance(bearing.film, LossyPadFilm):
            return None
        found = self._point(position, velocity, speed).pads
        state = broadcast_state(position, velocity, speed)
        R, places = turning(bearing), np.stack([found["pivot"], found["tilt"]])
        local = np.einsum("kij,i->jk", directions(bearing.pivots), state[0])
        e = R @ ((local + places) / bearing.clearance + np.array([[bearing.preload], [0.0]]))
        forces = -R[:, :1] * found["load"]
        middles = np.array(bearing.pivots) + (0.5 - bearing.pivot_offset) * bearing.extent
        pads = [
            PadUnderJournal(bearing.extent, middle, e[:, k : k + 1], forces[:, k : k + 1])
            for k, middle in enumerate(middles.tolist())
        ]
        gap = bearing.full_gap(full_gap)
        return losses_of_pads(bearing, bearing.film, pads, state, full_gap=gap)

    def state(self, position: ArrayLike, speed: float) -> Array:
        """Return the states of the bearing at rest: tilts, places of sprung pivots, rates 0."""
        pads = self.pad_states(position, speed)
        sprung = self.bearing.pivot_stiffness is not None
        places = np.concatenate([pads.tilts, pads.pivot_deflections]) if sprung else pads.tilts
        return self.bearing.moving(places)

    def matrices(self, position: ArrayLike, speed: float, slopes: PadSlopes = pad_slopes) -> PadMatrices:
        """Return stiffness, damping and mass of journal and pads about their rest.

        With e = Q^T r / c + (m, q/c) of each pad they are sum B^T K_p B and sum B^T C_p B, B = [Q^T | e_t at
        its tilt] (and e_n at its pivot, where the stiffness of the spring adds).

        Raises
        ------
        InputError, FilmContactError
            As `force`.
        """
        bearing, pads = self.bearing, self.pad_states(position, speed)
        N, c, Q = len(bearing.pivots), bearing.clearance, directions(bearing.pivots)
        sprung = bearing.pivot_stiffness is not None
        local = np.einsum("kij,i->jk", Q, np.asarray(position, dtype=float))
        e = (local + np.stack([pads.pivot_deflections, pads.tilts])) / c + np.array(
            [[bearing.preload], [0.0]]
        )
        loaded = np.flatnonzero(~pads.unloaded)
        half = 0.5 * float(speed) * TURN
        by_e, by_w = slopes(bearing, e[:, loaded], half @ e[:, loaded])
        n = 2 + N * (2 if sprung else 1)
        K, C, M = np.zeros((3, n, n))
        for one, k in enumerate(loaded):
            B = np.zeros((2, n))
            B[:, :2] = Q[k].T
            B[1, 2 + k] = 1.0
            if sprung:
                B[0, 2 + N + k] = 1.0
            scale = -bearing.force_scale / c
            K += scale * B.T @ (by_e[..., one] + by_w[..., one] @ half) @ B
            C += scale * B.T @ by_w[..., one] @ B
        masses = [bearing.reduced_inertia] * N + [bearing.pad_mass or 0.0] * (n - 2 - N)
        M[range(2, n), range(2, n)] = masses
        if sprung:
            K[range(2 + N, n), range(2 + N, n)] += bearing.pivot_stiffness or 0.0
        return PadMatrices(
            stiffness=K,
            damping=C,
            mass=M,
            position=np.asarray(position, dtype=float),
            speed=float(speed),
            unloaded=pads.unloaded,
        )

    def coefficients(
        self, position: ArrayLike, speed: float, frequency: float | None = None
    ) -> ReducedCoefficients:
        """Return what the journal feels at a frequency [rad/s], by default that of the shaft.

        Without a frequency they are `MemoryCoefficients`: modes and thresholds of rotors go by K(s).
        """
        found = self.matrices(position, speed)
        if frequency is not None:
            return found.reduced(frequency)
        return coefficients_of(PadsStiffness(found), found.position, found.speed)

    def modes(self, position: ArrayLike, speed: float, rotor_mass: float) -> NDArray[np.complex128]:
        """Return the exponents of a rigid rotor on the pads; see `PadMatrices.modes`."""
        return self.matrices(position, speed).modes(rotor_mass)

    def _point(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> RestPoint:
        place, at_rest = require_finite("position", position), require_finite("velocity", velocity)
        if place.shape != (2,) or at_rest.shape != (2,) or at_rest.any():
            raise InputError(
                f"position must have shape (2,) and velocity be (0, 0) for pads at rest, got {position!r} "
                f"and {velocity!r}"
            )
        point = self.bearing.kernel.at_rest(place, require_number("speed", speed))  # type: ignore[arg-type]
        report_pads(self.bearing, point.status, point.pad, place)
        return point


# Stiffness and damping of journal and tilting pads together, and what of them a journal feels.


@dataclass(frozen=True, kw_only=True)
class PadMatrices(Readable):
    """Stiffness, damping and mass of journal and pads together at rest: M p'' + C p' + K p = 0.

    The coordinates p are x, y of the journal, the tilts q_1 .. q_N of the pads as lengths, and on springs the
    places s_1 .. s_N of their pivots, negative outward. A pad without film has rows of zeros, but for its
    spring.

    Attributes
    ----------
    stiffness : ndarray, shape (n, n) [N/m]
    damping : ndarray, shape (n, n) [N s/m]
    mass : ndarray, shape (n, n) [kg]
        Of the pads; that of the journal is 0.
    position : ndarray, shape (2,) [m]
    speed : float [rad/s]
    unloaded : ndarray of bool, shape (N,)
        Which pads have no film.
    """

    stiffness: Array
    damping: Array
    mass: Array
    position: Array
    speed: float
    unloaded: NDArray[np.bool_]

    def reduced(self, frequency: float, growth_rate: float = 0.0) -> ReducedCoefficients:
        """Return what the journal feels when it moves as exp(s t): the Schur complement of K + s C + s^2 M.

        Equal to Lund's (1964) assembly of single pads.

        Parameters
        ----------
        frequency : float [rad/s]
            Of the whirl, of either sign; 0 for the limit of slow motion.
        growth_rate : float [1/s]
            s = growth_rate + i frequency; 0 at frequency 0.

        Raises
        ------
        InputError
            If a number is not finite, or growth has no frequency.
        """
        nu, sigma = require_number("frequency", frequency), require_number("growth_rate", growth_rate)
        if nu == 0.0 and sigma != 0.0:
            raise InputError(f"growth_rate must be 0 at frequency 0, got {growth_rate!r}")
        s = complex(sigma, nu)
        Z, slope = self.dynamic_stiffness(s)
        C = slope.real if nu == 0.0 else Z.imag / nu
        return ReducedCoefficients(
            stiffness=Z.real - sigma * C,
            damping=C,
            position=self.position,
            speed=self.speed,
            frequency=nu,
            growth_rate=sigma,
        )

    def modes(self, rotor_mass: float) -> NDArray[np.complex128]:
        """Return the exponents of free motion of a rigid rotor and the pads, the least damped first [1/s].

        Parameters
        ----------
        rotor_mass : float [kg]
            That the bearing carries.
        """
        return StatesStiffness(self.linearization()).exponents(rotor_mass)

    def linearization(self) -> Linearization:
        """Return the loaded pads as states under a journal: inputs x, y, vx, vy, outputs its force.

        Velocities of what has mass are states; of what has none they follow from its balance.
        """
        kept = [0, 1, *self._loaded]
        K, C, M = (whole[np.ix_(kept, kept)] for whole in (self.stiffness, self.damping, self.mass))
        masses, n = np.diag(M), len(kept) - 2
        heavy = np.flatnonzero(masses > 0.0)
        light = np.array([k for k in range(2, n + 2) if masses[k] == 0.0], dtype=int)
        states = n + len(heavy)
        # Columns: places of the pads, velocities of the heavy ones, place and velocity of the journal.
        place, velocity = np.zeros((2, n + 2, states + 4))
        place[:, [states, states + 1, *range(n)]] = np.eye(n + 2)
        velocity[:2, states + 2 :] = np.eye(2)
        velocity[heavy, n:states] = np.eye(len(heavy))
        pull = K[light] @ place + C[light] @ velocity
        velocity[light] = -np.linalg.solve(C[np.ix_(light, light)], pull)
        force = -K @ place - C @ velocity
        rates = np.vstack([velocity[2:], force[heavy] / masses[heavy, None]])
        return Linearization(rates[:, :states], rates[:, states:], force[:2, :states], force[:2, states:])

    @property
    def _loaded(self) -> list[int]:
        """Coordinates of the pads that have a film."""
        pads = len(self.unloaded)
        return [k for k in range(2, len(self.stiffness)) if not self.unloaded[(k - 2) % pads]]

    def dynamic_stiffness(self, s: complex) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return Z(s) of the journal, shape (2, 2), and dZ/ds; s is an exponent [1/s]."""
        pads = self._loaded
        whole = self.stiffness + s * self.damping + s * s * self.mass
        slope = self.damping + 2.0 * s * self.mass
        if not pads:
            return whole[:2, :2], slope[:2, :2]
        inner = whole[np.ix_(pads, pads)]
        follow = np.vstack([np.eye(2), -np.linalg.solve(inner, whole[pads, :2])])
        push = np.hstack([np.eye(2), -np.linalg.solve(inner.T, whole[:2, pads].T).T])
        kept = [0, 1, *pads]
        return whole[:2, kept] @ follow, push @ slope[np.ix_(kept, kept)] @ follow


@dataclass(frozen=True)
class PadsStiffness:
    """K(s) of a journal on pads that follow it; see `DynamicStiffness`.

    Parameters
    ----------
    matrices : PadMatrices
        Of journal and pads together.
    """

    matrices: PadMatrices

    @property
    def at(self) -> Linearization:
        """The pads as states; see `StateSpaceStiffness`."""
        return self.matrices.linearization()

    def __call__(self, s: complex) -> tuple[Complex, Complex]:
        """Return K(s) [N/m] and dK/ds [N s/m]."""
        return self.matrices.dynamic_stiffness(s)

    def stiffness(self, s: complex) -> Complex:
        """Return K(s) [N/m] alone."""
        return self(s)[0]
