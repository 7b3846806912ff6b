"""What flows into a film that conserves its oil, and out of it."""

from __future__ import annotations

from typing import NamedTuple

from ....model import Array


class OilFlows(NamedTuple):
    """Flows of a film over clearance, radius and length.

    Attributes
    ----------
    out, drawn_in : float [1/s]
        Through both ends, of lines where it leaves and of those where it enters.
    inflow : ndarray, shape (openings,) [1/s]
        From each opening, last that from a groove all round.
    defect : float [1/s]
        Oil that the cells of the film make or lose, all taken as positive.
    """

    out: float
    drawn_in: float
    inflow: Array
    defect: float
