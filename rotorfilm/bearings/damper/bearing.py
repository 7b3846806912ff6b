"""The squeeze-film damper with a solid or porous cage, in SI units."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Protocol, Self

import numpy as np

from ...core.errors import (
    InputError,
    require_each,
    require_kind,
    require_non_negative,
    require_number,
    require_positive,
    warn_user,
)
from ...core.inputs import arguments, quantities
from ...core.model import Array, Tangent, tangent_of
from ...core.signals import MOTION_NAMES
from ...native.film_kernels import OilDamperKernel, OilParts, OilScales
from ...native.spec import NativeParameter, NativeSpec
from ..films.geometry import FullFilm, HalfSommerfeld
from ..films.law import BoundKernel, options
from ..reaction import NOMINAL_SPEED, Size, require_size
from .squeeze_films import LayerModes, PorousLayer, SqueezeFilm, layer_modes
from .squeeze_inertia import SqueezeInertia, warn_of_length, warn_of_short_seals
from .squeeze_laws import (
    LARGEST_TABULATED,
    NODES,
    EndSeal,
    FilmInertia,
    FullInertia,
    SealedShortFilm,
    ShortSqueeze,
    SqueezeCase,
    SqueezeLaw,
    SqueezeOptions,
    TabulatedSqueezeFilm,
    ZoneInertia,
    least_root,
    radial_table,
    short_inertia,
)
from .squeeze_map import MappedSqueezeFilm

# The cage of a damper, and what feeds lubricant to its film.


@quantities
@dataclass(frozen=True, kw_only=True)
class PorousCage:
    """A porous ring around the film, Darcy's law in it: k(y) = permeability exp(grading y/thickness), y <= 0.

    Parameters
    ----------
    thickness : float [m]
        H, radial thickness of the layer.
    permeability : float [m2]
        A, through the layer, at its face to the film.
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
    """Lubricant pressed through the layer: a given velocity at the back of a sealed layer, or at the film.

    What the layer passes from its back to the film, the rest leaving by the layer's ends, follows from
    Darcy's law (95 % at H/L = 0.1); through a thin layer or a solid cage (jets) it is all.

    Parameters
    ----------
    inflow : float [m/s]
        Velocity towards the film, its largest along the axis; negative for suction.
    cosine : bool
        Whether the velocity falls as cos(pi z/length) from the middle to the ends; otherwise it is uniform.
    at_film : bool
        Whether it is what enters a film without pressure; otherwise what enters the back of the layer, as in
        Akhverdiev et al. (11).
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
    start_pressure, end_pressure : float [Pa]
        Gauge pressure at z = -length/2 and z = length/2. Zero is the pressure at which the film ruptures.
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
class SqueezeFilmDamper(SqueezeInertia):
    """A squeeze-film damper: a Reaction whose journal does not spin, so that the speed does not matter.

    Parameters
    ----------
    radius, length, clearance : float [m]
        Of the film.
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    cage : PorousCage or None
        None for a solid cage.
    extent : FullFilm or HalfSommerfeld
        Full film, tension included, or one whose negative pressures are dropped: without feed the half circle
        towards which the rotor moves.
    feed : RadialFeed or AxialFeed, optional
        Besides a supply pressure at a vented back of the cage.
    film : SqueezeLaw
        `ShortSqueeze()`, `FiniteSqueeze()`, their maps `MapSqueeze()` and `FiniteMapSqueeze()`, which also
        run in C inside an FMU, or, for history, `PublishedSqueeze()`.
    seals : EndSeal or None
        At both ends of a solid cage without feed; None for open ends.
    density : float [kg/m3]
        Of the oil, whose inertia then is part of the answer: F = `force` - `mass` acceleration, for a solid
        cage without feed. 0 without inertia.

    Raises
    ------
    InputError
        If a value breaks its rule, or the film cannot represent the extent, the feed, the seals or the
        inertia.

    Warns
    -----
    ValidityWarning
        For the short film beyond length / diameter 0.25, with its error.

    Notes
    -----
    Cusano & Funk (1977) without the wedge term, as a race that does not spin has none. Full films
    have F = -(a w + b (e.w) e + k e), w = velocity/clearance, in closed form: the center is no exception.
    Inertia to first order in the squeeze Reynolds number frequency clearance^2 density/viscosity: up to 10,
    a ruptured film to 5; see `require_range`.
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
            if getattr(self, name) and (self.cage is not None or self.feed is not None):
                raise InputError(f"{name} must be left out beside a porous cage or a feed, got {self!r}")
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
        return self.viscosity * self.radius * self.length**3 / self.clearance**2

    @property
    def nominal_force(self) -> float:
        """Force of a middling motion at NOMINAL_SPEED [N]."""
        return self.force_scale * NOMINAL_SPEED

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the film is meant: the last node of a map; 0.95 to 0.99 for others."""
        reach = self._options.largest_eccentricity_ratio
        if isinstance(self.bound_film, TabulatedSqueezeFilm):
            reach = LARGEST_TABULATED
        return min(reach, self.film_inertia.reach) if self.has_inertia else reach

    @property
    def is_built(self) -> bool:
        """Whether it has seals or inertia."""
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
    def film_in_c(self) -> BoundKernel | None:
        """The film in SI units in C, to be asked at speed 0; None where the law is no map, or table."""
        if self.is_built:
            case = self.squeeze_case
            return oil_bound(self, case.end_leak, cavitated=case.cavitated)
        if not isinstance(self.bound_film, MappedSqueezeFilm):
            return None
        return self.bound_film.bound(clearance=self.clearance, force_scale=self.force_scale)

    def native(self) -> NativeSpec | None:
        """Return the kernel of this damper in the C library; None if its film has none, or for a subclass."""
        if type(self) not in KERNELS:
            return None
        if self.is_built:
            case = self.squeeze_case
            return oil_spec(self, case.end_leak, cavitated=case.cavitated)
        dimensions = {name: getattr(self, name) for name, _, _ in DIMENSIONS}
        caged = self.cage is not None
        return damper_spec(self.bound_film, dimensions, caged=caged, nominal_force=self.nominal_force)

    def portable(self) -> Self:
        """Return this damper with a film that carries the table it needs; see `model.Reaction`."""
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
        """Itself as its film sees it."""
        modes = layer_modes(self.layer)
        ends = (
            self.feed if isinstance(self.feed, AxialFeed) else AxialFeed(start_pressure=0.0, end_pressure=0.0)
        )
        rate = self.clearance**2 / (3.0 * self.viscosity * self.length**2)
        return SqueezeCase(
            slenderness=self.slenderness,
            layer=self.layer,
            modes=modes,
            feed=self._feed(modes),
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
        """Return the force as a function of five numbers; in C for a map. See `StaticReaction.prepare`."""
        film = self.film_in_c
        if film is None:
            return super().prepare()
        in_c = film.call
        return lambda x, y, vx, vy, speed: in_c(x, y, vx, vy, 0.0)

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as a function of five numbers; in C for a map."""
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

    def _feed(self, modes: LayerModes) -> Array:
        """Return the feed of each group of modes, shape (N,) [1/s]."""
        if isinstance(self.feed, RadialFeed):
            passage = np.ones_like(modes.weight) if self.feed.at_film else modes.passage
            through = modes.weight * passage * self.feed.inflow / self.clearance
            if not self.feed.cosine:
                return through
            if through.size == 1:
                return through * 24.0 / math.pi**3
            # cos(pi z/L) is the first mode, with amplitude 1 in place of the uniform profile's 4/pi
            return through * np.where(np.arange(through.size) == 0, 0.25 * math.pi, 0.0)
        if not self._back_is_open or self.cage is None:
            return np.zeros_like(modes.weight)
        flux = self.cage.permeability * self.cage.supply_pressure / (self.viscosity * self.cage.thickness)
        return modes.weight * modes.passage * flux / self.clearance

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
                f"thickness must not exceed {LARGEST_RATIO} radii of {self.radius!r} m, got "
                f"{self.cage.thickness!r}: the layer is unrolled to a plane",
            )


@quantities
@dataclass(frozen=True, kw_only=True)
class PorousDamper(SqueezeFilmDamper):
    """A `SqueezeFilmDamper` under the name of its porous cage, with the same parameters."""


KERNELS = (SqueezeFilmDamper, PorousDamper)
"""Classes of dampers that have a kernel in C."""


# The kernel of the C library that is a squeeze-film damper over a map, with or without retainer springs.


KERNEL = "damper"

DIMENSIONS = (
    ("radius", "m", "radius of the film"),
    ("length", "m", "axial length of the film"),
    ("clearance", "m", "radial clearance"),
    ("viscosity", "Pa.s", "dynamic viscosity of the lubricant"),
)


def damper_spec(
    film: SqueezeFilm, dimensions: Mapping[str, float], *, caged: bool, nominal_force: float
) -> NativeSpec | None:
    """Return the kernel of a damper; None if its film is no map.

    What the map holds for is fixed: the ratios L/D of a film of finite length, H/L and A H/C^3 of a cage.

    Parameters
    ----------
    film : SqueezeFilm
    dimensions : mapping of str to float
        Radius, length, clearance [m] and viscosity [Pa s].
    caged : bool
        Whether it has a porous cage.
    nominal_force : float [N]
    """
    if not isinstance(film, MappedSqueezeFilm):
        return None
    held = {"radius", "length"} if film.one_slenderness else set()
    if caged:
        held |= {"length", "clearance"}
    parameters = [
        dimension(name, unit, text, float(dimensions[name]), fixed=name in held)
        for name, unit, text in DIMENSIONS
    ]
    spring = spring_parameter(nominal_force / dimensions["clearance"])
    return NativeSpec(
        kernel=KERNEL,
        parameters=(*parameters, spring),
        tables=film.native_tables(),
        inputs=MOTION_NAMES,
        spring="stiffness",
    )


def spring_parameter(nominal: float) -> NativeParameter:
    """Return the stiffness of springs, none yet, of a nominal value [N/m]."""
    return NativeParameter(
        name="stiffness",
        unit="N/m",
        value=0.0,
        tunable=True,
        minimum=0.0,
        nominal=nominal,
        description="of the retainer springs along either axis, whose force is part of the output",
    )


def dimension(name: str, unit: str, text: str, value: float, *, fixed: bool) -> NativeParameter:
    """Return a dimension, which the map of the film may hold for only."""
    reason = ", as the map of the film holds for it"
    return bounded(name, unit, text, value, fixed=fixed, reason=reason)


def bounded(
    name: str, unit: str, text: str, value: float, *, fixed: bool, reason: str = ""
) -> NativeParameter:
    """Return a number that is not negative, or fixed for a reason."""
    return NativeParameter(
        name=name,
        unit=unit,
        value=value,
        tunable=not fixed,
        minimum=value if fixed else 0.0,
        maximum=value if fixed else math.inf,
        nominal=math.nextafter(0.0, 1.0) if value == 0.0 else value,
        description=f"{text}; fixed{reason}" if fixed else text,
    )


# Dampers with seals or inertia as kernels of the C library.


SEALED_KERNEL = "oil_damper"


class _OilDamper(Size, Protocol):
    """What a damper says of itself."""

    @property
    def viscosity(self) -> float: ...
    @property
    def density(self) -> float: ...
    @property
    def seals(self) -> EndSeal | None: ...
    @property
    def slenderness(self) -> float: ...
    @property
    def force_scale(self) -> float: ...
    @property
    def nominal_force(self) -> float: ...
    @property
    def bound_film(self) -> SqueezeFilm: ...
    @property
    def film_inertia(self) -> FilmInertia: ...


def oil_bound(damper: _OilDamper, end_leak: float, *, cavitated: bool) -> BoundKernel | None:
    """Return the force in C; None where the film has none.

    Parameters
    ----------
    damper : SqueezeFilmDamper
        With seals or inertia.
    end_leak : float [1]
        As of a `SqueezeCase`.
    cavitated : bool
    """
    parts, mapped = _parts(damper, end_leak, cavitated=cavitated), _mapped(damper.bound_film)
    if parts is None:
        return None
    film = damper.bound_film
    seal = film.damping if isinstance(film, SealedShortFilm) else 0.0
    inertial = damper.density * damper.radius * damper.length**3
    scales = OilScales(damper.clearance, damper.force_scale, inertial, seal)
    map_kernel = None
    if mapped is not None:
        bound = mapped.bound(clearance=damper.clearance, force_scale=damper.force_scale)
        map_kernel = bound.kernel.film
    return BoundKernel(OilDamperKernel(parts, map_kernel, scales), damper.clearance)


def oil_spec(damper: _OilDamper, end_leak: float, *, cavitated: bool) -> NativeSpec | None:
    """Return the kernel of the damper for an FMU; see `oil_bound`."""
    parts, mapped = _parts(damper, end_leak, cavitated=cavitated), _mapped(damper.bound_film)
    if parts is None:
        return None
    held: set[str] = set()
    if parts.radial is not None or (mapped is not None and mapped.one_slenderness):
        held = {"radius", "length"}
    if parts.radial is not None and damper.seals is not None:
        held |= {"clearance", "viscosity"}
    own = [
        dimension(name, unit, text, float(getattr(damper, name)), fixed=name in held)
        for name, unit, text in DIMENSIONS
    ]
    heavy, leakage = damper.density > 0.0, 0.0 if damper.seals is None else damper.seals.leakage
    return NativeSpec(
        kernel=SEALED_KERNEL,
        parameters=(
            *own,
            spring_parameter(damper.nominal_force / damper.clearance),
            bounded("density", "kg/m3", "of the oil, whose mass is told", damper.density, fixed=not heavy),
            bounded("leakage", "m2/(Pa.s)", "of the seals", leakage, fixed=parts.sealed == 0.0),
        ),
        tables=parts.tables(None if mapped is None else mapped.native_tables(), heavy=heavy),
        inputs=MOTION_NAMES,
        spring="stiffness",
    )


def _mapped(film: SqueezeFilm) -> MappedSqueezeFilm | None:
    inner = film.film if isinstance(film, SealedShortFilm) else film
    return inner if isinstance(inner, MappedSqueezeFilm) else None


def _parts(damper: _OilDamper, end_leak: float, *, cavitated: bool) -> OilParts | None:
    film, mapped = damper.bound_film, _mapped(damper.bound_film)
    if mapped is None and not isinstance(film, TabulatedSqueezeFilm):
        return None
    inertia = damper.film_inertia if damper.density > 0.0 else None
    full = isinstance(inertia, FullInertia)
    closed = full and isinstance(inertia, FullInertia) and inertia.radial is short_inertia
    tabled = mapped is None or (full and not closed)
    sealed = 0.0 if not isinstance(film, SealedShortFilm) else 0.5 if cavitated else 1.0
    return OilParts(
        zone=inertia.share if isinstance(inertia, ZoneInertia) else 0.0,
        closed=float(closed),
        tabled=float(full and not closed),
        sealed=sealed,
        radial=radial_table(damper.slenderness, end_leak).table if tabled else None,
        least=least_root() if tabled else 1.0,
        nodes=NODES[0],
        weights=NODES[1],
    )


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
        Carried by this damper.
    speed : float [rad/s]
        Of the rotor.
    stiffness : float [N/m]
        Of the retainer springs.
    unbalance : float [kg m]
    reference_speed : float [rad/s], optional
        w_r; the speed itself by default.

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
