"""Questions to a tolerance: the cheapest model that is good enough answers."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from .quantities import QUANTITIES
    from .walk import ask as ask, ladder_of as ladder_of, ladders_of
else:
    show(__name__)
