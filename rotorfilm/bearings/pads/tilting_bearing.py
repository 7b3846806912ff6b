"""A bearing of tilting pads in SI units: a Reaction whose states are the tilts of its pads."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    brief,
    require_finite,
    require_non_negative,
    require_number,
    require_positive,
    require_vector,
)
from ...core.inputs import quantities
from ...core.model import Array, Linearization
from ...core.results import BearingLosses
from ...core.signals import Signal, force_outputs, journal_inputs
from ...native import Status
from ...native.film_call import FilmCall
from ...native.pad_kernels import TiltingKernel, TiltingPoint
from ...native.spec import NativeSpec, journal_spec
from ..films.law import continued
from ..oil.heated_bearing import HeatedBearing
from ..reaction import NOMINAL_SPEED, Called, broadcast_state, input_vector, without_overflow
from .pad_bearing import OwnCenter, PadBearing
from .pad_film import PadFilm, PadMapFilm, fitted_pad_film, with_pad_tables
from .pads_at_rest import (
    FrozenTiltingPads,
    StaticTiltingPads,
    directions,
    gaps,
    held_force,
    held_jacobian,
    relative_travel_limit,
    report_pads,
    require_rotation,
    warn_of_pads,
)


@quantities
@dataclass(frozen=True, kw_only=True)
class TiltingPadBearing(Called, PadBearing):
    """A journal bearing of equal tilting pads: a Dynamic Reaction, whose states are the tilts.

    x and y are Cartesian from the bearing center, angles are from +x towards +y, rotation is about +z, the
    force acts on the journal. Pads without inertia tilt so that the film has no moment about their pivots;
    the N pads then have N states, and the equations are not stiff. With pad inertia there are 2 N states and
    the equations are stiff. A pad on a spring has the deflection of its pivot as a further state. A pad that
    loses its film keeps its tilt until the journal returns. The moments of film and pivot friction, of the
    order clearance / radius, are neglected.

    `equilibrium` finds the position and the tilts at rest. `coefficients` returns reduced K and C of the
    journal at a frequency, which the result names. `at_rest().matrices` has stiffness and damping of journal
    and pads together. `force` and `jacobian` hold the pads at their start.

    Dimensions, clearance and lubricant are the parameters of `PadBearing`. The assembled clearance c_b is the
    gap at a pivot around a centered journal. Eccentricities of ROSS and Someya are over c_b, those of Lund
    and Thomsen over c_p.

    Parameters
    ----------
    pivots : tuple of floats [rad]
        Angles of the pivots; `even_pivots` has them for a load on or between pads.
    extent : float [rad]
        Angle that a pad covers, below pi.
    pivot_offset : float [1]
        Share of the pad before its pivot, from its start in the positive sense. It is 0.5 in the middle, and
        more if the pivot is closer to the trailing end (positive rotation).
    preload : float [1]
        1 - c_b / c_p, below 1.
    pivot_stiffness : float or None [N/m]
        Stiffness of each pivot in the radial direction; None for rigid pivots.
    pad_inertia : float or None [kg m2]
        Moment of inertia of a pad about its pivot; None for pads without inertia.
    pivot_distance : float [m]
        Distance from the film to the center about which a pad rolls or rocks, behind it.
    pad_mass : float or None [kg]
        Mass of a pad that moves with the pivot. It is needed if both `pivot_stiffness` and `pad_inertia` are
        given, and only then.
    start : tuple of floats [m]
        Tilts of the pads at t = 0, as lengths, followed by the deflections of pivots on springs. Empty takes
        the tilts at rest around a centered journal with positive rotation.
    film : PadFilm
        The film law of a pad.

    Raises
    ------
    InputError
        As a `PadBearing`, and if another value breaks its rule, or the film cannot be that of pads of this
        extent and length/diameter.

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

    pivots: tuple[float, ...]
    extent: float
    pivot_offset: float = 0.5
    preload: float = 0.0
    pivot_stiffness: float | None = None
    pad_inertia: float | None = None
    pivot_distance: float = 0.0
    pad_mass: float | None = None
    start: tuple[float, ...] = ()
    film: PadFilm = field(default_factory=PadMapFilm)

    def __post_init__(self) -> None:
        require_positive("extent", self.extent)
        require_non_negative("pivot_distance", self.pivot_distance)
        for name in ("pivot_stiffness", "pad_inertia", "pad_mass"):
            if getattr(self, name) is not None:
                require_positive(name, getattr(self, name))
        if self.extent >= math.pi:
            raise InputError(f"extent must be below pi, got {self.extent!r}")
        if not 0.0 < require_number("pivot_offset", self.pivot_offset) < 1.0:
            raise InputError(f"pivot_offset must be within 0 and 1, got {self.pivot_offset!r}")
        if require_number("preload", self.preload) >= 1.0:
            raise InputError(f"preload must be below 1, got {self.preload!r}")
        super().__post_init__()
        heavy = self.pivot_stiffness is not None and self.pad_inertia is not None
        if heavy != (self.pad_mass is not None):
            rule = "with both pivot_stiffness and pad_inertia, and only then"
            raise InputError(f"pad_mass must be given {rule}, got {self.pad_mass!r}")
        film = fitted_pad_film(self.film, self.preloads, self.extents, self.slenderness)
        object.__setattr__(self, "film", film)
        self._check_pivots()

    def _check_pivots(self) -> None:
        angles = require_finite("pivots", self.pivots)
        if angles.ndim != 1 or not angles.size or np.min(gaps(angles)) < self.extent * (1.0 - 1e-12):
            rule = f"angles that differ by at least the extent of a pad, {self.extent:.6g} rad"
            raise InputError(f"pivots must be {rule}, got {brief(self.pivots)}")
        start = require_finite("start", self.start)
        if start.shape not in ((0,), (self.coordinates,)):
            raise InputError(f"start must hold no or {self.coordinates} numbers, got {brief(self.start)}")
        object.__setattr__(self, "pivots", tuple(angles.tolist()))
        object.__setattr__(self, "start", tuple(start.tolist()))

    @property
    def preloads(self) -> tuple[float]:
        """Preload of the pads [1]."""
        return (self.preload,)

    @property
    def extents(self) -> tuple[float]:
        """Angle that each pad covers [rad]."""
        return (self.extent,)

    @property
    def arcs(self) -> tuple[OwnCenter, ...]:
        """The pads as arcs of the film, without tilt."""
        own = {"extent": self.extent, "preload": self.preload, "offset": self.pivot_offset}
        return tuple(OwnCenter(start=at - self.pivot_offset * self.extent, **own) for at in self.pivots)

    @property
    def travel_limit(self) -> float:
        """Largest distance [m] of the journal center: the farthest corner that rigid pivots allow.

        For pivots on springs it is twice that. The pads themselves report contact.
        """
        return self.bore_clearance * relative_travel_limit(self.pivots) * self._yielding

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least gap at a pivot [m], shape (...), of journals at positions (2, ...) [m].

        It is zero or negative where no tilt leaves a film. For pivots on springs it is larger by the
        assembled clearance.
        """
        place = require_vector("position", position)
        along = directions(self.pivots)[:, :, 0] @ place.reshape(2, -1)
        return np.asarray(self.bore_clearance * self._yielding - along.max(axis=0).reshape(place.shape[1:]))

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError, which names the pad, if a journal at (2,) [m] touches it at any tilt."""
        if not self.minimum_film(position) > 0.0:
            along = directions(self.pivots)[:, :, 0] @ position
            report_pads(self, Status.AT_WALL, int(np.argmax(along)), position)

    @property
    def _yielding(self) -> float:
        return 1.0 if self.pivot_stiffness is None else 2.0

    @property
    def reduced_inertia(self) -> float:
        """Inertia of a pad over the square of the distance from its center of rotation to the film [kg]."""
        return (self.pad_inertia or 0.0) / (self.radius + self.pivot_distance) ** 2

    @cached_property
    def kernel(self) -> TiltingKernel:
        """The bearing in compiled code; InputError without a stated temperature."""
        self.require_temperature()
        return self.kernel_on(self.film_at_speed)

    def kernel_on(self, film: PadFilm) -> TiltingKernel:
        """Return the bearing in compiled code with another film, by default that of fresh oil."""
        return TiltingKernel(
            film.kernel(self.extent, self.slenderness),
            self.extent,
            self.pivot_offset,
            np.array(self.pivots),
            self.preload,
            self.clearance,
            self.force_scale,
            self.pivot_stiffness or 0.0,
            self.reduced_inertia,
            self.pad_mass or 0.0,
        )

    @property
    def coordinates(self) -> int:
        """Number of coordinates of all pads: tilts, and places of pivots on springs."""
        return len(self.pivots) * (1 if self.pivot_stiffness is None else 2)

    def moving(self, places: Array) -> Array:
        """Return the states of pads at given positions, with all rates equal to 0."""
        return places if self.pad_inertia is None else np.concatenate([places, np.zeros_like(places)])

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

    def at_rest(self) -> StaticTiltingPads:
        """Return the force on a journal at rest, each pad in its stable tilt."""
        return StaticTiltingPads(self)

    def on_frozen(self, film: Any) -> Any:
        """Return the pads on one film around all of them, without tilt, with a constant oil temperature."""
        return FrozenTiltingPads(self, film)

    def from_rest(self, position: ArrayLike, speed: float, temperature: float | None) -> TiltingPadBearing:
        """Return this bearing with initial tilts and temperature of a journal at rest at a position."""
        warm = self if temperature is None else self.at_temperature(temperature)
        pads = warm.at_rest().pad_states(position, speed)
        places = pads.tilts if self.pivot_stiffness is None else [*pads.tilts, *pads.pivot_deflections]
        return replace(warm, start=tuple(float(place) for place in places))

    def rest_state(self, position: ArrayLike, speed: float) -> Array:
        """Return the state in which the journal and all pads rest, shape (n_states,)."""
        return self.at_rest().state(position, speed)

    def rest_linearization(self, position: ArrayLike, speed: float) -> Linearization:
        """Return the derivatives with the tilts of loaded pads as states; see `core.port`."""
        require_rotation(speed)
        still = self.at_rest()
        pads = still.pad_states(position, speed)
        point = self.kernel.at(
            np.array([*np.asarray(position), 0.0, 0.0, speed]), still.state_of(pads), slopes=True
        )
        report_pads(self, point.status, point.pad, np.asarray(position))
        assert point.slopes is not None
        A, B, C, D = point.slopes
        if pads.unloaded.any():
            kept = np.resize(~pads.unloaded, len(A))
            A, B, C = A[kept][:, kept], B[kept], C[:, kept]
        return Linearization(A, B[:, :4], C[:2], D[:2, :4])

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses | None:
        """Return power loss, torques and oil flow under a journal at rest; see `StaticTiltingPads.losses`."""
        return self.at_rest().losses(position, velocity, speed, full_gap=full_gap)

    @property
    def reshapes(self) -> bool:
        """Whether the shape of the film depends on its viscosity: springs of pivots give way to the load."""
        return self.pivot_stiffness is not None or super().reshapes

    def in_time(self, start_temperature: float | None = None) -> HeatedBearing:
        """Raise InputError: the heat balance of tilting pads is modeled at rest only."""
        raise InputError(
            "temperature must be stated for tilting pads in time, got None: bearing.at_temperature(T) has one"
        )

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

    def call_with_states(self) -> FilmCall | None:
        """Return force and rates of the pads for loops in C (`rf_tilting_moving`); None of a subclass."""
        if type(self) is not TiltingPadBearing or self.is_warming:
            return None
        return self.kernel.call_with_states(continued(self.kernel.film))

    def outputs_over_time(self, states: Array, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the outputs at many states and motions, shape (2 + N, n); it warns of nothing.

        Parameters
        ----------
        states : ndarray, shape (n_states, n)
        position, velocity : ndarray, shape (2, n) [m], [m/s]
        speed : ndarray, shape (n,) [rad/s]

        Raises
        ------
        FilmContactError
            If the journal touches a pad; the message names it.
        """
        moments = zip(np.array([*position, *velocity, speed]).T, states.T, strict=True)
        points = [(u, self.kernel.at(u, x)) for u, x in moments]
        for u, point in points:
            report_pads(self, point.status, point.pad, u[:2])
        return np.array([point.outputs for _, point in points]).reshape(-1, len(self.outputs)).T

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; None if its film is no map.

        A subclass has no kernel either. The parameters of the kernel are the dimensions, with the clearance
        of the pads, and the viscosity; radius and length are fixed.
        """
        if type(self) is not TiltingPadBearing or not isinstance(self.film, PadMapFilm) or self.is_warming:
            return None
        numbers = (
            *(self.extent, self.pivot_offset, self.preload, self.pivot_stiffness or 0.0),
            *(self.reduced_inertia, self.pad_mass or 0.0, self.slenderness),
        )
        tables = self.film_at_speed.kernel(self.extent, self.slenderness).tables
        return journal_spec(
            "tilting_journal" if self.pad_inertia is None else "heavy_tilting_journal",
            {"pivots": np.array(self.pivots), "pads": np.array(numbers), **tables},
            self.dimensions,
            fixed=True,
        )

    def portable(self) -> TiltingPadBearing:
        """Return this bearing with a film that carries the map it needs; see `core.port.Reaction`."""
        found: TiltingPadBearing = with_pad_tables(self)
        return found

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
        warn_of_pads(self, point.status, point.pad)
        return point
