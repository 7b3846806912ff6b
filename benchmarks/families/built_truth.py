"""A film of a damper with seals and inertia on circular orbits, by collocation and differences of its own.

In axes that turn with the orbit all fields stand still, d/dt = -d/dtheta. Lengths along the film in radii,
across it in clearances; pressures in 12 viscosity speed radius^2/clearance^2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import BarycentricInterpolator
from scipy.linalg import lu_factor, lu_solve
from scipy.signal import resample
from scipy.sparse import csr_matrix, diags, eye, kron
from scipy.sparse.linalg import spsolve
from squeeze_inertia import chebyshev, exact_orbit

AROUND, ALONG = 64, 9
"""Nodes of collocation around and from the middle to an end: 1e-7 of the force to eps .8."""
CELLS = (288, 40)
"""Cells of a film that ruptures: within 5e-4 of its force."""

Field = np.ndarray


@dataclass(frozen=True)
class Place:
    """A film of half length / radius s, leak 12 mu R G_s/c^3 (infinite: open), at a distance and Re."""

    s: float
    leak: float
    eps: float
    reynolds: float

    @cached_property
    def h(self) -> Field:
        """Film thickness by angle."""
        return 1.0 + self.eps * np.cos(angles(AROUND))

    @cached_property
    def h_t(self) -> Field:
        """Its rate."""
        return self.eps * np.sin(angles(AROUND))

    @cached_property
    def along(self) -> tuple[Field, Field]:
        """Nodes from the middle to an end, and derivatives."""
        x, D, _ = chebyshev(ALONG)
        return self.s * x, D / self.s

    def around(self, field: Field) -> Field:
        """Return the derivative by the angle of a field (ALONG, AROUND)."""
        order = np.fft.rfftfreq(AROUND, 1.0 / AROUND)
        order[-1] = 0.0
        return np.fft.irfft(1j * order * np.fft.rfft(field, axis=-1), AROUND, axis=-1)

    @cached_property
    def factors(self) -> tuple[Field, Field]:
        """LU factors of div(h^3 grad p) with the conditions at the middle and at the end."""
        D = self.around(np.eye(AROUND)).T
        Dz = self.along[1]
        cube = np.diag(self.h**3)
        A = np.kron(np.eye(ALONG), D @ cube @ D) + np.kron(Dz @ Dz, cube)
        A[:AROUND] = np.kron(Dz[:1], np.eye(AROUND))
        A[-AROUND:] = np.kron(np.eye(ALONG)[-1:], np.eye(AROUND))
        if math.isfinite(self.leak):
            A[-AROUND:] = np.kron(Dz[-1:], cube) + self.leak * A[-AROUND:]
        return lu_factor(A)

    def pressure(self, source: Field, end: Field | float = 0.0) -> Field:
        """Return p of div(h^3 grad p) = source; with seals h^3 dp/dz + leak p = end there."""
        b = source.copy()
        b[0], b[-1] = 0.0, end
        return lu_solve(self.factors, b.ravel()).reshape(b.shape)

    @cached_property
    def viscous(self) -> Field:
        """Pressure of the viscosity."""
        return self.pressure(np.tile(self.h_t, (ALONG, 1)))

    @cached_property
    def inertia(self) -> tuple[Field, Field]:
        """Of the bracket in sfd: -h^3 times it around and along, from the viscous velocities."""
        Dz, h = self.along[1], self.h
        u, w = -(h**2) * self.around(self.viscous), -(h**2) * (Dz @ self.viscous)

        def bracket(v: Field) -> Field:
            carried = u * self.around(v) + w * (Dz @ v)
            return -(h**3) * (-1.2 * self.around(v) + 54.0 / 35.0 * carried - 6.0 / 35.0 * self.h_t / h * v)

        return bracket(u), bracket(w)

    @cached_property
    def source(self) -> Field:
        """Divergence of that."""
        return self.around(self.inertia[0]) + self.along[1] @ self.inertia[1]

    @cached_property
    def first(self) -> Field:
        """Pressure of the inertia, to be multiplied by Re/12."""
        return self.pressure(self.source, self.inertia[1][-1] if math.isfinite(self.leak) else 0.0)

    def full(self) -> complex:
        """Return radial + i tangential force to first order: integral of p m, 12 mu w R^4/c^2."""
        weights = chebyshev(ALONG)[2][-1] * self.s
        p = weights @ (self.viscous + self.reynolds / 12.0 * self.first)
        return complex(4.0 * np.pi / AROUND * p @ np.exp(1j * angles(AROUND)))

    def ruptured(self) -> complex:
        """Return the same where p >= 0, its source that of viscosity and inertia of the full film."""
        n, m = CELLS
        z = self.s * (np.arange(m) + 0.5) / m
        source = np.tile(self.h_t, (ALONG, 1)) + self.reynolds / 12.0 * self.source
        b = BarycentricInterpolator(self.along[0], resample(source, n, axis=1))(z)
        p = pressed(
            1.0 + self.eps * np.cos(angles(n)), 1.0 + self.eps * np.cos(angles(n) + np.pi / n), b, self.s
        )
        return complex(4.0 * np.pi / n * self.s / m * p.sum(axis=0) @ np.exp(1j * angles(n)))


def angles(count: int) -> Field:
    """Return angles from 0 on, shape (count,)."""
    return 2.0 * np.pi / count * np.arange(count)


def pressed(h: Field, between: Field, source: Field, s: float) -> Field:
    """Return p >= 0 of div(h^3 grad p) <= source by differences, ends open: wet cells until none changes."""
    m, n = source.shape
    k, dz = between**3 * (n / (2.0 * np.pi)) ** 2, s / m
    last = np.roll(k, 1)
    ring = diags([-(k + last), k[:-1], k[:-1], k[-1:], k[-1:]], [0, 1, -1, n - 1, 1 - n])
    ones = np.ones(m - 1)
    middle = np.full(m, -2.0)
    middle[0], middle[-1] = -1.0, -3.0
    axis = diags([middle, ones, ones], [0, 1, -1]) / dz**2
    A = csr_matrix(kron(eye(m), ring) + kron(axis, diags(h**3)))
    b, wet = source.ravel(), source.ravel() < 0.0
    for _ in range(100):
        p = np.zeros(b.size)
        p[wet] = spsolve(A[wet][:, wet].tocsc(), b[wet])
        now = np.where(wet, p > 0.0, A @ p > b)
        if np.array_equal(now, wet):
            return p.reshape(m, n)
        wet = now
    raise RuntimeError("the ruptured film did not settle")


@lru_cache(maxsize=256)
def beyond_large(eps: float, reynolds: float) -> complex:
    """Return what a short full film has beyond first order by the Navier-Stokes equations, less small motion.

    In density radius length^3 speed^2.
    """
    radial, tangential = exact_orbit(eps, reynolds, nodes=21, steps=400)
    s = math.sqrt(1.0 - eps * eps)
    share = 2.0 / ((1.0 + s) * s) - 17.0 / 7.0 * (2.0 / s - 4.0 / (1.0 + s))
    first = math.pi * eps * (0.1 * share - 1j / (reynolds * s**3))
    small = -1j * math.pi * eps * (impedance(reynolds) - 1.0 - 0.1j * reynolds) / reynolds
    return complex(radial, tangential) - first - small


def beyond(place: Place) -> complex:
    """Return what the full film has beyond first order: exact in small motion, the rest as if short."""
    s, reynolds = place.s, place.reynolds
    t, Z = math.tanh(s) / s, impedance(reynolds)
    a = 0.0 if math.isinf(place.leak) else math.tanh(s) / place.leak
    first = 1.0 - t / (1.0 + a) + 0.1j * reynolds * (1.0 - t * (1.0 + 2.0 * a) / (1.0 + a) ** 2)
    small = -2j * math.pi * s * place.eps * (Z * (1.0 - t / (1.0 + a / Z)) - first)
    return small + 2.0 * s * (1.0 - t) * reynolds * beyond_large(place.eps, reynolds)


def impedance(reynolds: float) -> complex:
    """Return -grad p/v of a film of thickness c, exact in the frequency, in 12 viscosity/c^2."""
    wall = 0.5 * np.sqrt(1j * reynolds)
    return complex(1j * reynolds / 12.0 / (1.0 - np.tanh(wall) / wall))
