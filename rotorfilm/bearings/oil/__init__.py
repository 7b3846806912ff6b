"""Lubricants whose properties depend on their temperature."""

from .oil import GRADES, Cooling, Exponential, Oil, ViscosityLaw, Vogel, Walther

__all__ = ["GRADES", "Cooling", "Exponential", "Oil", "ViscosityLaw", "Vogel", "Walther"]
