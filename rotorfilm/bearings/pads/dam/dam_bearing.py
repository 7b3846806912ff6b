"""The pressure dam bearing in SI units: pads with recesses, validation, and the film on their grids."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ....errors import (
    ConvergenceError,
    FilmContactError,
    InputError,
    UndefinedDerivativeError,
    require_each,
    require_kind,
    require_positive,
    require_tuple,
    require_vector,
)
from ....inputs.si_arguments import quantities
from ....model import Array, Force, Tangent
from ....native.film_kernels import Status
from ....native.spec import NativeParameter, NativeSpec
from ...film_units import FilmUnits
from ...films.geometry import FilmGeometry, Pad
from ...films.ring.ring_grids import are_counts
from ...reaction import StaticReaction, broadcast_state
from .dam_kernel import DamKernel, PadPressure, pad_places, pad_rows
from .recessed_pad import RecessedPad

PARAMETERS = (
    ("radius", "m", "bearing radius"),
    ("length", "m", "axial length"),
    ("clearance", "m", "least radial clearance of a centered journal"),
    ("viscosity", "Pa.s", "dynamic viscosity"),
)
"""Names, units and meanings of what a simulator may set in the compiled bearing."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PressureDamBearing(StaticReaction, FilmUnits):
    """A bearing of fixed pads, any of which may have a recess: pressure dam, step, relief track.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal.
    Angles are absolute, from +x towards +y. The film is two-dimensional, on a grid of its own for each pad,
    with ambient pressure, 0, at all edges of the pads and where it ruptures.

    Parameters
    ----------
    radius : float [m]
        Bearing radius; or `diameter`, twice that.
    length : float [m]
        Axial length of the pads.
    clearance : float [m]
        Radial clearance of the bearing as assembled: the least film of a centered journal. A pad with a
        preload is made with the larger pad clearance, clearance / (1 - preload).
    viscosity : float [Pa s]
        Dynamic viscosity of the lubricant.
    pads : tuple of RecessedPad
        See `pressure_dam_pads` for the usual two.
    cells : tuple of int
        Cells around each pad and along half the length, multiples of 4 and at least 16 and 8; on both sides
        of the edges of a recess about as many as its part of them, at least 4.
    extrapolated : bool
        Whether the force is extrapolated from these cells and half as many, by a third of the difference.

    Raises
    ------
    InputError
        If a value breaks its rule, the clearance is not below the radius, or pads overlap.

    Notes
    -----
    With d the position from the pad's center of curvature, c_p the pad clearance, e = d/c_p, D the depth of
    the recess over c_p, H = 1 - e.n + D, n = (cos theta, sin theta), w = velocity/c_p - (speed/2) z^ x e and
    z from the middle, 0, to the end, 1, of the bearing,

        (H^3 P_theta)_theta + (L/D)^-2 H^3 P_zz = -w.n + (speed/2) D_theta,  p = 12 viscosity (R/c_p)^2 P,

    P >= 0 (Nicholas & Allaire 1980). Edges of recesses are on nodes, and what flows across a step is the
    difference of the Couette flow of both sides. Derivatives are those of the discrete film, the edge of the
    ruptured zone held, where its pressure and slope vanish; the damping matrix is symmetric. Left out are
    losses and inertia at the step, turbulence in a deep recess, inlet pressure and hot oil from pad to pad.
    The force is of degree one in velocity and speed together: there is no map of it over the source alone.

    Examples
    --------
    >>> from rotorfilm import PressureDamBearing, pressure_dam_pads
    >>> pads = pressure_dam_pads(depth="61 um", end="145 deg", share=0.75)
    >>> bearing = PressureDamBearing(
    ...     diameter="25.4 mm", length="25.4 mm", clearance="55.9 um", viscosity=0.0524, pads=pads
    ... )
    >>> bearing.force(position=[0.0, -1e-5], velocity=[0.0, 0.0], speed=837.8).shape
    (2,)
    """

    radius: float
    length: float
    clearance: float
    viscosity: float
    pads: tuple[RecessedPad, ...]
    cells: tuple[int, int] = (64, 16)
    extrapolated: bool = True

    def __post_init__(self) -> None:
        require_each(self, require_positive, "radius", "length", "clearance", "viscosity")
        require_tuple("pads", self.pads, RecessedPad)
        require_kind("extrapolated", self.extrapolated, bool, "True or False")
        if not self.pads:
            raise InputError(f"pads must be one at least, got {self.pads!r}")
        if not are_counts(self.cells, (16, 8), (4, 4)):
            raise InputError(f"cells must be two multiples of 4, at least (16, 8), got {self.cells!r}")
        for pad in self.pads:
            if self.clearance >= self.radius * (1.0 - pad.preload):
                raise InputError(
                    f"clearance / (1 - preload) must be below the radius {self.radius!r}, "
                    f"got clearance {self.clearance!r} and preload {pad.preload!r}"
                )
        FilmGeometry(pads=tuple(Pad(start=pad.start, extent=pad.extent) for pad in self.pads))

    @property
    def film_viscosity(self) -> float:
        """Dynamic viscosity of the film [Pa s]."""
        return self.viscosity

    def minimum_film(self, position: ArrayLike) -> Array:
        """Return the least film over all pads [m], shape (...), of journals at positions (2, ...) [m].

        It is not positive where one is touched.
        """
        at = require_vector("position", position)
        films = [self._film.least(x, y)[0] for x, y in at.reshape(2, -1).T.tolist()]
        return np.array(films).reshape(at.shape[1:])

    def require_film(self, position: Array) -> None:
        """Raise FilmContactError, with the pad, unless the journal at position (2, ...) [m] touches none.

        Inside the circle of the clearance it never does, outside it need not.
        """
        flat = position.reshape(2, -1)
        for x, y in flat[:, ~(np.hypot(*flat) < self.clearance)].T.tolist():
            least, touched = self._film.least(x, y)
            if not least > 0.0:
                pad = self.pads[touched]
                raise FilmContactError(
                    f"position must keep the journal off pads[{touched}], {math.degrees(pad.start):.6g} to "
                    f"{math.degrees(pad.end):.6g} deg, got ({x!r}, {y!r}) m with a film of {least:.6g} m"
                )

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._answers(self._film, position, velocity, speed, False).reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        found = self._answers(self._film, position, velocity, speed, True)
        return found.reshape(2, 5, *position.shape[1:])

    def prepare(self) -> Force:
        """Return the force as a function of five numbers; see `StaticReaction.prepare`."""
        film = self._film

        def call(x: float, y: float, vx: float, vy: float, speed: float) -> tuple[float, float]:
            force_x, force_y, status = film.call(x, y, vx, vy, speed)
            if status:
                self._report(status, (x, y, vx, vy, speed))
            return force_x, force_y

        return call

    def prepare_tangent(self) -> Tangent:
        """Return force and derivatives as one function of five numbers; see `model.TangentReaction`."""
        film = self._film

        def tangent(
            x: float, y: float, vx: float, vy: float, speed: float
        ) -> tuple[float, float, list[float]]:
            force_x, force_y, derivatives, status = film.tangent(x, y, vx, vy, speed)
            if status:
                self._report(status, (x, y, vx, vy, speed))
            return force_x, force_y, derivatives

        return tangent

    def force_error(self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike) -> Array:
        """Return the estimate of the error of the force of these cells, not extrapolated [N], shape (...).

        It is a third of the difference from half as many; the extrapolated force is closer.

        Parameters
        ----------
        position, velocity, speed
            As in `force`.
        """
        state = broadcast_state(position, velocity, speed)
        self.require_film(state[0])
        plain, richer = (
            self._answers(DamKernel(self._rows, self._dimensions, both), *state, False)
            for both in (False, True)
        )
        return np.hypot(*(richer - plain)).reshape(state[2].shape)

    def pressure(self, pad: int, position: ArrayLike, velocity: ArrayLike, speed: float) -> PadPressure:
        """Return the pressure on pads[pad] at a position (2,) [m], velocity (2,) [m/s] and speed [rad/s]."""
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        state = (*q.tolist(), *v.tolist(), float(omega))
        found, status = self._film.pressure(pad, np.array(state))
        if status:
            self._report(status, state)
        theta, axial = pad_places(self.pads[pad], self.cells)
        return PadPressure(theta, axial, np.pad(found, ((0, 1), (0, 1))))

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; a subclass has none."""
        if type(self) is not PressureDamBearing:
            return None
        parameters = tuple(
            NativeParameter(
                name=name,
                unit=unit,
                value=self._dimensions[name],
                tunable=True,
                minimum=0.0,
                nominal=self._dimensions[name],
                description=text,
            )
            for name, unit, text in PARAMETERS
        )
        tables = {"pads": self._rows, "extrapolated": np.array([float(self.extrapolated)])}
        return NativeSpec(kernel="pressure_dam", parameters=parameters, tables=tables)

    @cached_property
    def _rows(self) -> Array:
        return pad_rows(self.pads, self.cells)

    @cached_property
    def _dimensions(self) -> dict[str, float]:
        return {name: float(getattr(self, name)) for name, _, _ in PARAMETERS}

    @cached_property
    def _film(self) -> DamKernel:
        return DamKernel(self._rows, self._dimensions, self.extrapolated)

    def _answers(
        self, film: DamKernel, position: Array, velocity: Array, speed: Array, differentiated: bool
    ) -> Array:
        states = np.concatenate([np.reshape(part, (-1, speed.size)) for part in (position, velocity, speed)])
        batch = film.batch(states, differentiated=differentiated)
        if batch.status:
            self._report(batch.status, states[:, batch.first].tolist())
        return batch.values

    def _report(self, status: int, state: tuple[float, ...] | list[float]) -> None:
        """Raise what the status of a state x, y, vx, vy, speed says."""
        x, y, vx, vy, speed = state
        said = f"got ({x!r}, {y!r}) m, ({vx!r}, {vy!r}) m/s and {speed!r} rad/s"
        if status == Status.UNDEFINED:
            raise UndefinedDerivativeError(
                "velocity and speed must drive the film of every pad where a derivative is asked for, " + said
            )
        if status == Status.AT_WALL:
            self.require_film(np.array([x, y]))
        if status == Status.NOT_FINITE:
            raise InputError(f"position, velocity and speed must be finite and not overflow, {said}")
        if status == Status.NO_MEMORY:
            raise MemoryError("no memory for the film of a pad")
        raise ConvergenceError(f"the search for the ruptured zone of a pad must end, and did not: {said}")
