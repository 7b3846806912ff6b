"""The table of one bearing with a film, of whatever family, on which the rotor of a scene rests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, Self, runtime_checkable

from ..errors import InputError
from ..progress import Report
from ..readable.result import Readable
from .excitation_table import kind_of
from .families import family_of
from .lubricant_table import Lubricant, LubricantTable


@runtime_checkable
class FilmTable(Protocol):
    """What the table of one bearing with a film has besides its keys: a rotor may rest on it."""

    @property
    def viscosity(self) -> float | None:
        """That the file gives [Pa s]; None where `[lubricant]` does."""

    @property
    def film_is_given(self) -> bool:
        """Whether the file names the film, so that no other may answer."""

    def on(self, where: str, lubricant: LubricantTable) -> Self:
        """Return this table with the oil of the scene, unless it has its own viscosity.

        Parameters
        ----------
        where : str
            Its name in the file, for messages.
        lubricant : LubricantTable
        """

    def build(self) -> Any:
        """Return the bearing, a Reaction or a film at rest; InputError where a value breaks its rule."""

    def echo(self, bearing: Any) -> tuple[Readable, str]:
        """Return what an answer repeats of the bearing that was built, and the name of its film."""

    def remarks(
        self, bearing: Any, oil: Lubricant, speed: float, load: tuple[float, float]
    ) -> tuple[str, ...]:
        """Return what its physics leaves out and should not, at a speed [rad/s] and a load [N]."""

    def make_map(self, report: Report) -> None:
        """Make the map that the bearing needs, unless it lies on disk."""


def film_tables(tables: Mapping[str, Any]) -> dict[str, FilmTable]:
    """Return those of the tables of a scene, by their names in the file, that are of bearings with a film.

    Raises
    ------
    InputError
        If there are several.
    """
    found = {name: table for name, table in tables.items() if isinstance(table, FilmTable)}
    if len(found) > 1:
        raise InputError(f"{' and '.join(found)} must not stand in one scene: which does the rotor rest on?")
    return found


def film_table(tables: Mapping[str, Any], excitation: object = None) -> FilmTable:
    """Return the table of the bearing with a film among those of a scene; raise InputError without one.

    The message has the commands for what there is, and for what shakes it.
    """
    found = next(iter(film_tables(tables).values()), None)
    if found is None:
        given = {f"[{name}]": family_of(name).command for name, table in tables.items() if table is not None}
        if getattr(tables.get("shaft"), "compressor", None) is not None:
            given["[shaft.compressor]"] = "rotorfilm stability-level-one"
        if (kind := kind_of(excitation)) in ("motor", "ground"):
            given[f"excitation.kind {kind}"] = "rotorfilm rotor-run"
        hints = "".join(f"; `{command}` is for {what}" for what, command in given.items() if command)
        raise InputError(f"journal is required for a film, got no such table{hints}")
    return found


def oil_remarks(tables: Mapping[str, Any], lubricant: LubricantTable) -> tuple[str, ...]:
    """Return that bearings have a viscosity of their own although `[lubricant]` has one, one line each."""
    if not lubricant.has_viscosity:
        return ()
    journals: dict[str, Any] = dict(film_tables(tables))
    shaft = tables.get("shaft")
    for k, one in enumerate(shaft.bearings if shaft is not None else ()):
        if one.journal is not None:
            journals[f"shaft.bearings[{k}].journal"] = one.journal
    return tuple(
        f"oil: {name} runs on its own viscosity of {one.viscosity:g} Pa s at all temperatures and not on "
        f"the oil of [lubricant]; without {name}.viscosity it would"
        for name, one in journals.items()
        if one.viscosity is not None
    )
