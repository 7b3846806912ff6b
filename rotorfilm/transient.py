"""Motion over time; it lives in `motion`."""

from .motion import *  # noqa: F403  (another roof over the same names)
