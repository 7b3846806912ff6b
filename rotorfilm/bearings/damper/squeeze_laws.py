"""Which squeeze film a damper has: short, of finite length, or as published."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple, Protocol, runtime_checkable

import numpy as np

from ...errors import InputError
from ...model import Array
from .built.end_seals import SealedShortFilm
from .built.film_inertia import FilmInertia, FullInertia, short_inertia
from .built.finite_inertia import LARGEST_TABULATED, TabulatedSqueezeFilm, radial_table
from .built.zone_inertia import ZoneInertia
from .cavitated_squeeze import CavitatedSqueezeFilm
from .clipped_squeeze import ClippedSqueezeFilm
from .finite_squeeze import LARGEST, FiniteSqueezeFilm
from .full_squeeze import FullSqueezeFilm, SqueezeFilm
from .porous_layer import LayerModes, PorousLayer


class SqueezeCase(NamedTuple):
    """A damper as its film sees it.

    Attributes
    ----------
    slenderness : float [1]
        L/D.
    layer : PorousLayer or None
        None for a solid cage.
    modes : LayerModes
        Of the layer.
    feed : ndarray, shape (N,) [1/s]
        Feed of each group of modes, weight included.
    ends : tuple of two floats [1/s]
        Pressure at both ends times clearance^2/(3 viscosity length^2).
    cavitated : bool
    end_leak : float [1]
        12 viscosity radius/clearance^3 times the leakage of either end; infinite for open ends.
    heavy : bool
        Whether the inertia of the oil counts.
    """

    slenderness: float
    layer: PorousLayer | None
    modes: LayerModes
    feed: Array
    ends: tuple[float, float]
    cavitated: bool
    end_leak: float = math.inf
    heavy: bool = False

    @property
    def is_sealed(self) -> bool:
        """Whether seals hold pressure at its ends."""
        return math.isfinite(self.end_leak)


@runtime_checkable
class SqueezeLaw(Protocol):
    """A choice of squeeze film."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError where the law cannot represent it."""


class SqueezeOptions:
    """What a squeeze law may have besides `bind`: what it leaves as it is here, it has not."""

    @property
    def slenderness_limit(self) -> float:
        """Largest length / diameter for which the film is meant; beyond, a damper warns."""
        return math.inf

    @property
    def largest_eccentricity_ratio(self) -> float:
        """Eccentricity ratio to which the film is meant; 1 where it is meant up to the wall."""
        return 1.0

    def tabulated(self, case: SqueezeCase) -> SqueezeLaw | None:
        """Return this law with the table that it would make in a damper; None if it makes none."""
        return None

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; raise InputError where it is not known."""
        raise InputError(f"density must be 0 for {self!r}, whose inertia is not known")


@dataclass(frozen=True)
class ShortSqueeze(SqueezeOptions):
    """Short film: no flow around the circumference, neither in the film nor in the layer."""

    slenderness_limit: ClassVar[float] = 0.25
    """Largest length / diameter for which the film is meant [1]."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError where its seals are tight."""
        return sealed_short(_open_short(case), case)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return short_film_inertia(case)


@dataclass(frozen=True)
class FiniteSqueeze(SqueezeOptions):
    """Full film of finite length, some milliseconds for a force: the reference of the short film."""

    largest_eccentricity_ratio: ClassVar[float] = LARGEST
    """Eccentricity ratio to which the film is meant [1]."""

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a cavitated film."""
        if case.cavitated:
            raise InputError("extent must be FullFilm() for FiniteSqueeze(), got a cavitated film")
        if case.is_sealed or case.heavy:
            return TabulatedSqueezeFilm(radial_table(case.slenderness, case.end_leak))
        return FiniteSqueezeFilm(case.slenderness, case.layer, case.modes, case.feed)

    def inertia(self, case: SqueezeCase) -> FilmInertia:
        """Return the inertia of the film of one damper; see `SqueezeOptions`."""
        return finite_film_inertia(case)


@dataclass(frozen=True)
class PublishedSqueeze(SqueezeOptions):
    """Historical: small motion as published by Akhverdiev et al., with the signs corrected.

    Full film, linear in eccentricity and velocity. The leak is that of a vented back with the flux number
    Delta1 = 12 grading/(grading + 6) of the authors' polynomial through the layer: no effect without grading
    and a trend opposite to that of a real layer. A radial feed passes a film that does not leak. Equations
    (37)-(40); docs/damper.md has the errata. Not for design.
    """

    def bind(self, case: SqueezeCase) -> SqueezeFilm:
        """Return the film of one damper; raise InputError for a cavitated film or a grading below 0."""
        if case.cavitated:
            raise InputError("extent must be FullFilm() for PublishedSqueeze(), got a cavitated film")
        if case.is_sealed:
            raise InputError("seals must be None for PublishedSqueeze()")
        if case.layer is not None and case.layer.grading < 0.0:
            raise InputError(
                f"grading must not be negative for PublishedSqueeze(), got {case.layer.grading!r}"
            )
        conductance = 1.0 if case.layer is None else published_conductance(case.layer)
        return _LinearSqueezeFilm(math.pi * conductance, 3.0 * math.pi * float(np.sum(case.feed)))


def _open_short(case: SqueezeCase) -> SqueezeFilm:
    if not case.cavitated:
        return FullSqueezeFilm(case.modes, case.feed)
    if np.any(case.feed) or np.any(case.ends):
        return ClippedSqueezeFilm(case.modes, case.feed, case.ends)
    return CavitatedSqueezeFilm(case.modes)


def sealed_short(film: SqueezeFilm, case: SqueezeCase) -> SqueezeFilm:
    """Return a short film with the seals of a damper; raise InputError where they are tight."""
    if not case.is_sealed:
        return film
    if case.end_leak == 0.0:
        raise InputError(
            "leakage of seals must be positive for a short film, got 0: its oil can only go out, not around; "
            "FullFilm() with FiniteSqueeze() has both"
        )
    # c^3/(2 viscosity G_s L), half the circle where the film ruptures
    damping = math.pi * 3.0 / (case.end_leak * case.slenderness)
    return SealedShortFilm(film, 0.5 * damping if case.cavitated else damping)


def short_film_inertia(case: SqueezeCase) -> FilmInertia:
    """Return the inertia of a short film: that of its zone where it ruptures."""
    return ZoneInertia() if case.cavitated else FullInertia(short_inertia)


def finite_film_inertia(case: SqueezeCase) -> FilmInertia:
    """Return the inertia of a film of finite length; of one that ruptures that of its zone."""
    if case.cavitated:
        return ZoneInertia(share=parabola_mean(case.slenderness))
    return FullInertia(radial_table(case.slenderness, case.end_leak).inertia, LARGEST_TABULATED)


def published_conductance(layer: PorousLayer) -> float:
    """Return G(1) of the published film: 3 (1 - tanh x/x)/x^2, x^2 = 3 Phi Delta1/(H/L)^2."""
    flux = 12.0 * layer.grading / (layer.grading + 6.0)
    return parabola_mean(math.sqrt(3.0 * layer.permeability_number * flux) / layer.thickness_ratio)


def parabola_mean(x: float) -> float:
    """Return 3 (1 - tanh x/x)/x^2, 1 at x = 0: what flow across a boundary leaves of a parabola's mean."""
    if x < 0.02:
        return 1.0 - 0.4 * x * x + 17.0 / 105.0 * x**4
    return 3.0 * (1.0 - math.tanh(x) / x) / (x * x)


@dataclass(frozen=True)
class _LinearSqueezeFilm:
    damping: float
    stiffness: float

    def force(self, eccentricity: Array, rate: Array) -> Array:
        return -self.damping * rate - self.stiffness * eccentricity

    def jacobian(self, eccentricity: Array, rate: Array) -> Array:
        constant = np.concatenate([-self.stiffness * np.eye(2), -self.damping * np.eye(2)], axis=1)
        axes = (1,) * (eccentricity.ndim - 1)
        return np.broadcast_to(constant.reshape(2, 4, *axes), (2, 4, *eccentricity.shape[1:])).copy()
