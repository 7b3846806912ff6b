"""Tilting pads under a journal at rest: where they stand, what they carry, what a journal feels of them."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ....errors import InputError, UnloadedPadWarning, require_finite, require_number, warn_user
from ....model import Array, Tangent
from ....native import Status
from ....native.pads.tilting_kernel import RestPoint
from ....readable.result import Readable
from ....results import BearingLosses, Equilibrium
from ...at_frequency import coefficients_of
from ...reaction import broadcast_state
from ..losses_of_pads import PadUnderJournal, losses_of_pads
from ..pad_film import warn_beyond_map
from ..pad_losses import LossyPadFilm
from .held_pads import TURN, PadSlopes, pad_slopes, turning
from .pad_contact import report_pads
from .pad_matrices import PadMatrices, PadsStiffness, ReducedCoefficients
from .pivots import directions
from .tilting_pads import TiltingPads


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
