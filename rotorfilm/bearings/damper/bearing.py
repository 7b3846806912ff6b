"""The squeeze-film damper with a solid or porous cage, in SI units."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ...core.errors import (
    InputError,
    require_each,
    require_inside,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array
from ...core.port import Tangent, tangent_of
from ...core.signals import MOTION_NAMES
from ...native.film_call import FilmCall
from ...native.film_kernels import OilDamperKernel, OilParts, OilScales
from ...native.spec import NativeParameter, NativeSpec
from ..films.geometry import FullFilm, HalfSommerfeld
from ..films.law import BoundKernel, options
from ..films.polar_table import polar_tables
from ..reaction import NOMINAL_SPEED, InertialModel, broadcast_state, require_size
from .squeeze_films import (
    LARGEST,
    FiniteSqueezeFilm,
    KernelSqueezeFilm,
    LayerModes,
    PorousLayer,
    SqueezeFilm,
    layer_modes,
)
from .squeeze_inertia import (
    FilmSegment,
    SegmentedDamper,
    SqueezeImpedance,
    require_inertia_range,
    warn_of_length,
    warn_of_short_seals,
)
from .squeeze_laws import (
    LARGEST_TABULATED,
    EndSeal,
    FilmInertia,
    LinearSqueezeFilm,
    RadialTable,
    SealedShortFilm,
    ShortSqueeze,
    SqueezeCase,
    SqueezeLaw,
    SqueezeOptions,
)

# The cage of a damper, and what feeds lubricant to its film.


@quantities
@dataclass(frozen=True, kw_only=True)
class PorousCage:
    """A porous ring around the film with Darcy's law, k(y) = permeability exp(grading y/thickness), y <= 0.

    Parameters
    ----------
    thickness : float [m]
        H, radial thickness of the layer.
    permeability : float [m2]
        A, permeability through the layer at the face to the film.
    grading : float [1]
        lambda; positive where the layer is tighter at its back.
    anisotropy : float [1]
        k_z/k_y: permeability along the layer, per that through it.
    vented : bool
        Whether the back of the layer is open to `supply_pressure`; otherwise it is sealed.
    supply_pressure : float [Pa]
        Gauge pressure at a vented back.
    thin : bool
        Morgan & Cameron's layer in place of Darcy's: no pressure drop through a sealed layer, no flow along a
        vented one.

    Raises
    ------
    InputError
        If a value breaks its rule, or there is a supply pressure behind a sealed back.
    """

    thickness: float
    permeability: float
    grading: float = 0.0
    anisotropy: float = 1.0
    vented: bool = False
    supply_pressure: float = 0.0
    thin: bool = False

    def __post_init__(self) -> None:
        require_each(self, require_positive, "thickness", "permeability", "anisotropy")
        require_each(self, require_number, "grading", "supply_pressure")
        if self.supply_pressure and not self.vented:
            raise InputError(f"supply_pressure must be 0 behind a sealed back, got {self.supply_pressure!r}")

    def layer(self, length: float, clearance: float) -> PorousLayer:
        """Return this cage in the units of a film of a length and a clearance [m]."""
        return PorousLayer(
            permeability_number=self.permeability * self.thickness / clearance**3,
            grading=self.grading,
            thickness_ratio=self.thickness / length,
            anisotropy=self.anisotropy,
            vented=self.vented,
            thin=self.thin,
        )


@quantities
@dataclass(frozen=True, kw_only=True)
class RadialFeed:
    """Radial oil feed with a given velocity, at the back of a sealed porous layer or at the film.

    Darcy's law gives the share of the flow that reaches the film; the rest leaves through the ends of the
    layer (95 % reaches the film at H/L = 0.1). With a thin layer or a solid cage (jets) all of it does.

    Parameters
    ----------
    inflow : float [m/s]
        Largest velocity along the axis, towards the film; negative for suction.
    cosine : bool
        Whether the velocity falls as cos(pi z/length) from the middle to the ends; otherwise it is uniform.
    at_film : bool
        Whether `inflow` is the velocity at the film without pressure; otherwise it is that at the back of the
        layer, as in Akhverdiev et al. (11).
    """

    inflow: float
    cosine: bool = False
    at_film: bool = False

    def __post_init__(self) -> None:
        require_number("inflow", self.inflow)


@quantities
@dataclass(frozen=True, kw_only=True)
class AxialFeed:
    """Lubricant fed at the ends of film and layer.

    Parameters
    ----------
    start_pressure : float [Pa]
        Gauge pressure at the end of negative z. Zero is the pressure at which the film ruptures.
    end_pressure : float [Pa]
        Gauge pressure at the end of positive z.
    """

    start_pressure: float
    end_pressure: float

    def __post_init__(self) -> None:
        require_number("start_pressure", self.start_pressure)
        require_number("end_pressure", self.end_pressure)


# The squeeze-film damper with a solid or porous cage, in SI units.


LARGEST_RATIO = 0.5
"""Largest thickness / radius of a layer that may be unrolled to a plane."""


@quantities
@dataclass(frozen=True, kw_only=True)
class SqueezeFilmDamper(InertialModel):
    """A squeeze-film damper: a Reaction whose journal does not spin, so the speed has no effect.

    Parameters
    ----------
    radius : float [m]
        Radius of the film.
    length : float [m]
        Axial length of the film.
    clearance : float [m]
        Radial clearance.
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    cage : PorousCage or None
        None for a solid cage.
    extent : FullFilm or HalfSommerfeld
        Full film, including negative pressures, or one whose negative pressures are dropped. Without feed the
        latter is the half circle towards which the rotor moves.
    feed : RadialFeed or AxialFeed, optional
        Feed in addition to a supply pressure at a vented back of the cage.
    film : SqueezeLaw
        `ShortSqueeze()`, `FiniteSqueeze()`, and their maps `MapSqueeze()` and `FiniteMapSqueeze()`.
        `PublishedSqueeze()` reproduces a published film. All of them run in C inside an FMU.
    seals : EndSeal or None
        Seals at both ends of a solid cage without feed; None for open ends.
    density : float [kg/m3]
        Density of the oil, for a film with fluid inertia: F = `force` - `mass` acceleration. It needs a solid
        cage without feed. 0 neglects inertia.

    Raises
    ------
    InputError
        If a value breaks its rule, or the film cannot represent the extent, the feed, the seals or the
        inertia.

    Warns
    -----
    ValidityWarning
        If the short film is used beyond length / diameter 0.25; the warning states its error.

    Notes
    -----
    Equations of Cusano & Funk (1977) without the wedge term, since the race does not spin. Full films have F
    = -(a w + b (e.w) e + k e), w = velocity/clearance, in closed form, also at the center. Fluid inertia is
    of first order in the squeeze Reynolds number, frequency clearance^2 density/viscosity: a full film is
    valid up to 10, a ruptured film up to 5; see `require_range`.
    """

    radius: float
    length: float
    clearance: float
    viscosity: float
    cage: PorousCage | None = None
    extent: FullFilm | HalfSommerfeld = field(default_factory=HalfSommerfeld)
    feed: RadialFeed | AxialFeed | None = None
    film: SqueezeLaw = field(default_factory=ShortSqueeze)
    seals: EndSeal | None = None
    density: float = 0.0

    def __post_init__(self) -> None:
        require_size(self, "viscosity")
        require_kind("cage", self.cage, PorousCage | None, "a PorousCage or None")
        require_kind("extent", self.extent, FullFilm | HalfSommerfeld, "FullFilm() or HalfSommerfeld()")
        require_kind("feed", self.feed, RadialFeed | AxialFeed | None, "a RadialFeed, an AxialFeed or None")
        require_kind("film", self.film, SqueezeLaw, "a squeeze film such as ShortSqueeze()")
        if self._back_is_open and isinstance(self.feed, RadialFeed):
            raise InputError("feed must not be a RadialFeed where the back of the cage is vented, got both")
        require_kind("seals", self.seals, EndSeal | None, "an EndSeal or None")
        require_non_negative("density", self.density)
        for name in ("seals", "density"):
            given = getattr(self, name)
            if given and (self.cage is not None or self.feed is not None):
                raise InputError(f"{name} must not be given with a porous cage or a feed, got {given!r}")
        if self.density:
            _ = self.film_inertia
        _ = self.bound_film
        self._warn()

    @property
    def slenderness(self) -> float:
        """Length / diameter [1]."""
        return self.length / (2.0 * self.radius)

    @property
    def force_scale(self) -> float:
        """Viscosity * radius * length^3 / clearance^2 [N s], the film's unit of force per 1/s."""
        length, clearance = self.length, self.clearance
        return self.viscosity * self.radius * (length * length * length) / (clearance * clearance)

    @property
    def nominal_force(self) -> float:
        """Typical force at NOMINAL_SPEED [N]."""
        return self.force_scale * NOMINAL_SPEED

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Largest eccentricity ratio of the film: the last node of a map; 0.95 to 0.99 for others."""
        reach = self._options.largest_eccentricity_ratio
        if isinstance(self.bound_film, RadialTable):
            reach = LARGEST_TABULATED
        return min(reach, self.film_inertia.reach)

    @property
    def is_built(self) -> bool:
        """Whether the damper has seals or fluid inertia."""
        return self.seals is not None or self.has_inertia

    @property
    def is_fed(self) -> bool:
        """Whether the force has a part that comes from a feed, so that the film has no potential."""
        case = self.squeeze_case
        return bool(np.any(case.feed) or (case.cavitated and np.any(case.ends)))

    @cached_property
    def layer(self) -> PorousLayer | None:
        """The cage in the film's units; None for a solid one."""
        return None if self.cage is None else self.cage.layer(self.length, self.clearance)

    @cached_property
    def bound_film(self) -> SqueezeFilm:
        """The film law in this damper's dimensions."""
        return self.film.bind(self.squeeze_case)

    @cached_property
    def polar_tables(self) -> dict[str, Array]:
        """Tables of a full film without map, for the C library; of a film of finite length in two seconds."""
        return polar_tables(self.bound_film.jacobian, LARGEST, self.slenderness)

    @cached_property
    def film_in_c(self) -> BoundKernel | None:
        """The film in SI units in C, to be asked at speed 0; None where the law has none."""
        if self.is_built:
            return oil_bound(self)
        if not isinstance(self.bound_film, KernelSqueezeFilm):
            return None
        return self.bound_film.bound(clearance=self.clearance, force_scale=self.force_scale)

    def compiled(self) -> FilmCall | None:
        """Return the force in the C library, at speed 0 always; None where `native` has no kernel."""
        film = self.film_in_c if type(self) in KERNELS else None
        return None if film is None else film.compiled().beside(0.0, still=True)

    def native(self) -> NativeSpec | None:
        """Return the kernel of this damper in the C library; None if its film has none, or for a subclass."""
        if type(self) not in KERNELS:
            return None
        return damper_spec(self)

    def portable(self) -> Self:
        """Return this damper with a film that carries the table it needs; see `core.port.Reaction`."""
        carried = self._options.tabulated(self.squeeze_case)
        return self if carried is None else replace(self, film=carried)

    @property
    def slenderness_limit(self) -> float:
        """Largest length / diameter for which the film is meant [1]; infinite for one of finite length."""
        return self._options.slenderness_limit

    @property
    def _options(self) -> SqueezeOptions:
        return options(self.film, SqueezeOptions)

    @property
    def squeeze_case(self) -> SqueezeCase:
        """The data of this damper that its film needs."""
        modes = layer_modes(self.layer)
        ends = (
            self.feed if isinstance(self.feed, AxialFeed) else AxialFeed(start_pressure=0.0, end_pressure=0.0)
        )
        rate = self.clearance * self.clearance / (3.0 * self.viscosity * (self.length * self.length))
        return SqueezeCase(
            slenderness=self.slenderness,
            layer=self.layer,
            modes=modes,
            feed=self.feed_share(modes) * self._feed_velocity / self.clearance,
            ends=(ends.start_pressure * rate, ends.end_pressure * rate),
            cavitated=isinstance(self.extent, HalfSommerfeld),
            end_leak=self._end_leak,
            heavy=self.has_inertia,
        )

    @property
    def _end_leak(self) -> float:
        """12 viscosity radius G_s/clearance^3."""
        if self.seals is None:
            return math.inf
        return 12.0 * self.viscosity * self.radius * self.seals.leakage / self.clearance**3

    def prepare(self) -> Callable[[float, float, float, float, float], tuple[float, float]]:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        film = self.film_in_c
        if film is None:
            return super().prepare()
        in_c = film.call
        return lambda x, y, vx, vy, speed: in_c(x, y, vx, vy, 0.0)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers, in C if the film is compiled."""
        if self.film_in_c is None:
            return tangent_of(self)
        in_c = self.film_in_c.tangent

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, Sequence[float]]:
            force_x, force_y, slopes = in_c(x, y, vx, vy, 0.0)
            slopes[4] = slopes[9] = 0.0
            return force_x, force_y, slopes

        return tangent

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape, inside the clearance."""
        film = self.force_scale * self.bound_film.force(position / self.clearance, velocity / self.clearance)
        return film + self.convection(position, velocity)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape, inside the clearance."""
        film = self.bound_film.jacobian(position / self.clearance, velocity / self.clearance)
        by_motion = self.force_scale / self.clearance * film + self.convection_slopes(position, velocity)
        return np.concatenate([by_motion, np.zeros_like(by_motion[:, :1])], axis=1)

    @property
    def has_inertia(self) -> bool:
        """Whether the inertia of the oil is included."""
        return self.density > 0.0

    @cached_property
    def film_inertia(self) -> FilmInertia:
        """The inertia of the film in this damper's dimensions."""
        return self._options.inertia(self.squeeze_case) if self.has_inertia else FilmInertia()

    def mass(self, position: ArrayLike, velocity: ArrayLike | None = None, speed: ArrayLike = 0.0) -> Array:
        """Return the added mass of the oil [kg], shape (2, 2, ...); 0 without density.

        Parameters
        ----------
        position : array_like, shape (2, ...) [m]
            Journal center from the bearing center.
        velocity : array_like, shape (2, ...) [m/s], optional
            Velocity of the journal, for a ruptured film, whose added mass depends on its direction; not
            needed for a full film.
        speed : array_like, shape (...) [rad/s]
            Not used.

        Raises
        ------
        InputError
            If an argument is not finite, or a ruptured film is given no velocity.
        FilmContactError
            If the journal touches the wall.
        """
        if velocity is None and self.has_inertia and self.squeeze_case.cavitated:
            raise InputError("velocity must be given for the mass of a ruptured film, got None")
        q, v, _ = broadcast_state(position, np.zeros(2) if velocity is None else velocity, speed)
        require_inside(q, self.clearance)
        return self.inertia_scale / self.clearance * self.film_inertia.mass(*self._scaled(q, v))

    def mass_slopes(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike = 0.0) -> Array:
        """Return d mass / d (x, y, vx, vy, speed), shape (2, 2, 5, ...); see `core.port.Reaction`."""
        q, v, _ = broadcast_state(position, velocity, speed)
        require_inside(q, self.clearance)
        slopes = self.film_inertia.mass_slopes(*self._scaled(q, v))
        by_motion = self.inertia_scale / self.clearance**2 * slopes
        return np.concatenate([by_motion, np.zeros_like(by_motion[:, :, :1])], axis=2)

    def reynolds_number(self, frequency: float) -> float:
        """Return the squeeze Reynolds number |frequency| clearance^2 density/viscosity at [rad/s]."""
        return abs(frequency) * self.clearance**2 * self.density / self.viscosity

    def require_range(self, frequency: float) -> None:
        """Warn where inertia to first order is no longer valid, and raise InputError far beyond.

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of the motion.
        """
        require_inertia_range(self.reynolds_number(frequency), cavitated=self.squeeze_case.cavitated)

    def small_motion(self, frequency: float) -> SqueezeImpedance:
        """Return damping and added mass of small motion about the center, exact in the frequency [rad/s].

        Parameters
        ----------
        frequency : float [rad/s]
            Frequency of the motion; 0 for slow motion.

        Raises
        ------
        InputError
            For a ruptured film, which has no linear matrices, a porous cage or a feed.
        """
        case = self.squeeze_case
        if case.cavitated or case.layer is not None or np.any(case.feed) or np.any(case.ends):
            raise InputError(
                f"small_motion needs a FullFilm() in a solid cage without feed, got {self!r}: "
                "orbit_coefficients has those of a ruptured film"
            )
        land = FilmSegment(length=self.length, clearance=self.clearance)
        return SegmentedDamper(
            radius=self.radius,
            segments=(land,),
            viscosity=self.viscosity,
            density=self.density,
            seals=self.seals,
        ).small_motion(frequency)

    def convection(self, position: Array, velocity: Array) -> Array:
        """Return the convective inertia force [N], shape (2, ...), which is part of `force`."""
        if not self.has_inertia:
            return np.zeros_like(position)
        return self.inertia_scale * self.film_inertia.force(*self._scaled(position, velocity))

    def convection_slopes(self, position: Array, velocity: Array) -> Array:
        """Return the derivatives of `convection` by position and velocity, shape (2, 4, ...)."""
        if not self.has_inertia:
            return np.zeros((2, 4, *position.shape[1:]))
        slopes = self.film_inertia.jacobian(*self._scaled(position, velocity))
        return self.inertia_scale / self.clearance * slopes

    @property
    def inertia_scale(self) -> float:
        """Density * radius * length^3 [kg m], the film's unit of force per 1/s^2."""
        return self.density * self.radius * self.length**3

    def _scaled(self, position: Array, velocity: Array) -> tuple[Array, Array]:
        return position / self.clearance, velocity / self.clearance

    def feed_share(self, modes: LayerModes) -> Array:
        """Return the share of a feed's velocity that reaches the film by each group of modes, (N,) [1]."""
        passed = modes.weight * modes.passage
        if not isinstance(self.feed, RadialFeed):
            return passed
        share = modes.weight if self.feed.at_film else passed
        if not self.feed.cosine:
            return share
        if share.size == 1:
            return share * 24.0 / math.pi**3
        # cos(pi z/L) is the first mode, with amplitude 1 in place of the uniform profile's 4/pi
        return share * np.where(np.arange(share.size) == 0, 0.25 * math.pi, 0.0)

    @property
    def _feed_velocity(self) -> float:
        """Velocity of a radial feed, or of the supply through a vented back [m/s]."""
        if isinstance(self.feed, RadialFeed):
            return self.feed.inflow
        if not self._back_is_open or self.cage is None:
            return 0.0
        return self.cage.permeability * self.cage.supply_pressure / (self.viscosity * self.cage.thickness)

    @property
    def _back_is_open(self) -> bool:
        return self.cage is not None and self.cage.vented

    def _warn(self) -> None:
        limit = self.slenderness_limit
        warn_of_length(self.film, self.slenderness, limit)
        if self.seals is not None and limit < math.inf:
            warn_of_short_seals(self.slenderness, self._end_leak)
        if self.cage is not None and self.cage.thickness > LARGEST_RATIO * self.radius:
            warn_user(
                f"thickness must not exceed {LARGEST_RATIO} of the radius {self.radius!r} m, got "
                f"{self.cage.thickness!r}: the model takes the porous layer as plane",
            )


@quantities
@dataclass(frozen=True, kw_only=True)
class PorousDamper(SqueezeFilmDamper):
    """A `SqueezeFilmDamper` under the name of its porous cage, with the same parameters."""


KERNELS = (SqueezeFilmDamper, PorousDamper)
"""Classes of dampers that have a kernel in C."""


# The kernel of the C library that is a squeeze-film damper over a map, with or without retainer springs.


KERNEL, SHORT_KERNEL, SEALED_KERNEL, POLAR_KERNEL = "damper", "short_damper", "oil_damper", "polar_damper"

DIMENSIONS = (
    ("radius", "m", "radius of the film"),
    ("length", "m", "axial length of the film"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity of the lubricant"),
)


def damper_spec(damper: SqueezeFilmDamper) -> NativeSpec | None:
    """Return the kernel of a damper for an FMU; None if it has none.

    It is `oil_damper` with seals or inertia, else `damper` over a map, `short_damper` over a short film, and
    `polar_damper` over another full film. What the tables hold for is fixed: the ratios L/D of a film of
    finite length, H/L and A H/C^3 of a cage, what a table makes of seals, and the feed of another full film.
    """
    film, parts = _compiled(damper.bound_film), _parts(damper) if damper.is_built else None
    polar = isinstance(damper.bound_film, FiniteSqueezeFilm | LinearSqueezeFilm)
    if parts is None and (damper.is_built or (film is None and not polar)):
        return None
    tabled = parts is not None and parts.radial is not None
    tables = dict(film.kernel.tables or {}) if film is not None else None
    held: set[str] = set()
    if tabled or getattr(film or damper.bound_film, "one_slenderness", False):
        held = {"radius", "length"}
    if damper.cage is not None:
        held |= {"length", "clearance"}
    if (tabled and damper.seals is not None) or (polar and damper.is_fed):
        held |= {"clearance", "viscosity"}
    kernel, parameters = KERNEL, _dimensions(damper, held)
    if parts is not None:
        heavy, leakage = damper.has_inertia, 0.0 if damper.seals is None else damper.seals.leakage
        parameters += (
            bounded("density", "kg/m3", "of the oil, whose mass is told", damper.density, fixed=not heavy),
            bounded("leakage", "m2/(Pa.s)", "of the seals", leakage, fixed=parts.sealed == 0.0),
        )
        kernel, tables = SEALED_KERNEL, parts.tables(tables, heavy=heavy)
    elif polar:
        kernel, tables = POLAR_KERNEL, damper.polar_tables
    elif film is not None and not film.kernel.is_table:
        kernel, parameters = SHORT_KERNEL, parameters + _feeds(damper)
        tables = {**(tables or {}), **_feed_tables(damper)}
    return NativeSpec(
        kernel=kernel,
        parameters=parameters,
        tables=tables or {},
        inputs=MOTION_NAMES,
        spring="stiffness",
    )


def _feed_tables(damper: SqueezeFilmDamper) -> dict[str, Array]:
    """Return the groups of modes with their shares of a feed, and the cage between a supply and the film."""
    modes, cage = damper.squeeze_case.modes, damper.cage
    behind = (cage.permeability, cage.thickness) if cage is not None and cage.vented else (0.0, 0.0)
    groups = np.stack([modes.weight, modes.leak, damper.feed_share(modes)])
    return {"groups": groups, "cage": np.array(behind)}


def _feeds(damper: SqueezeFilmDamper) -> tuple[NativeParameter, ...]:
    """Return what feeds a short film, fixed where it does not feed this one."""
    radial = damper.feed.inflow if isinstance(damper.feed, RadialFeed) else 0.0
    supply = 0.0 if damper.cage is None else damper.cage.supply_pressure
    ends = (
        damper.feed if isinstance(damper.feed, AxialFeed) else AxialFeed(start_pressure=0.0, end_pressure=0.0)
    )
    between = damper.squeeze_case.cavitated and any(damper.squeeze_case.ends)
    rows = (
        ("inflow", "m/s", "velocity of a radial feed", radial, radial != 0.0),
        ("supply_pressure", "Pa", "gauge pressure at the vented back of the cage", supply, supply != 0.0),
        ("start_pressure", "Pa", "gauge pressure at the end of negative z", ends.start_pressure, between),
        ("end_pressure", "Pa", "gauge pressure at the end of positive z", ends.end_pressure, between),
    )
    return tuple(
        bounded(
            name, unit, text, value, fixed=not free, reason=", as it does not feed the film", least=-math.inf
        )
        for name, unit, text, value, free in rows
    )


def _dimensions(damper: SqueezeFilmDamper, held: set[str]) -> tuple[NativeParameter, ...]:
    """Return the dimensions, fixed where the map of the film holds for them only, and the springs."""
    reason = ", as the map of the film holds for it"
    own = (
        bounded(name, unit, text, float(getattr(damper, name)), fixed=name in held, reason=reason)
        for name, unit, text in DIMENSIONS
    )
    spring = NativeParameter(
        name="stiffness",
        unit="N/m",
        value=0.0,
        tunable=True,
        minimum=0.0,
        nominal=damper.nominal_force / damper.clearance,
        description="of the retainer springs along either axis, whose force is part of the output",
    )
    return (*own, spring)


def bounded(
    name: str, unit: str, text: str, value: float, *, fixed: bool, reason: str = "", least: float = 0.0
) -> NativeParameter:
    """Return a number that is not below the least one, or fixed for a reason."""
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=not fixed,
        minimum=value if fixed else least,
        maximum=value if fixed else math.inf,
        nominal=abs(value) or math.nextafter(0.0, 1.0),
        description=f"{text}; fixed{reason}" if fixed else text,
    )


def oil_bound(damper: SqueezeFilmDamper) -> BoundKernel | None:
    """Return the force in C of a damper with seals or inertia; None where the film has none."""
    film, parts, inner = damper.bound_film, _parts(damper), _compiled(damper.bound_film)
    if parts is None:
        return None
    seal = film.damping if isinstance(film, SealedShortFilm) else 0.0
    scales = OilScales(damper.clearance, damper.force_scale, damper.inertia_scale, seal)
    viscous = None if inner is None else inner.kernel
    return BoundKernel(OilDamperKernel(parts, viscous, scales), damper.clearance)


def _compiled(film: SqueezeFilm) -> KernelSqueezeFilm | None:
    inner = film.film if isinstance(film, SealedShortFilm) else film
    return inner if isinstance(inner, KernelSqueezeFilm) else None


def _parts(damper: SqueezeFilmDamper) -> OilParts | None:
    film, case = damper.bound_film, damper.squeeze_case
    viscous = _compiled(film)
    if viscous is None and not isinstance(film, RadialTable):
        return None
    sealed = 0.0 if not isinstance(film, SealedShortFilm) else 0.5 if case.cavitated else 1.0
    return damper.film_inertia.parts(sealed, film.table if isinstance(film, RadialTable) else None)


# The dimensionless groups of a rotor on a damper.


@quantities
@dataclass(frozen=True, kw_only=True)
class DamperGroups:
    """The dimensionless groups of a rotor on a damper, w_r being any reference speed.

    Attributes
    ----------
    squeeze_number : float [1]
        Bs = mu R L^3/(m w_r C^3).
    damper_number : float [1]
        B = mu R^3 L/(2 m w_r C^3) = Bs/(8 (L/D)^2).
    permeability_number : float [1]
        Phi = A H/C^3; 0 for a solid cage.
    grading : float [1]
        lambda.
    thickness_ratio : float [1]
        H/L.
    slenderness : float [1]
        L/D.
    speed_ratio : float [1]
        Omega = omega/w_r.
    spring_ratio : float [1]
        Omega_s = sqrt(K/m)/w_r, K the stiffness of the retainer springs.
    unbalance_ratio : float [1]
        U = u/(m C).
    """

    squeeze_number: float
    damper_number: float
    permeability_number: float
    grading: float
    thickness_ratio: float
    slenderness: float
    speed_ratio: float
    spring_ratio: float
    unbalance_ratio: float


@arguments
def damper_groups(
    damper: PorousDamper,
    *,
    mass: float,
    speed: float,
    stiffness: float = 0.0,
    unbalance: float = 0.0,
    reference_speed: float | None = None,
) -> DamperGroups:
    """Return the dimensionless groups of a rigid rotor on a damper.

    Parameters
    ----------
    damper : PorousDamper
    mass : float [kg]
        Mass that this damper carries.
    speed : float [rad/s]
        Speed of the rotor.
    stiffness : float [N/m]
        Stiffness of the retainer springs.
    unbalance : float [kg m]
    reference_speed : float [rad/s], optional
        Reference speed w_r; by default the speed itself.

    Raises
    ------
    InputError
        If a value breaks its rule.
    """
    reference = abs(speed) if reference_speed is None else reference_speed
    require_positive("mass", mass)
    require_number("speed", speed)
    require_positive("reference_speed", reference)
    require_non_negative("stiffness", stiffness)
    require_non_negative("unbalance", unbalance)
    layer = damper.layer
    squeeze = damper.force_scale / (damper.clearance * mass * reference)
    return DamperGroups(
        squeeze_number=squeeze,
        damper_number=squeeze / (8.0 * damper.slenderness**2),
        permeability_number=0.0 if layer is None else layer.permeability_number,
        grading=0.0 if layer is None else layer.grading,
        thickness_ratio=0.0 if layer is None else layer.thickness_ratio,
        slenderness=damper.slenderness,
        speed_ratio=speed / reference,
        spring_ratio=math.sqrt(stiffness / mass) / reference,
        unbalance_ratio=unbalance / (mass * damper.clearance),
    )
