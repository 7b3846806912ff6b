"""Nodes of the impedance map, and the potentials on them.

The axes are uniform: X = chi/(1 - chi^2)^(1/4) from 0, T = (1 + g_c/|g|)/2 from 0 to 1, and ln(L/D). With
L0 = L(chi = 0), the same for every T, the map interpolates M = (L - L0)/chi, whose limit at chi = 0 is
dL/dchi.
"""

from __future__ import annotations

import io
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ....errors import InputError
from ....files import write_whole
from ....model import Array
from .potential import potential

FIELDS = ("log", "error", "chi_slope", "force_t", "force_r")
"""Arrays of a table, each of shape (K, I, J) over (ln(L/D), X, T)."""


class TableAxes(NamedTuple):
    """Uniform axes of the map.

    Attributes
    ----------
    X, T, log_slenderness : ndarray, shape (I,), (J,), (K,)
    """

    X: Array
    T: Array
    log_slenderness: Array

    @property
    def chi(self) -> Array:
        """Eccentricity ratios of the X nodes, shape (I,)."""
        return eccentricity_ratio(self.X)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape (K, I, J) of a field."""
        return self.log_slenderness.size, self.X.size, self.T.size


def stretched_eccentricity(chi: Array) -> Array:
    """Return X = chi/(1 - chi^2)^(1/4)."""
    return chi / ((1.0 - chi) * (1.0 + chi)) ** 0.25


def eccentricity_ratio(X: Array) -> Array:
    """Return chi(X) = X sqrt(s), where s = sqrt(1 - chi^2) solves s^2 + X^2 s = 1."""
    X2 = X**2
    s = 2.0 / (X2 + np.sqrt(X2**2 + 4.0))
    return np.asarray(X * np.sqrt(s))


def universal_axes(
    cells: tuple[int, int, int] = (24, 96, 16),
    top: float = 4.8,
    slenderness: tuple[float, float] = (0.1, 4.0),
) -> TableAxes:
    """Return axes with so many cells in (X, T, ln(L/D)), X up to `top` (4.8 is chi = 0.99906)."""
    low, high = np.log(slenderness)
    return TableAxes(
        np.linspace(0.0, top, cells[0] + 1),
        np.linspace(0.0, 1.0, cells[1] + 1),
        np.linspace(low, high, cells[2] + 1),
    )


def table_row(chi: float, slenderness: float, turns: Array) -> Array:
    """Return FIELDS at one chi and L/D for all T, shape (5, J)."""
    points = [potential(chi, float(T), slenderness) for T in turns]
    return np.array([(p.log, p.error, p.chi_slope, *p.force) for p in points]).T


def modulation(axes: TableAxes, log: Array, chi_slope: Array) -> tuple[Array, Array]:
    """Return L0, shape (K,), and M, shape (K, I, J), of L = L0 + chi M.

    Parameters
    ----------
    axes : TableAxes
    log, chi_slope : ndarray, shape (K, I, J)
        L and dL/dchi, the latter for the limit at chi = 0.
    """
    center = log[:, 0].mean(axis=-1)
    M = chi_slope.copy()
    M[:, 1:] = (log[:, 1:] - center[:, None, None]) / axes.chi[1:, None]
    return center, M


def load_table(path: Path) -> tuple[TableAxes, dict[str, Array]]:
    """Return the axes and the fields of a table written by `save_table`.

    Raises
    ------
    InputError
        If an array is missing.
    """
    with np.load(path) as data:
        missing = {"X", "T", "log_slenderness", *FIELDS} - set(data.files)
        if missing:
            raise InputError(f"table {path} must hold {sorted(missing)}, got {sorted(data.files)}")
        axes = TableAxes(data["X"], data["T"], data["log_slenderness"])
        return axes, {name: data[name] for name in FIELDS}


def save_table(path: Path, axes: TableAxes, fields: dict[str, Array]) -> None:
    """Write axes and fields as plain arrays; a failure leaves the earlier file."""
    content = io.BytesIO()
    log, error, chi_slope, force_t, force_r = (fields[name] for name in FIELDS)
    np.savez_compressed(
        content,
        X=axes.X,
        T=axes.T,
        log_slenderness=axes.log_slenderness,
        log=log,
        error=error,
        chi_slope=chi_slope,
        force_t=force_t,
        force_r=force_r,
    )
    write_whole(path, content.getvalue())
