"""Bearings of pads, each with its own center of curvature."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .dam import *
else:
    show(__name__)
