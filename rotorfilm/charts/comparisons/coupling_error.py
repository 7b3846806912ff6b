"""Chart of the error of a coupled run over its macro step."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..canvas import new_axes


def plot_coupling_error(
    macro_angles: np.ndarray,
    errors: np.ndarray,
    refused: np.ndarray,
    *,
    limit: float | None = None,
    axes: Axes | None = None,
) -> Axes:
    """Draw the error of the coupled run against the monolithic one over the macro step.

    Parameters
    ----------
    macro_angles : ndarray, shape (n,) [rad]
        Shaft rotation between two exchanges.
    errors : ndarray, shape (n,) [1]
        Largest distance of the orbits / clearance.
    refused : ndarray of bool, shape (n,)
        Runs that are no answer; drawn as crosses.
    limit : float, optional [rad]
        Explicit stability limit of the coupling.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Co-simulation error against macro step")
    degrees, good = np.degrees(macro_angles), ~np.asarray(refused)
    axes.loglog(degrees[good], errors[good], "o-", label="Gauss-Seidel, force held")
    axes.loglog(degrees[~good], errors[~good], "x", color="C3", label="refused")
    if np.any(good):
        axes.loglog(degrees, errors[good][0] * degrees / degrees[good][0], "k:", label="first order")
    if limit is not None:
        axes.axvline(np.degrees(limit), color="C3", linewidth=1.0, label="explicit stability limit")
    axes.set_xticks(degrees, [f"{angle:.3g}" for angle in degrees])
    axes.minorticks_off()
    axes.set(xlabel="macro step [deg of shaft rotation]", ylabel="largest orbit error / clearance")
    axes.legend(fontsize=8)
    return axes
