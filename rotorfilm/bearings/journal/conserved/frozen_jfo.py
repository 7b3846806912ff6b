"""The film that conserves its oil with a given viscosity field: `JFOFilm` at frozen temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NoReturn

from ....errors import InputError
from ...films.conserved.conserved_film import ConservedFilm
from ...films.conserved.fluidity import Fluidity
from .jfo_film import JFOFilm


@dataclass(frozen=True, kw_only=True, eq=False)
class FrozenJFOFilm(JFOFilm):
    """A `JFOFilm` whose cells keep their viscosity: at rest, in vibration, and its losses.

    `start`, `step` and `native`, and so `simulate` and `export_fmu`, refuse it: they know one viscosity.

    Parameters
    ----------
    fluidity : Fluidity
        Of the oil in each cell, over that of the bearing.
    """

    fluidity: Fluidity

    @cached_property
    def film(self) -> ConservedFilm:
        """The film without dimensions; see `ConservedFilm`."""
        return replace(super().film, fluidity=self.fluidity)

    def at_temperature(self, temperature: float) -> NoReturn:
        """Raise InputError: the temperature of each cell is given already."""
        raise InputError(
            f"temperature must not be set on a film of frozen temperature, got {temperature!r}: "
            "take that of the JFOFilm"
        )
