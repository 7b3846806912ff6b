"""Reynolds' rupture on the cells of a film that conserves its oil: what the mass is worth, on equal terms."""

from __future__ import annotations

import numpy as np

from ....model import Array
from .conserved_film import ConservedFilm, ConservedState, Gap, Storage


def reynolds_state(film: ConservedFilm, gap: Gap, gap_rate: Array) -> ConservedState:
    """Return the film with Reynolds' rupture in a gap that changes by `gap_rate`, shape (N,) [1/s].

    It is what a film that was full until now makes of its next moment, however short that is: the pressure
    does not depend on its length, and theta says nothing.
    """
    moment = float(np.max(np.abs(gap_rate) / gap.line)) or 1.0
    held = np.repeat((moment * gap.line - gap_rate)[:, None], film.cells.width.size, axis=1)
    return film.solve(gap, 0.0, storage=Storage(moment, held))
