"""The film of one bearing by a film law in numpy: kinematics, scaling, and mirrored rotation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import require_inside
from ...model import Array
from ..reaction import broadcast_state
from .law import CENTER, FilmLaw, FilmOptions, options

ROUNDOFF = 1e-14
"""A source below this fraction of its two terms is their cancellation, hence zero."""


@dataclass(frozen=True, kw_only=True)
class BoundLaw:
    """A film of one bearing in SI units: `law.BoundFilm` over any film law.

    Parameters
    ----------
    law : FilmLaw
    slenderness : float [1]
        Length / diameter.
    clearance : float [m]
    force_per_rate : float [N s]
        viscosity length radius^3 / clearance^2.
    mirrored : bool
        Whether backward rotation is mirrored. The arc of `FixedArc` follows the sense of rotation. Pads and
        grooves do not: a law fitted to them takes any source, and is left as it is.
    """

    law: FilmLaw
    slenderness: float
    clearance: float
    force_per_rate: float
    mirrored: bool

    def call(self, x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
        """Return (force_x, force_y) [N] for numbers."""
        force_x, force_y = self.force(*broadcast_state((x, y), (vx, vy), speed)).tolist()
        return force_x, force_y

    def tangent(
        self, x: float, y: float, vx: float, vy: float, speed: float
    ) -> tuple[float, float, list[float]]:
        """Return (force_x, force_y) [N] and the ten entries of the Jacobian, row by row, for numbers."""
        state = broadcast_state((x, y), (vx, vy), speed)
        force_x, force_y = self.force(*state).tolist()
        return force_x, force_y, self.jacobian(*state).ravel().tolist()

    def force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return the force [N], shape (2, ...)."""
        eccentricity, source = kinematics(position, velocity, speed, self.clearance)
        mirror = self._mirror(speed)
        film = self._in_mirror("force", (2,), mirror, eccentricity, source)
        return self.force_per_rate * mirror * film

    def jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return d force / d (x, y, vx, vy, speed), shape (2, 5, ...)."""
        eccentricity, source = kinematics(self._off_center(position), velocity, speed, self.clearance)
        mirror = self._mirror(speed)
        film = self._in_mirror("jacobian", (2, 4), mirror, eccentricity, source)
        film = self.force_per_rate * mirror[:, None] * film * np.tile(mirror, (2, *(1,) * speed.ndim))
        by_eccentricity, by_source = film[:, :2], film[:, 2:]
        # w = v/c - (speed/2) (-e_y, e_x), so the columns of F_w (z^ x .) are (F_wy, -F_wx).
        turned = np.stack([by_source[:, 1], -by_source[:, 0]], axis=1)
        by_position = (by_eccentricity - 0.5 * speed * turned) / self.clearance
        by_speed = 0.5 * (by_source[:, 0] * eccentricity[1] - by_source[:, 1] * eccentricity[0])
        return np.concatenate([by_position, by_source / self.clearance, by_speed[:, None]], axis=1)

    def _in_mirror(
        self, what: str, shape: tuple[int, ...], mirror: Array, eccentricity: Array, source: Array
    ) -> Array:
        """Return what the law says where nothing is mirrored, and what its image says where something is."""
        image, turned = options(self.law, FilmOptions).mirrored(), mirror[1] < 0.0
        e, w = mirror * eccentricity, mirror * source
        if image is None or not turned.any():
            return np.asarray(getattr(self.law, what)(e, w, self.slenderness))
        found = np.empty((*shape, *turned.shape))
        for law, some in ((self.law, ~turned), (image, turned)):
            found[..., some] = getattr(law, what)(e[:, some], w[:, some], self.slenderness)
        return found

    def _off_center(self, position: Array) -> Array:
        """Return the position, moved onto the circle `CENTER` * clearance where it is inside that.

        A law in polar axes has its derivative at the center as a limit; moving the position, and the source
        with it, takes the limit along x.
        """
        distance = np.hypot(position[0], position[1])
        on_circle = np.stack([np.full_like(distance, CENTER * self.clearance), np.zeros_like(distance)])
        return np.where(distance < CENTER * self.clearance, on_circle, position)

    def _mirror(self, speed: Array) -> Array:
        """Return the signs (1, +-1) of the reflection that makes the rotation positive, shape (2, ...)."""
        mirror = np.ones((2, *speed.shape))
        if self.mirrored:
            mirror[1] -= 2.0 * (speed < 0.0)
        return mirror


def kinematics(position: Array, velocity: Array, speed: Array, clearance: float) -> tuple[Array, Array]:
    """Return the eccentricity and the source w = v/c - (speed/2) z^ x e of the film laws.

    Raises FilmContactError where the journal touches the wall.
    """
    require_inside(position, clearance)
    eccentricity = position / clearance
    squeeze = velocity / clearance
    wedge = eccentricity[::-1] * (0.5 * speed)
    wedge[1] *= -1.0
    source = squeeze + wedge
    terms = (abs(squeeze) + abs(wedge)).max(axis=0)
    source *= abs(source).max(axis=0) > ROUNDOFF * terms
    return eccentricity, source
