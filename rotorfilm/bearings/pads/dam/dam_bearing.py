"""The pressure dam bearing in SI units: the film on the grids of its pads, its losses and its heat."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ....errors import InputError
from ....inputs.si_arguments import quantities
from ....model import Array
from ....native.spec import NativeSpec, parameter
from ....results import BearingLosses
from ...kernel_reaction import KernelReaction
from ...reaction import broadcast_state
from ..losses_of_pads import BearingFlow, collected_losses, cross
from .dam_kernel import LOSSES, DamKernel, PadPressure, pad_places
from .recessed_pads import RecessedPads

PARAMETERS = (
    ("radius", "m", "bearing radius"),
    ("length", "m", "axial length"),
    ("clearance", "m", "radial clearance of a pad"),
    ("viscosity", "Pa.s", "dynamic viscosity"),
)
"""Names, units and meanings of what a simulator may set in the compiled bearing."""


@quantities
@dataclass(frozen=True, kw_only=True)
class PressureDamBearing(RecessedPads, KernelReaction):
    """A bearing of fixed pads, any of which may have a recess: pressure dam, step, relief track.

    x and y are Cartesian from the bearing center, rotation is about +z, the force acts on the journal.
    Angles are absolute, from +x towards +y. The film is two-dimensional, on a grid of its own for each pad,
    with ambient pressure, 0, at all edges of the pads and where it ruptures.

    Its parameters are those of `RecessedPads` and of every `PadBearing`.

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
    ...     diameter="25.4 mm", length="25.4 mm", pad_clearance="55.9 um", viscosity=0.0524, pads=pads
    ... )
    >>> bearing.force(position=[0.0, -1e-5], velocity=[0.0, 0.0], speed=837.8).shape
    (2,)
    """

    def prepared_force(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `force` for inner loops: float arrays of equal batch shape."""
        return self._answers(self.kernel, position, velocity, speed, False).reshape(position.shape)

    def prepared_jacobian(self, position: Array, velocity: Array, speed: Array) -> Array:
        """Return `jacobian` for inner loops: float arrays of equal batch shape."""
        found = self._answers(self.kernel, position, velocity, speed, True)
        return found.reshape(2, 5, *position.shape[1:])

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
        plain, richer = (self._answers(self.kernel_on(both), *state, False) for both in (False, True))
        return np.hypot(*(richer - plain)).reshape(state[2].shape)

    def pressure(self, pad: int, position: ArrayLike, velocity: ArrayLike, speed: float) -> PadPressure:
        """Return the pressure on pads[pad] at a position (2,) [m], velocity (2,) [m/s] and speed [rad/s]."""
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        state = (*q.tolist(), *v.tolist(), float(omega))
        found, status = self.kernel.pressure(pad, np.array(state))
        if status:
            self.report(status, state)
        theta, axial = pad_places(self.pads[pad], self.cells)
        return PadPressure(theta, axial, np.pad(found, ((0, 1), (0, 1))))

    def losses(
        self, position: ArrayLike, velocity: ArrayLike, speed: ArrayLike, *, full_gap: bool | None = None
    ) -> BearingLosses:
        """Return power loss, torques and oil flow, by the film on these cells.

        The opening of a number is the gap behind the pad of that number, in the sense of +theta. Where
        `full_gap` is None, it is that of the cooling, or false. Flow in recesses is laminar, as the film.

        Raises
        ------
        InputError, FilmContactError
            As `force`.

        Notes
        -----
        As `losses_of_pads`; pressure on the steps adds c_p D p/2 to the torque, integrated along their edges.
        A film begins only where streamers bring what it takes; its force is that of the film without this.
        """
        q, v, omega = broadcast_state(position, velocity, speed)
        self.require_film(q)
        states = _flat(q, v, omega)
        rows = np.empty((len(self.pads), LOSSES, omega.size))
        for k, state in enumerate(states.T):
            rows[..., k] = self._losses_at(state)
        force, (steps, streamers, gap), flows = rows[:, :2], rows.swapaxes(0, 1)[2:5], rows[:, 5:]
        turning, scale, c = states[4], self.force_scale, self.clearance
        centers = np.array([pad.center for pad in self.pads])
        e = states[:2] / c - centers[:, :, None]
        pressed = np.stack([cross(*pair) for pair in zip(e, force, strict=True)]) + steps
        shear = (gap if self.full_gap(full_gap) else streamers) * turning
        flow = BearingFlow(
            drag=scale * c * (shear + 0.5 * pressed).sum(axis=0),
            force=scale * force.sum(axis=0),
            into=flows[:, 0],
            out=flows[:, 1],
        )
        return collected_losses(self, self.pads, flow, (q, v, omega))

    def _losses_at(self, state: Array) -> Array:
        found, status = self.kernel.losses(state)
        if status:
            self.report(status, state.tolist())
        return found

    def film_at_unit_viscosity(self) -> None:
        """Return no film for the loops in C over warm films, which know one film only."""

    def heat_jacobian(self, position: ArrayLike, velocity: ArrayLike, speed: float) -> Array:
        """Raise InputError: the heat of pads with recesses has no slopes."""
        raise InputError("bearing must have slopes of its heat, as a LobedBearing, got pads with recesses")

    def native(self) -> NativeSpec | None:
        """Return the kernel of the C library that is this bearing; a subclass has none."""
        if type(self) is not PressureDamBearing or self.is_warming:
            return None
        parameters = tuple(
            parameter(name, unit, value, text)
            for (name, unit, text), value in zip(PARAMETERS, self.kernel.dimensions, strict=True)
        )
        tables = {"pads": self.rows, "extrapolated": np.array([float(self.extrapolated)])}
        return NativeSpec(kernel="pressure_dam", parameters=parameters, tables=tables)

    def _answers(
        self, film: DamKernel, position: Array, velocity: Array, speed: Array, differentiated: bool
    ) -> Array:
        states = _flat(position, velocity, speed)
        batch = film.batch(states, differentiated=differentiated)
        if batch.status:
            self.report(batch.status, states[:, batch.first].tolist())
        return batch.values


def _flat(position: Array, velocity: Array, speed: Array) -> Array:
    """Return the states of a batch, of any shape, as columns (5, n)."""
    return np.concatenate([position.reshape(2, -1), velocity.reshape(2, -1), speed.reshape(1, -1)])
