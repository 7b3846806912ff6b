"""Shear and flow of a film: what decides its power loss, its torques and the oil that leaves it.

The torque on the journal is viscosity omega R^3 L/c times a shear integral Sigma = int int alpha/H dtheta
dzeta, 0 < zeta < 1 along the length, plus (E x F)_z/2. A full film has alpha = 1. Behind its end the oil runs
in streamers between both walls, with the thickness H_r at which the film ended: alpha = min(1, H_r/H). The
side flow is c R L times the source over the film, w . int int n dtheta dzeta with H = 1 - e . n, for nothing
crosses the free ends. Sigma depends on the direction of the source alone; the flow grows with it.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...model import Array
from ...native.loss_kernels import LossKernel
from .geometry import FilmGeometry


class FilmLosses(NamedTuple):
    """Shear and flow of films, dimensionless.

    Attributes
    ----------
    shear_film : ndarray, shape (...) [1]
        Sigma of the film that carries pressure.
    shear_streamers : ndarray, shape (...) [1]
        Sigma of the streamers in the ruptured zone.
    shear_gap : ndarray, shape (...) [1]
        Sigma of a gap that is full all round, but for the openings.
    side_flow : ndarray, shape (...) [1/s]
        Flow out of both ends of the film / (clearance radius length), without that straight out of openings.
    inflow : ndarray, shape (openings, ...) [1/s]
        Oil that leaves each opening into the films beside it, of the same unit; openings in the order of
        `FilmGeometry.openings`.
    arriving : ndarray, shape (openings, ...) [1/s]
        Oil that comes to each opening from the films and streamers beside it.
    slopes : ndarray, shape (3, 4, ...), or None
        Derivatives of shear_film, shear_streamers and side_flow by (eccentricity, source); None where the
        film law has none. Not-a-number where the source vanishes.
    """

    shear_film: Array
    shear_streamers: Array
    shear_gap: Array
    side_flow: Array
    inflow: Array
    arriving: Array
    slopes: Array | None = None

    @property
    def shear(self) -> Array:
        """Sigma of film and streamers [1], shape (...)."""
        return self.shear_film + self.shear_streamers


def kernel_losses(
    kernel: LossKernel, eccentricity: Array, source: Array, geometry: FilmGeometry
) -> FilmLosses:
    """Return the losses of a film by its kernel at states (2, ...), without the flows of openings."""
    shape = eccentricity.shape[1:]
    batch = kernel.losses(eccentricity.reshape(2, -1), source.reshape(2, -1))
    film, streamers, flow = batch.losses.reshape(3, *shape)
    none = np.empty((0, *shape))
    gap = gap_shear(eccentricity, geometry)
    return FilmLosses(film, streamers, gap, flow, none, none, batch.slopes.reshape(3, 4, *shape))


def plain_losses(kernel: LossKernel, eccentricity: Array, source: Array) -> FilmLosses:
    """Return those of a plain film."""
    return kernel_losses(kernel, eccentricity, source, FilmGeometry())


def gap_shear(eccentricity: Array, geometry: FilmGeometry) -> Array:
    """Return Sigma of a gap that is full all round but for the openings, at eccentricities (2, ...)."""
    chi, away = np.hypot(*eccentricity), np.arctan2(-eccentricity[1], -eccentricity[0])
    parts = [
        span.film * (gap_integral(chi, span.end - away) - gap_integral(chi, span.start - away))
        for span in geometry.spans()
        if span.film > 0.0
    ]
    return np.asarray(np.sum(parts, axis=0))


def static_rate(eccentricity: Array, source: Array) -> Array:
    """Return the rate at which the oil of a journal at rest runs, speed/2 [1/s]; 0 at the center."""
    squared = (eccentricity * eccentricity).sum(axis=0)
    turned = eccentricity[1] * source[0] - eccentricity[0] * source[1]
    return np.asarray(np.where(squared > 0.0, turned, 0.0) / np.where(squared > 0.0, squared, 1.0))


def gap_integral(chi: Array | float, angle: Array | float) -> Array:
    """Return the integral of 1/(1 + chi cos t) from 0 to an angle of any size.

    On a pad chi may be above 1: then the film between 0 and the angle must be open.
    """
    turns = np.round(angle / (2.0 * np.pi))
    rest = 0.5 * (angle - 2.0 * np.pi * turns)
    closed = np.asarray(chi) < 1.0
    root = np.sqrt(np.abs((1.0 - chi) * (1.0 + chi)))
    ratio = np.sqrt(np.abs((1.0 - chi) / (1.0 + chi)))
    bent = np.arctan2(ratio * np.sin(rest), np.cos(rest)) + np.pi * turns
    if not closed.all():
        bent = np.where(closed, bent, np.arctanh(np.where(closed, 0.0, ratio * np.tan(rest))))
    return np.asarray(2.0 / root * bent)


def squared_integral(chi: Array | float, angle: Array | float) -> Array:
    """Return the integral of 1/(1 + chi cos t)^2 from 0 to an angle of any size."""
    edge = chi * np.sin(angle) / (1.0 + chi * np.cos(angle))
    return np.asarray((gap_integral(chi, angle) - edge) / ((1.0 - chi) * (1.0 + chi)))


def film_shear(chi: float, ends: Array, weight: Array) -> tuple[float, float]:
    """Return Sigma of a film between two ends, and of the streamers behind the second one.

    Parameters
    ----------
    chi : float [1]
        Eccentricity ratio.
    ends : ndarray, shape (2, Q) [rad]
        Where the film begins and ends, from the line of maximum film in the direction in which the oil runs.
    weight : ndarray, shape (Q,)
        Axial weights.
    """
    first, last = ends
    film = gap_integral(chi, last) - gap_integral(chi, first)
    back = first + 2.0 * np.pi
    # Only where the thickness is again that of the end do streamers fill the gap, or no longer.
    image = -last + 2.0 * np.pi * np.ceil((2.0 * last) / (2.0 * np.pi))
    image = np.clip(image, last, back)
    thickness = 1.0 + chi * np.cos(last)
    shares = np.zeros_like(last)
    for start, end in ((last, image), (image, back)):
        full = 1.0 + chi * np.cos(0.5 * (start + end)) <= thickness
        streamer = thickness * (squared_integral(chi, end) - squared_integral(chi, start))
        shares = shares + np.where(full, gap_integral(chi, end) - gap_integral(chi, start), streamer)
    return float(weight @ film), float(weight @ shares)


def film_flow(sine: float, cosine: float, ends: Array, weight: Array) -> float:
    """Return what a film between two ends gives off: minus the integral of sine sin t + cosine cos t."""
    first, last = ends
    gained = sine * (np.cos(last) - np.cos(first)) - cosine * (np.sin(last) - np.sin(first))
    return float(weight @ gained)
