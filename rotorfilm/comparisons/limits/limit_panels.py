"""The atlas of limits: where each simplification fails, as curves and the level that counts as failed.

Each physics has a file of its own with its panels, `limits_journal.py`, `limits_supply.py`,
`limits_heat.py`, `limits_rotor.py` (steps in time), `limits_damper.py`, `limits_contact.py` and
`limits_bush.py`; `limits_atlas.py` puts them together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ...model import Array

FAILED = 0.1
"""Relative error at which a simplification counts as failed."""


@dataclass(frozen=True, kw_only=True)
class Limit:
    """One curve of the atlas.

    Attributes
    ----------
    panel : str
        The simplification.
    name : str
        Which of them.
    abscissa, ordinate : ndarray, shape (n,)
        What it depends on, and the error or limit there; not-a-number where it has none.
    """

    panel: str
    name: str
    abscissa: Array
    ordinate: Array


@dataclass(frozen=True, kw_only=True)
class Panel:
    """How one panel is read.

    Attributes
    ----------
    physics : str
        Which bearing it is about.
    title : str
    x_label, y_label : str
        Labels of its axes.
    logarithmic : bool
        Whether the abscissa is drawn so.
    level : float or None
        Error from which a curve counts as failed; None where the ordinate itself is the limit.
    """

    physics: str
    title: str
    x_label: str
    y_label: str
    level: float | None = FAILED
    logarithmic: bool = False


Curve = tuple[str, ArrayLike, ArrayLike]
"""Name, abscissa and ordinate of one curve."""


@dataclass(frozen=True, kw_only=True)
class PanelCurves:
    """A panel, its name in the atlas, and what computes its curves.

    Attributes
    ----------
    key : str
    panel : Panel
    curves : callable
        Yields name, abscissa and ordinate of each curve.
    """

    key: str
    panel: Panel
    curves: Callable[[], Iterator[Curve]]

    def limits(self) -> list[Limit]:
        """Return the curves."""
        return [
            Limit(panel=self.key, name=name, abscissa=np.asarray(x), ordinate=np.asarray(y))
            for name, x, y in self.curves()
        ]


def panel(
    physics: str, title: str, x_label: str, y_label: str, **reading: Any
) -> Callable[[Callable[[], Iterator[Curve]]], PanelCurves]:
    """Make a panel of the function below, whose name is its name in the atlas; arguments as of `Panel`."""
    found = Panel(physics=physics, title=title, x_label=x_label, y_label=y_label, **reading)
    return lambda curves: PanelCurves(key=curves.__name__, panel=found, curves=curves)


@dataclass(frozen=True, kw_only=True)
class LimitAtlas:
    """All curves of the atlas.

    Attributes
    ----------
    panels : dict of str to Panel
        How each is read, by its name.
    limits : tuple of Limit
        The curves.
    """

    panels: dict[str, Panel] = field(default_factory=dict)
    limits: tuple[Limit, ...]

    def columns(self) -> dict[str, list[object]]:
        """Return the columns of the table, a row for each point of each curve."""
        rows = [
            (panel.physics, panel.title, one.name, panel.x_label, float(x), panel.y_label, float(y))
            for one in self.limits
            for panel in (self.panels[one.panel],)
            for x, y in zip(one.abscissa, one.ordinate, strict=True)
        ]
        headings = ("physics", "simplification", "variant", "abscissa", "at", "ordinate", "error or limit")
        return {heading: [row[k] for row in rows] for k, heading in enumerate(headings)}


def failure(limit: Limit, level: float) -> float | None:
    """Return where a curve first passes a level, on a straight line of the logarithms; None if nowhere."""
    above = np.flatnonzero(limit.ordinate >= level)
    if not above.size:
        return None
    k = int(above[0])
    if k == 0:
        return float(limit.abscissa[0])
    x, y = limit.abscissa[k - 1 : k + 1], np.log(limit.ordinate[k - 1 : k + 1])
    return float(np.interp(np.log(level), y, x))


class Failure(NamedTuple):
    """Where one curve fails; `at` is None where it does not.

    Attributes
    ----------
    panel : Panel
    name : str
        Which curve.
    at : float or None
        Abscissa of the panel from which it fails.
    """

    panel: Panel
    name: str
    at: float | None


def failures(atlas: LimitAtlas) -> Sequence[Failure]:
    """Return panel, curve and where it fails, of all curves with a level."""
    return [
        Failure(panel, one.name, failure(one, panel.level))
        for one in atlas.limits
        if (panel := atlas.panels[one.panel]).level is not None
    ]
