"""Bearings of tilting pads in units of their film, and a smooth film with exact derivatives."""

import math
from dataclasses import dataclass

import pytest

from rotorfilm import TiltingPadBearing, even_pivots
from rotorfilm.bearings import PadGridFilm
from rotorfilm.native import ShortKernel

DEGREE = math.pi / 180.0


@dataclass(frozen=True)
class RingFilm:
    """The short film of a whole ring for a pad: smooth, in closed form, for |e| < 1 only."""

    def kernel(self, extent, slenderness):
        return ShortKernel(slenderness)


@pytest.fixture(scope="session")
def tilting():
    """Return a bearing of pads; c = 100 um, R = 50 mm, unless said otherwise."""

    def make(pads, slenderness, extent, preload, offset=0.5, *, cells=(48, 4), first=None, **further):
        angles = (
            even_pivots(pads)
            if first is None
            else tuple((first + k * 360.0 / pads) * DEGREE for k in range(pads))
        )
        given = {
            "viscosity": 0.02,
            "pad_clearance": 1e-4,
            "film": PadGridFilm(cells=cells),
            "pivots": angles,
        } | further
        return TiltingPadBearing(
            radius=0.05,
            length=0.1 * slenderness,
            extent=extent * DEGREE,
            preload=preload,
            pivot_offset=offset,
            **given,
        )

    return make


@pytest.fixture(scope="session")
def smooth(tilting):
    """Return a bearing of three preloaded pads under the smooth film."""

    def make(**further):
        return tilting(3, 0.5, 119.0, 0.7, film=RingFilm(), **further)

    return make
