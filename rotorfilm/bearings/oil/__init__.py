"""Lubricants whose properties depend on their temperature."""

from .cooling import Cooling
from .oil import GRADES, Oil
from .viscosity import Exponential, ViscosityLaw, Vogel, Walther

__all__ = ["GRADES", "Cooling", "Exponential", "Oil", "ViscosityLaw", "Vogel", "Walther"]
