"""Questions to a tolerance: the cheapest model that is good enough answers."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .registry import ask as ask, ladder_of as ladder_of
else:
    show(__name__)
