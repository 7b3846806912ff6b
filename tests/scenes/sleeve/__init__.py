"""A viscous sleeve: a full film around a shaft that stays near the center."""

from .bearing import ViscousSleeve as ViscousSleeve
