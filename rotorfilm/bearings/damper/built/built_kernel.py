"""Dampers with seals or inertia as kernels of the C library."""

from __future__ import annotations

from typing import Protocol

from ....native.damper_kernels import OilDamperKernel, OilParts, OilScales
from ....native.spec import NativeSpec
from ....signals import MOTION_NAMES
from ...film_units import Size
from ...films.kernel_film import BoundKernel
from ..damper_kernel import DIMENSIONS, bounded, dimension, spring_parameter
from ..full_squeeze import SqueezeFilm
from ..mapped_squeeze import MappedSqueezeFilm
from .end_seals import EndSeal, SealedShortFilm
from .film_inertia import FilmInertia, FullInertia, short_inertia
from .finite_inertia import TabulatedSqueezeFilm, least_root, radial_table
from .zone_inertia import NODES, ZoneInertia

KERNEL = "oil_damper"


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
        kernel=KERNEL,
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
