"""A viscous sleeve: a full film around a shaft that stays near the center."""

from .sleeve_rungs import LADDERS
from .sleeve_table import SleeveTable, sleeve_models

__all__ = ["LADDERS", "SleeveTable", "sleeve_models"]
