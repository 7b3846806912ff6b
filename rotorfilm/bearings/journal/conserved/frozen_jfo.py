"""The film that conserves its oil with a given viscosity field: all of `JFOFilm` at frozen temperature."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from ...films.conserved.conserved_film import ConservedFilm
from ...films.conserved.fluidity import Fluidity
from .jfo_film import JFOFilm


@dataclass(frozen=True, kw_only=True, eq=False)
class FrozenJFOFilm(JFOFilm):
    """A `JFOFilm` whose cells keep their viscosity.

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
