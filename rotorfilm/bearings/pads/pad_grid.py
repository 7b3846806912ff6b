"""The two-dimensional film on one pad: the reference of its map.

In the frame of a pad its middle is at the angle 0. With the center of curvature r_p, the clearance c_p and
the velocity v_p of the pad the film knows only e = (r - r_p)/c_p and w = (v - v_p)/c_p - (speed/2) z^ x e: a
pad that is displaced is one in its place with another e (Lund 1964). H = 1 - e.n > 0 is asked for on the arc
alone, so that |e| may be above 1. Forces are in units of viscosity * length * radius^3 / c_p^2.
"""

from __future__ import annotations

from functools import lru_cache

from ..films.cavitation import Complementarity
from ..films.geometry import FilmGeometry, Pad
from ..films.ring.ring_grids import LONG, ring_grids, ring_spans
from ..films.ring.ring_kernel import RingKernel

CELLS = (96, 8)
"""Cells along a pad and along half its length."""


@lru_cache(maxsize=64)
def pad_grid(
    extent: float, slenderness: float, cells: tuple[int, int] = CELLS, *, extrapolated: bool = True
) -> RingKernel:
    """Return the film on one pad in its own frame, ruptured where it would be in tension.

    Parameters
    ----------
    extent : float [rad]
        Angle that the pad covers, below 2 pi.
    slenderness : float [1]
        Length / diameter.
    cells : (int, int)
        Cells along the pad and along half its length: multiples of 4, at least 16 and 4.
    extrapolated : bool
        Whether the force is that extrapolated from these cells and half as many.
    """
    geometry = FilmGeometry(pads=(Pad(start=-0.5 * extent, extent=extent),))
    grids = ring_grids(geometry, *cells, max(slenderness, LONG))
    return RingKernel(
        slenderness, ring_spans(geometry), grids, Complementarity(), extrapolated=extrapolated, pad=True
    )
