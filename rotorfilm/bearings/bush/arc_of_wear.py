"""How wide an arc of nodes a wearing contact fills."""

from __future__ import annotations

from ...errors import ConvergenceError
from .moments import Stage, Wearing, wear_by_one_moment
from .wear_at_nodes import wear_at_nodes
from .worn_profile import MeltingRule

WIDEST_ARC = 1.5
"""Half the widest arc of nodes [rad]."""

MARGIN, WIDER = 1.08, 1.25
"""Arc of nodes over the widest contact found by few of them; by how much it is widened where that fails."""


def arc_of_wear(bush: Wearing, rule: MeltingRule, stages: tuple[Stage, ...], count: int) -> tuple[float, int]:
    """Return half the arc of nodes [rad] that the contact fills at the end, and the profiles it took.

    Parameters
    ----------
    bush : Wearing
    rule : MeltingRule
    stages : tuple of Stage
    count : int
        Nodes to one side of the load line by which it is found; few are enough.

    Raises
    ------
    ConvergenceError
        If the contact is wider than `WIDEST_ARC`.
    """
    path = wear_by_one_moment(bush, stages)
    reach = min(1.2 * float(bush.angle(path.moment, path.load_ratio).max()), WIDEST_ARC)
    calls = path.calls
    while True:
        try:
            first = wear_at_nodes(bush, rule, stages, count, reach)
        except ConvergenceError:
            if reach >= WIDEST_ARC:
                raise
            reach = min(WIDER * reach, WIDEST_ARC)
            continue
        calls += first.calls
        fits = MARGIN * first.angle
        if fits > 0.7 * reach:
            return min(fits, WIDEST_ARC), calls
        reach = 0.5 * (fits + reach)
