"""A bearing of tilting pads in SI units: a Reaction whose states are the tilts of its pads."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import (
    InputError,
    brief,
    require_each,
    require_finite,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
)
from ....inputs.si_arguments import quantities
from ....model import Array, Linearization
from ....native.tilting_kernel import TiltingKernel, TiltingPoint
from ....signals import Signal, force_outputs, journal_inputs
from ...reaction import NOMINAL_SPEED, Called, broadcast_state, input_vector
from ..pad_film import PadFilm, PadGridFilm
from .held_pads import held_jacobian
from .pad_contact import report_pads
from .pads_at_rest import TiltingPadsAtRest
from .pivots import gaps, reach


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPadBearing(Called):
    """A journal bearing of equal tilting pads: a Dynamic Reaction, whose states are the tilts.

    x and y are Cartesian from the bearing center, angles are from +x towards +y, rotation is about +z, the
    force acts on the journal. Pads without inertia tilt so that the film has no moment about their pivots; they
    are N states, not stiff. With inertia there are 2 N and the equations are stiff. A pad on a spring has the
    deflection of its pivot as a further state. A pad that loses its film stays as it is until the journal
    returns. Friction of film and pivots on the tilt, of the order clearance / radius, is left out.

    `equilibrium` finds position and pads at rest, `coefficients` what the journal feels, at a frequency that the
    result names, `matrices` stiffness and damping of journal and pads together. `force` and `jacobian` are those
    of pads held at their start.

    Clearances: c_p of a pad is its radius of curvature less that of the journal, c_b that of the assembled
    bearing is the gap at a pivot around a centered journal, and preload = 1 - c_b / c_p. Eccentricities of ROSS and
    Someya are over c_b, those of Lund and Thomsen over c_p.

    Parameters
    ----------
    radius : float [m]
        Of the journal; or `diameter`, twice that.
    length : float [m]
        Axial length of the pads.
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    pivots : tuple of floats [rad]
        Angles of the pivots; `even_pivots` has them for a load on or between pads.
    extent : float [rad]
        Angle that a pad covers, below pi.
    pivot_offset : float [1]
        Share of a pad before its pivot, from its start in the positive sense: .5 in the middle, more
        towards the trailing end of a journal that turns in that sense.
    preload : float [1]
        1 - c_b / c_p, below 1.
    pad_clearance : float or None [m]
        c_p; give this or the assembled one.
    assembled_clearance : float or None [m]
        c_b; give this or that of the pads.
    pivot_stiffness : float or None [N/m]
        Of a spring below each pivot, along its direction; None for rigid ones.
    pad_inertia : float or None [kg m2]
        Of a pad about its pivot; None for pads that follow at once.
    pivot_distance : float [m]
        From the film back to the center about which a pad rolls or rocks.
    pad_mass : float or None [kg]
        That moves with the pivot; needed with `pivot_stiffness` and `pad_inertia` together, and only then.
    start : tuple of floats [m]
        Tilts of the pads at t = 0, as lengths, and after them deflections of pivots on springs; empty for those
        at rest around a centered journal that turns in the positive sense.
    film : PadFilm
        The film law of a pad.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """

    radius: float
    length: float
    viscosity: float
    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float = 0.5
    preload: float = 0.0
    pad_clearance: float | None = None
    assembled_clearance: float | None = None
    pivot_stiffness: float | None = None
    pad_inertia: float | None = None
    pivot_distance: float = 0.0
    pad_mass: float | None = None
    start: tuple[float, ...] = ()
    film: PadFilm = field(default_factory=PadGridFilm)

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "length", "viscosity", "extent")
        require_each(self, require_non_negative, "pivot_distance")
        for name in ("pad_clearance", "assembled_clearance", "pivot_stiffness", "pad_inertia", "pad_mass"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        if self.extent >= math.pi:
            raise InputError(f"extent must be below pi, got {self.extent!r}")
        if not 0.0 < require_number("pivot_offset", self.pivot_offset) < 1.0:
            raise InputError(f"pivot_offset must be within 0 and 1, got {self.pivot_offset!r}")
        if require_number("preload", self.preload) >= 1.0:
            raise InputError(f"preload must be below 1, got {self.preload!r}")
        if (self.pad_clearance is None) == (self.assembled_clearance is None):
            given = f"{self.pad_clearance!r} and {self.assembled_clearance!r}"
            raise InputError(f"pad_clearance and assembled_clearance must be given one of both, got {given}")
        if self.film_clearance >= self.radius:
            raise InputError(f"pad clearance must be below the radius, got {self.film_clearance!r}")
        heavy = self.pivot_stiffness is not None and self.pad_inertia is not None
        if heavy != (self.pad_mass is not None):
            rule = "with both pivot_stiffness and pad_inertia, and only then"
            raise InputError(f"pad_mass must be given {rule}, got {self.pad_mass!r}")
        require_kind("film", self.film, PadFilm, "a film of pads such as PadGridFilm()")
        self._check_pivots()

    def _check_pivots(self) -> None:
        angles = require_finite("pivots", self.pivots)
        if angles.ndim != 1 or not angles.size or np.min(gaps(angles)) < self.extent * (1.0 - 1e-12):
            rule = f"angles at least the extent {self.extent!r} apart"
            raise InputError(f"pivots must be {rule}, got {brief(self.pivots)}")
        start, count = require_finite("start", self.start), len(angles) * (2 if self.pivot_stiffness else 1)
        if start.shape not in ((0,), (count,)):
            raise InputError(f"start must hold no or {count} numbers, got {brief(self.start)}")
        object.__setattr__(self, "pivots", tuple(angles.tolist()))
        object.__setattr__(self, "start", tuple(start.tolist()))

    @property
    def film_clearance(self) -> float:
        """Clearance c_p of a pad [m], in which its film is measured."""
        if self.pad_clearance is not None:
            return self.pad_clearance
        return float(self.assembled_clearance or math.nan) / (1.0 - self.preload)

    @property
    def bore_clearance(self) -> float:
        """Clearance c_b of the assembled bearing [m]."""
        return self.film_clearance * (1.0 - self.preload)

    @property
    def clearance(self) -> float:
        """Distance [m] that the journal center stays within: the farthest corner that rigid pivots leave.

        Pivots on springs may give way: twice that. The pads themselves say where they are touched.
        """
        return self.bore_clearance * reach(self.pivots) * (2.0 if self.pivot_stiffness else 1.0)

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    @property
    def force_scale(self) -> float:
        """Viscosity * length * radius^3 / c_p^2 [N s], the film's unit of force per 1/s."""
        return self.viscosity * self.length * self.radius**3 / self.film_clearance**2

    @property
    def reduced_inertia(self) -> float:
        """Inertia of a pad over the square of the distance from its center of rotation to the film [kg]."""
        return (self.pad_inertia or 0.0) / (self.radius + self.pivot_distance) ** 2

    @cached_property
    def kernel(self) -> TiltingKernel:
        """The bearing in compiled code."""
        return TiltingKernel(
            self.film.kernel(self.extent, self.slenderness),
            self.extent,
            self.pivot_offset,
            np.array(self.pivots),
            self.preload,
            self.film_clearance,
            self.force_scale,
            self.pivot_stiffness or 0.0,
            self.reduced_inertia,
            self.pad_mass or 0.0,
        )

    @property
    def inputs(self) -> tuple[Signal, ...]:
        """Signals x, y, vx, vy, speed."""
        return journal_inputs(self.bore_clearance, NOMINAL_SPEED)

    @property
    def outputs(self) -> tuple[Signal, ...]:
        """Signals force_x, force_y, and load_1 .. load_N: the loads of the pivots."""
        force = self.force_scale * NOMINAL_SPEED * min(1.0, self.slenderness**2)
        loads = (
            Signal(name=f"load_{k}", unit="N", nominal=force, description=f"load of the pivot of pad {k}")
            for k in range(1, len(self.pivots) + 1)
        )
        return (*force_outputs(force), *loads)

    @property
    def states(self) -> tuple[Signal, ...]:
        """Signals tilt_1 .. tilt_N; of pivots on springs, pivot_1 .. pivot_N; of pads with inertia, their rates."""
        c, pads = self.film_clearance, range(1, len(self.pivots) + 1)
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
        places = np.array(self.start, dtype=float)
        return places if self.pad_inertia is None else np.concatenate([places, 0.0 * places])

    def at_rest(self) -> TiltingPadsAtRest:
        """Return the force on a journal at rest, each pad in its stable tilt."""
        return TiltingPadsAtRest(self)

    def force(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the force on the journal with the pads held at their start, shape (2, ...) [N].

        Raises
        ------
        InputError
            If an argument is not finite or of the wrong shape.
        FilmContactError
            If the journal touches a pad; the message names it.
        """
        u = _states(position, velocity, speed)
        tilts = np.broadcast_to(self._tilts[:, None], (len(self.pivots), u[0].size))
        return self.held_force(u.reshape(5, -1), tilts).reshape(2, *u.shape[1:])

    def held_force(self, u: Array, tilts: Array, rates: Array | None = None) -> Array:
        """Return the force on the journal at given tilts, shape (2, n) [N].

        Parameters
        ----------
        u : ndarray, shape (5, n)
            x, y [m], vx, vy [m/s] and speed [rad/s].
        tilts, rates : ndarray, shape (pads, n) [m], [m/s]
            Tilts of the pads and how they change; rates are 0 by default. Pivots are in their place.
        """
        batch = self.kernel.forces(u, tilts, np.zeros_like(tilts) if rates is None else rates)
        state, pad = divmod(batch.first, len(self.pivots))
        report_pads(self, batch.status, pad, u[:2, state])
        return batch.values

    def jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return d force / d (x, y, vx, vy, speed) with the pads held at their start, shape (2, 5, ...)."""
        u = _states(position, velocity, speed)
        return held_jacobian(self, u.reshape(5, -1), self._tilts).reshape(2, 5, *u.shape[1:])

    def output(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return forces and pivot loads, shape (2 + N,) [N], at the state x and u = (x, y, vx, vy, speed)."""
        return self._at(x, u).outputs

    def derivative(self, t: float, x: ArrayLike, u: ArrayLike) -> Array:
        """Return the rates of the states, shape (n_states,)."""
        return self._at(x, u).rates

    def linearization(self, t: float, x: ArrayLike, u: ArrayLike) -> Linearization:
        """Return the exact derivatives at the state x and u = (x, y, vx, vy, speed)."""
        found = self._at(x, u, slopes=True).slopes
        assert found is not None
        return found

    @property
    def _tilts(self) -> Array:
        return self.initial_state[: len(self.pivots)]

    def _at(self, x: ArrayLike, u: ArrayLike, *, slopes: bool = False) -> TiltingPoint:
        state, values = require_finite("x", x), input_vector(u)
        if state.shape != (self.kernel.states,):
            raise InputError(f"x must have shape ({self.kernel.states},), got shape {state.shape}")
        point = self.kernel.at(values, state, slopes=slopes)
        report_pads(self, point.status, point.pad, values[:2])
        return point


def _states(position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
    """Return x, y, vx, vy, speed as one array, shape (5, ...)."""
    q, v, omega = broadcast_state(position, velocity, speed)
    return np.stack([*q, *v, omega])
