"""Circular orbits; they live in `motion`."""

from typing import TYPE_CHECKING

from .sources import show

if TYPE_CHECKING:
    from .motion import *
else:
    show(__name__)
