"""Annular seals: the stiffness, damping and added mass of leakage through a plain gap."""

from typing import TYPE_CHECKING

from ...sources import show

if TYPE_CHECKING:
    from .annular_seal import AnnularSeal as AnnularSeal
    from .seal_flow import HirsFriction as HirsFriction, SealFlow as SealFlow
else:
    show(__name__)
