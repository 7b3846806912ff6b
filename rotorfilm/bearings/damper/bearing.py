"""The squeeze-film damper with a solid or porous cage, in SI units."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from ...errors import InputError, require_kind, require_non_negative, warn_user
from ...inputs.si_arguments import quantities
from ...model import Array, Tangent, tangent_of
from ...native.spec import NativeSpec
from ..film_units import require_size
from ..films.cavitation import FullFilm, HalfSommerfeld
from ..films.kernel_film import BoundKernel
from ..films.law import options
from ..reaction import NOMINAL_SPEED
from .built.built_kernel import oil_bound, oil_spec
from .built.end_seals import EndSeal
from .built.film_range import warn_of_length, warn_of_short_seals
from .built.finite_inertia import LARGEST_TABULATED, TabulatedSqueezeFilm
from .built.squeeze_inertia import SqueezeInertia
from .cage import AxialFeed, PorousCage, RadialFeed
from .damper_kernel import DIMENSIONS, damper_spec
from .full_squeeze import SqueezeFilm
from .mapped_squeeze import MappedSqueezeFilm
from .porous_layer import LayerModes, PorousLayer, layer_modes
from .squeeze_laws import ShortSqueeze, SqueezeCase, SqueezeLaw, SqueezeOptions

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
        """Return this damper with a film that carries the table it needs; see `model.Portable`."""
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
