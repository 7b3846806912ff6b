"""What all bearings made of pads are given: dimensions, one of two clearances, and the lubricant."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...core.errors import InputError, require_each, require_number, require_positive
from ...core.model import Array
from ...core.results import BearingLosses
from ..films.geometry import TURN, FilmGeometry, Pad, SunkArc
from ..films.mobility import with_mobility
from ..films.turbulence import Turbulence, require_turbulence
from ..oil import Cooling, Oil
from ..oil.heated_bearing import WarmBearing, flow_slopes, require_lubricant
from ..reaction import require_no_overflow
from .pad_table import LossyPadFilm, PadFlows, gap_of_pad

_ROUNDOFF = 5e-14
"""Force that a map or a grid leaves of a few pads, over viscosity length radius^3 speed/clearance^2."""


@dataclass(frozen=True, kw_only=True)
class OwnCenter:
    """An arc about a center of curvature of its own.

    Parameters
    ----------
    start, extent : float [rad]
        First end of the arc, in the bearing frame from +x towards +y, and the angle that it covers.
    preload : float [1]
        Distance of its center of curvature from that of the bearing, in pad clearances.
    offset : float [1]
        Share of the arc before the place that is closest to the centered journal.
    """

    start: float
    extent: float
    preload: float = 0.0
    offset: float = 0.5

    def _require_curve(self) -> None:
        if not 0.0 <= require_number("preload", self.preload) < 1.0:
            raise InputError(f"preload must be in [0, 1), got {self.preload!r}")
        if not 0.0 <= require_number("offset", self.offset) <= 1.0:
            raise InputError(f"offset must be in [0, 1], got {self.offset!r}")

    @property
    def closest(self) -> float:
        """Angle of the least film at the centered journal [rad]."""
        return self.start + self.offset * self.extent

    @property
    def center(self) -> tuple[float, float]:
        """Center of curvature in units of the pad clearance."""
        return -self.preload * math.cos(self.closest), -self.preload * math.sin(self.closest)

    @property
    def middle(self) -> float:
        """Angle of the middle of the arc [rad]."""
        return self.start + 0.5 * self.extent


@dataclass(frozen=True, kw_only=True)
class PadBearing(WarmBearing):
    """Common parameters of bearings with pads: `LobedBearing`, `PressureDamBearing`, `TiltingPadBearing`.

    Each bearing adds its pads, `preloads` and `extents`.

    Parameters
    ----------
    radius : float [m]
        Journal radius; or `diameter`, twice that.
    length : float [m]
        Axial length of the pads.
    pad_clearance : float or None [m]
        Radial clearance c_p of a pad: its radius of curvature less that of the journal. Give this or the
        assembled clearance.
    assembled_clearance : float or None [m]
        c_b = (1 - preload) c_p, as given on drawings and in ROSS: the smallest gap around a centered journal.
        All pads must have the same preload.
    viscosity : float or None [Pa s]
        Dynamic viscosity of the lubricant, the same at all temperatures; None where `oil` is given.
    oil : Oil or None
        The lubricant by its viscosity over temperature, in place of `viscosity`.
    temperature : float or None [K]
        Temperature of the films, where the oil is given. With None and a `cooling`, the heat balance of a
        journal at rest determines it, and `equilibrium` finds it.
    cooling : Cooling or None
        Supply oil and surroundings that remove the heat; needed for a heat balance only. The carry-over is
        from pad to pad.
    turbulence : Turbulence or None
        Turbulence model, for films on a grid and for a `PadMapFilm` with `reynolds_cells`; without them it
        becomes `PadGridFilm()`. None for laminar oil.

    Raises
    ------
    InputError
        If a dimension is not finite and positive, or the clearance is not below the radius. If not exactly
        one of viscosity and oil, or of both clearances, is given. If an oil has neither temperature nor
        cooling.
    """

    radius: float
    length: float
    pad_clearance: float | None = None
    assembled_clearance: float | None = None
    viscosity: float | None = None
    oil: Oil | None = None
    temperature: float | None = None
    cooling: Cooling | None = None
    turbulence: Turbulence | None = None

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "length")
        require_turbulence(self.turbulence)
        if self.turbulence is not None:
            from .pad_film import PadGridFilm, PadMapFilm

            film = getattr(self, "film", None)
            if isinstance(film, PadMapFilm) and film.reynolds_cells == 0:
                object.__setattr__(self, "film", PadGridFilm(mobility=film.mobility))
        require_lubricant(self.viscosity, self.oil, self.temperature, self.cooling)
        self._require_clearance()

    def _require_clearance(self) -> None:
        given = {name: getattr(self, name) for name in ("pad_clearance", "assembled_clearance")}
        told = {name: value for name, value in given.items() if value is not None}
        if len(told) != 1:
            raise InputError(f"pad_clearance or assembled_clearance must be given, and not both, got {given}")
        for name, value in told.items():
            require_positive(name, value)
        preloads = sorted(set(self.preloads))
        if self.pad_clearance is None and len(preloads) > 1:
            raise InputError(f"pads must have one preload for an assembled_clearance, got {preloads}")
        if self.clearance >= self.radius:
            raise InputError(
                f"pad clearance must be below the radius {self.radius!r}, got {self.clearance!r}"
            )

    @property
    @abstractmethod
    def arcs(self) -> Sequence[OwnCenter]:
        """The pads as arcs of the film; tilting pads are without tilt."""

    @property
    def preloads(self) -> tuple[float, ...]:
        """Preload of each pad [1]; one value if it is the same for all pads."""
        return tuple(arc.preload for arc in self.arcs)

    @property
    def extents(self) -> tuple[float, ...]:
        """Angle that each pad covers [rad]; one value if it is the same for all pads."""
        return tuple(arc.extent for arc in self.arcs)

    @property
    def recesses(self) -> tuple[SunkArc, ...]:
        """Recesses in the pads."""
        return ()

    @cached_property
    def geometry(self) -> FilmGeometry:
        """Arcs of the pads and the openings between them, for films that are solved all round."""
        pads = tuple(Pad(start=arc.start, extent=arc.extent) for arc in self.arcs)
        return FilmGeometry(pads=pads, recesses=self.recesses)

    def arc_at(self, angle: Array) -> np.ndarray:
        """Return the number of the pad at each angle (N,) [rad]; between two pads the nearer one."""
        middles, extents = np.array([(arc.middle, arc.extent) for arc in self.arcs]).T
        away = np.abs((angle[:, None] - middles + np.pi) % TURN - np.pi) - 0.5 * extents
        return np.asarray(np.argmin(away, axis=1))

    def centers_at(self, angle: Array) -> Array:
        """Return the centers of curvature of the walls at angles (N,) [rad], in clearances, shape (2, N)."""
        return np.array([arc.center for arc in self.arcs])[self.arc_at(angle)].T

    def on_cells(self, around: int, along: int) -> Any:
        """Return this bearing on a grid of about so many cells around all pads and along half the length."""
        from .pad_film import PadGridFilm

        bearing: Any = self
        return replace(bearing, film=PadGridFilm(cells=cells_on_each(around, along, len(self.arcs))))

    @property
    def clearance(self) -> float:
        """Radial clearance c_p of a pad [m], the unit of eccentricity ratios."""
        if self.pad_clearance is not None:
            return self.pad_clearance
        assert self.assembled_clearance is not None  # one of both is given
        return self.assembled_clearance / (1.0 - self.preloads[0])

    @property
    def dimensions(self) -> dict[str, float]:
        """Radius, length, clearance of a pad [m] and viscosity [Pa s], for compiled bearings."""
        lengths = {name: float(getattr(self, name)) for name in ("radius", "length", "clearance")}
        return {**lengths, "viscosity": self.film_viscosity}

    @property
    def bore_clearance(self) -> float:
        """Clearance c_b of the assembled bearing [m], given by the pads with the largest preload."""
        return self.clearance * (1.0 - max(self.preloads))

    @property
    def film_at_speed(self) -> Any:
        """The film law of the pads with the Reynolds number of this bearing, where it changes with that."""
        film: Any = with_mobility(getattr(self, "film", None), self.turbulent_mobility)
        mobility = getattr(film, "mobility", None)
        if mobility is None or mobility.density == 0.0:
            return film
        return film.at_scale(self.radius * self.clearance / self.film_viscosity)

    @property
    def scales_with_viscosity(self) -> bool:
        """Whether its force is of degree one in the viscosity, as that of laminar oil on rigid pivots."""
        changing = self.turbulence or getattr(self.film_at_speed, "mobility", None)
        return changing is None and getattr(self, "pivot_stiffness", None) is None

    def making_time(self) -> float:
        """Return about how long the maps of its pads take on this machine [s]; 0 if none is to be made."""
        film: Any = with_mobility(getattr(self, "film", None), self.turbulent_mobility)
        shapes = set(self.extents) if hasattr(film, "making_time") else ()
        return float(sum(film.making_time(extent, self.slenderness) for extent in shapes))

    def film_at_unit_viscosity(self) -> None:
        """Return None: the loops in C over films with heat support a single film only."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Raise InputError: among bearings with pads, only fixed lobes have derivatives of the heat."""
        kind = type(self).__name__
        raise InputError(f"bearing must have derivatives of its heat, such as a LobedBearing, got a {kind}")

    def force_noise(self, speed: float) -> float:
        """Return the roundoff error of the force [N], as preloaded pads press each other; see `core.port`."""
        return _ROUNDOFF * self.force_scale * abs(speed)


WEDGE = np.array([[0.0, 1.0], [-1.0, 0.0]])
"""-z^ x, which makes the wedge of an eccentricity."""


def cells_on_each(around: int, along: int, pads: int) -> tuple[int, int]:
    """Return the cells of one of some pads, multiples of 4, for about so many around all of them."""
    return max(16, 4 * round(0.25 * around / pads)), along


# Power loss, torques and oil flow of a bearing made of pads, from shear and flow of each.


class PadUnderJournal(NamedTuple):
    """A pad and the journal on it, at n states, in the frame of the middle of the pad.

    Attributes
    ----------
    extent : float [rad]
        Angle that it covers.
    middle : float [rad]
        Angle of its middle in the bearing frame.
    eccentricity : ndarray, shape (2, n) [1]
        Journal from the pad's center of curvature, in clearances of the pad.
    force : ndarray, shape (2, n) [N]
        Force of its film on the journal.
    eccentricity_slopes, force_slopes : ndarray, shape (2, 5), or None [1/m ...], [N/m ...]
        Derivatives of both by x, y, vx, vy, speed, of one state, n = 1; None where they are not asked for.
    """

    extent: float
    middle: float
    eccentricity: Array
    force: Array
    eccentricity_slopes: Array | None = None
    force_slopes: Array | None = None

    @property
    def start(self) -> float:
        """Angle of its first end [rad]."""
        return self.middle - 0.5 * self.extent

    @property
    def turning(self) -> Array:
        """Matrix (2, 2) from its frame to that of the bearing."""
        c, s = np.cos(self.middle), np.sin(self.middle)
        return np.array([[c, -s], [s, c]])


def losses_of_pads(
    bearing: PadBearing,
    film: LossyPadFilm,
    pads: Sequence[PadUnderJournal],
    state: tuple[Array, Array, Array],
    *,
    full_gap: bool,
) -> BearingLosses:
    """Return what the films of all pads take from the shaft, and the oil that runs through them.

    Parameters
    ----------
    bearing : PadBearing
    film : LossyPadFilm
        The film law of its pads.
    pads : sequence of PadUnderJournal
        Pads at the states.
    state : (ndarray, ndarray, ndarray)
        Positions (2, ...) [m], velocities (2, ...) [m/s] and speeds (...) [rad/s].
    full_gap : bool
        Whether oil fills the gap in the ruptured zone too, and not in streamers.

    Notes
    -----
    With E_k the journal from the center of curvature of a pad, F_k the force of its film and M_k = viscosity
    speed (R^3 L/c_p) Sigma_k, the torque on the journal is M = sum(M_k + (E_k x F_k)/2). That on pads and
    bush is M - position x F, the balance of moments, and the power M speed - F . velocity: its pressure part,
    -sum F_k . W_k, is exact in any motion. Sigma and the flows are those of a journal at rest in that place,
    which is what an equilibrium asks for; in motion oil that runs along at half the speed is taken for them.
    """
    omega = state[2].ravel()
    flows = flows_of_pads(film, bearing.slenderness, pads, 0.5 * omega)
    shears = [
        gap_of_pad(film, pad.extent, pad.eccentricity, 0.5 * omega).shear if full_gap else flows[k].shear
        for k, pad in enumerate(pads)
    ]
    per_shear = bearing.film_viscosity * omega * bearing.radius**3 * bearing.length / bearing.clearance
    e, F = (np.stack(rows, axis=1) for rows in zip(*(pad[2:4] for pad in pads), strict=True))
    drag = per_shear * sum(shears) + 0.5 * bearing.clearance * cross(e, F).sum(axis=0)
    middles = np.array([[pad.middle] for pad in pads])
    c, s = np.cos(middles), np.sin(middles)
    force = np.stack([(c * F[0] - s * F[1]).sum(axis=0), (s * F[0] + c * F[1]).sum(axis=0)])
    into, out = (np.stack([getattr(each, name) for each in flows]) for name in ("inflow", "arriving"))
    starts = [pad.start for pad in pads]
    return collected_losses(bearing, starts, drag, force, (into, out), state)


def collected_losses(
    bearing: PadBearing,
    starts: Sequence[float],
    drag: Array,
    force: Array,
    flows: tuple[Array, Array],
    state: tuple[Array, Array, Array],
) -> BearingLosses:
    """Return the losses of a bearing from what the films of its pads do at n states; see `losses_of_pads`.

    Parameters
    ----------
    bearing : PadBearing
    starts : sequence of float [rad]
        Angles of the first ends of the pads.
    drag : ndarray, shape (n,) [N m]
        Torque on the journal.
    force : ndarray, shape (2, n) [N]
        Force on the journal.
    flows : (ndarray, ndarray), shape (pads, n) [1/s]
        Oil that enters the film of each pad, and what comes to the opening behind it, in units of c_p R L.
    state
        As in `losses_of_pads`.
    """
    position, velocity, speed = state
    shape, omega = speed.shape, speed.ravel()
    q, v = position.reshape(2, -1), velocity.reshape(2, -1)
    unit = bearing.clearance * bearing.radius * bearing.length
    inflow, arriving = (
        unit * rows.reshape(len(starts), *shape) for rows in behind_pads(starts, *flows, omega >= 0.0)
    )
    power = drag * omega - (force * v).sum(axis=0)
    require_no_overflow(power, *state)
    return BearingLosses(
        power_loss=_number(power, shape),
        friction_torque=_number(drag, shape),
        bush_torque=_number(drag - cross(q, force), shape),
        side_flow=_number((inflow - arriving).sum(axis=0), shape),
        inflow=inflow,
        arriving=arriving,
    )


def flows_of_pads(
    film: LossyPadFilm, slenderness: float, pads: Sequence[PadUnderJournal], rate: Array
) -> list[PadFlows]:
    """Return shear and flow of each pad, those of one extent found together."""
    found: dict[int, PadFlows] = {}
    for extent in dict.fromkeys(pad.extent for pad in pads):
        alike = [k for k, pad in enumerate(pads) if pad.extent == extent]
        e = np.concatenate([pads[k].eccentricity for k in alike], axis=1)
        together = film.losses(extent, slenderness)(e, np.tile(rate, len(alike)))
        parts = [row.reshape(*row.shape[:-1], len(alike), -1) for row in together if row is not None]
        found |= {k: PadFlows(*(part[..., number, :] for part in parts)) for number, k in enumerate(alike)}
    return [found[k] for k in range(len(pads))]


def behind_pads(
    starts: Sequence[float], into: Array, out: Array, forward: NDArray[np.bool_]
) -> tuple[Array, Array]:
    """Return what leaves each opening and what arrives there, from what enters pads and leaves their ends.

    The opening of a number is the gap behind the pad of that number, in the sense of +theta.

    Parameters
    ----------
    starts : sequence of float [rad]
        Angles of the first ends of the pads.
    into, out : ndarray, shape (pads, ...)
    forward : ndarray of bool
        Whether oil runs in the sense of +theta.
    """
    order = np.argsort([start % TURN for start in starts], kind="stable")
    following = np.empty(len(starts), dtype=int)
    following[order] = np.roll(order, -1)
    return np.where(forward, into[following], into), np.where(forward, out, out[following])


def cross(a: Array, b: Array) -> Array:
    """Return the z component of a x b, of vectors (2, ...)."""
    return np.asarray(a[0] * b[1] - a[1] * b[0])


def _number(values: Array, shape: tuple[int, ...]) -> float | Array:
    """Return values in the shape of the states, a single number as such."""
    return values.reshape(shape) if shape else float(values.sum())


# Derivatives of the heat of a bearing made of fixed pads by position, velocity and speed of the journal.


SPEED = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
"""Derivative of the speed by the state x, y, vx, vy, speed."""


def heat_slopes_of_pads(
    bearing: PadBearing,
    film: LossyPadFilm,
    pads: Sequence[PadUnderJournal],
    state: tuple[Array, Array, float],
    cooling: Cooling,
) -> Array:
    """Return d(power, effective flow, side flow)/d(x, y, vx, vy, speed) at one viscosity, shape (3, 5).

    Parameters
    ----------
    bearing, film, pads, state
        As in `losses_of_pads`, with slopes, at one state.
    cooling : Cooling
        Its carry-over, and whether the gap is full.

    Raises
    ------
    InputError
        If the film law has no slopes of its losses.
    """
    _, velocity, speed = state
    flows = flows_of_pads(film, bearing.slenderness, pads, np.array([0.5 * speed]))
    per_shear = bearing.film_viscosity * bearing.radius**3 * bearing.length / bearing.clearance
    torque, by_state, force, by_force = 0.0, np.zeros(5), np.zeros(2), np.zeros((2, 5))
    into, out = np.zeros((2, len(pads), 5))
    for k, (pad, of) in enumerate(zip(pads, flows, strict=True)):
        de, dF = cast(Array, pad.eccentricity_slopes), cast(Array, pad.force_slopes)
        if of.slopes is None:
            raise InputError(f"film must have slopes of its losses, such as PadMapFilm, got {film!r}")
        slopes = of.slopes[:, :, 0]
        shear, by_e = of.shear[0], slopes[0, :2]
        if cooling.full_gap:
            gap = gap_of_pad(film, pad.extent, pad.eccentricity, np.array([0.5 * speed]))
            shear, by_e = gap.shear[0], gap.slopes[:, 0]
        e, F = pad.eccentricity[:, 0], pad.force[:, 0]
        torque += per_shear * speed * shear + 0.5 * bearing.clearance * float(cross(e, F))
        by_state += per_shear * (shear * SPEED + speed * by_e @ de)
        by_state += 0.5 * bearing.clearance * (cross(de, F) + cross(e, dF))
        force += pad.turning @ F
        by_force += pad.turning @ dF
        into[k], out[k] = (row[:2] @ de + 0.5 * row[2] * SPEED for row in slopes[1:])
    by_velocity = np.array([0.0, 0.0, *force, 0.0])
    power = speed * by_state + torque * SPEED - velocity @ by_force - by_velocity
    unit = bearing.clearance * bearing.radius * bearing.length
    forward = np.array(speed >= 0.0)
    entering = np.stack([of.inflow[0] for of in flows]), np.stack([of.arriving[0] for of in flows])
    starts = [pad.start for pad in pads]
    rates, slopes_behind = behind_pads(starts, *entering, forward), behind_pads(starts, into, out, forward)
    side = unit * (slopes_behind[0] - slopes_behind[1]).sum(axis=0)
    by_flows = flow_slopes(*rates, cooling.carry_over)
    replaced = sum(by @ slopes for by, slopes in zip(by_flows, slopes_behind, strict=True))
    return np.stack([power, side + unit * replaced, side])
