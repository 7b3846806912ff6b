"""Lubricants whose properties depend on their temperature."""

from .oil import GRADES, Oil
from .viscosity import Exponential, ViscosityLaw, Vogel, Walther

__all__ = ["GRADES", "Exponential", "Oil", "ViscosityLaw", "Vogel", "Walther"]
