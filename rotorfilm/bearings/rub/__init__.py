"""A shaft that rubs against a ring."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .rub_ring import RubContact as RubContact, RubRing as RubRing
else:
    show(__name__)
