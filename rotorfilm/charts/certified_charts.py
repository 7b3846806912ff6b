"""Charts that rotors are certified with, as API 617 wants them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import control
import numpy as np
from matplotlib.axes import Axes

from ..linear import SeparationMargins, ShaftStatics, StabilityLevelOne
from ..linear.certified.screening import BORDER_DENSITY, BORDER_RATIO, LEAST_DECREMENT
from .canvas import new_axes, new_figure
from .rotor_charts import RPM

MEGANEWTON = 1e6


def plot_stability_level_one(
    result: StabilityLevelOne, *, axes: Sequence[Axes] | None = None
) -> tuple[Axes, Axes]:
    """Draw the log decrement over the applied cross-coupling [MN/m], and where the machine is screened.

    Parameters
    ----------
    result : StabilityLevelOne
    axes : two Axes, optional
        For curves and screening; a new figure by default.

    Returns
    -------
    (Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(9.6, 4.4)).subplots(1, 2)
    beside, screening = axes
    for curve in result.curves:
        applied = curve.cross_coupling / MEGANEWTON
        beside.plot(applied, curve.log_decrement, "o-", markersize=3, label=curve.name)
    expected = result.anticipated_cross_coupling / MEGANEWTON
    beside.axvline(expected, color="k", linestyle=":", label="QA")
    beside.plot([expected], [result.anticipated_decrement], "ks", fillstyle="none", label="delta_A")
    if math.isfinite(result.zero_cross_coupling):
        beside.plot([result.zero_cross_coupling / MEGANEWTON], [0.0], "k^", fillstyle="none", label="Q0")
    beside.axhline(LEAST_DECREMENT, color="k", linestyle="--", linewidth=0.8, label=f"{LEAST_DECREMENT:g}")
    beside.axhline(0.0, color="k", linewidth=0.8)
    needed = "required" if result.level_two_required else "not required"
    beside.set(xlabel="applied cross-coupling [MN/m]", ylabel="log decrement", title=f"Level II is {needed}")
    _screening(result, screening)
    for part in (beside, screening):
        part.grid(visible=True, alpha=0.3)
        part.legend(fontsize=8)
    return beside, screening


def _screening(result: StabilityLevelOne, axes: Axes) -> None:
    """Draw critical speed ratio over density, with the border between regions A and B."""
    density = 0.0 if result.average_density is None else result.average_density
    least, most = BORDER_DENSITY
    right = max(1.2 * most, 1.2 * density)
    border = np.array([0.0, least, most, most]), np.array([*BORDER_RATIO[:1], *BORDER_RATIO, 0.0])
    axes.plot(*border, "k-", linewidth=1.0, label="border of regions A and B")
    low = result.critical_speed_ratio < 1.0 and density < least
    axes.text(0.4 * least, 1.5 if low else 0.5, "A")
    axes.text(1.05 * most, 0.5, "B")
    if result.average_density is not None:
        axes.plot([density], [result.critical_speed_ratio], "ks", label="this machine")
    top = max(3.5, 1.2 * result.critical_speed_ratio)
    axes.set(
        xlabel="average gas density [kg/m3]",
        ylabel="critical speed ratio",
        xlim=(0.0, right),
        ylim=(0.0, top),
        title=f"Q0/QA = {result.margin:.3g}",
    )


def plot_separation_margins(result: SeparationMargins, *, axes: Axes | None = None) -> Axes:
    """Draw the amplitudes [um] over speed [rpm], peaks with their AF, red where it is too near.

    Parameters
    ----------
    result : SeparationMargins
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Separation margins")
    for name, amplitude in result.amplitudes.items():
        axes.semilogy(result.speeds / RPM, 1e6 * amplitude, label=name)
    axes.axvspan(
        result.minimum_speed / RPM, result.maximum_speed / RPM, color="0.85", label="operating range"
    )
    for peak in result.peaks:
        mark = "kv" if peak.acceptable else "rv"
        axes.plot([peak.speed / RPM], [1e6 * peak.peak_amplitude], mark, fillstyle="none")
        axes.annotate(f"AF {peak.amplification_factor:.3g}", (peak.speed / RPM, 1e6 * peak.peak_amplitude))
    axes.set(
        xlabel="speed [rpm]",
        ylabel="amplitude [um]",
        title="Separation margins are kept" if result.acceptable else "Separation margins are not kept",
    )
    axes.legend(fontsize=8)
    return axes


def plot_shaft_statics(
    result: ShaftStatics, *, axes: Sequence[Axes] | None = None
) -> tuple[Axes, Axes, Axes]:
    """Draw sag [um], shear force [N] and bending moment [N m] along a shaft [m], in both planes.

    Parameters
    ----------
    result : ShaftStatics
    axes : three Axes, optional
        A new figure by default.

    Returns
    -------
    (Axes, Axes, Axes)
    """
    if axes is None:
        axes = new_figure(size=(7.4, 7.4)).subplots(3, 1, sharex=True)
    above, middle, below = axes
    for k, name in enumerate("xy"):
        above.plot(result.positions, 1e6 * result.sag[k], "o-", markersize=3, label=name)
        middle.plot(result.places, result.shear_force[k], label=name)
        below.plot(result.places, result.bending_moment[k], label=name)
    above.set(ylabel="sag [um]", title="Under its weight")
    middle.set(ylabel="shear force [N]")
    below.set(ylabel="bending moment [N m]", xlabel="along the shaft [m]")
    for part in (above, middle, below):
        part.grid(visible=True, alpha=0.3)
        part.legend(fontsize=8)
    return above, middle, below


def plot_polar_response(
    response: control.FrequencyResponseData, outputs: Sequence[str], *, axes: Axes | None = None
) -> Axes:
    """Draw phasors [um] of a response over speed in the complex plane, with some speeds [rpm] beside them.

    Parameters
    ----------
    response : control.FrequencyResponseData
        As `unbalance_response` or `tracked_response` returns it.
    outputs : sequence of str
        Names of displacements.
    axes : Axes, optional
        Where to draw; a new figure by default.
    """
    axes = axes or new_axes("Polar plot")
    speeds = np.asarray(response.frequency) / RPM
    for name in outputs:
        phasor = 1e6 * np.asarray(response.frdata)[list(response.output_labels).index(name), 0]
        axes.plot(phasor.real, phasor.imag, label=name)
        size = np.abs(phasor)
        for k in {0, int(np.argmax(size)), len(speeds) - 1}:
            axes.annotate(f"{speeds[k]:.0f} rpm", (phasor[k].real, phasor[k].imag), fontsize=8)
    axes.set(xlabel="real [um]", ylabel="imaginary [um]", aspect="equal", adjustable="datalim")
    axes.legend(fontsize=8)
    return axes
