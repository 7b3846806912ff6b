"""How oil between two walls flows and is sheared, its viscosity varying across the gap (Dowson, 1962)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .....model import Array


class LayerShares(NamedTuple):
    """Integrals over layers of equal share of the gap, of oil of fluidity f across it, eta = 0 at the bush.

    With F_0 = int f, F_1 = int f eta, y = F_1/F_0 and F_2 = int f eta (eta - y), and u = U int_0^eta f/F_0 +
    h^2 p_x int_0^eta f (eta' - y).

    Attributes
    ----------
    F0, F2 : ndarray, shape (N, M + 1)
    dragged : ndarray, shape (N, M + 1, K)
        Flow of each layer over U h where the journal drags; its sum is 1 - y.
    pressed : ndarray, shape (N, M + 1, K)
        Flow of each layer over -h^3 p_x; its sum is F_2.
    sheared : ndarray, shape (N, M + 1, K)
        Share of the heat of the drag; its sum is 1.
    squeezed : ndarray, shape (N, M + 1, K)
        Share of the heat of the pressure; its sum is 1.
    crossed : ndarray, shape (N, M + 1, K)
        Share of U h p_x of half the heat of both together; its sum is 0.
    """

    F0: Array
    F2: Array
    dragged: Array
    pressed: Array
    sheared: Array
    squeezed: Array
    crossed: Array


def layer_shares(fluidity: Array) -> LayerShares:
    """Return the shares of layers of a fluidity 1/viscosity (N, M + 1, K) [any unit]."""
    count = fluidity.shape[-1]
    edges = np.linspace(0.0, 1.0, count + 1)
    low, high, d = edges[:-1], edges[1:], 1.0 / count
    middle = 0.5 * (low + high)
    F0, F1 = (fluidity * d).sum(axis=-1), (fluidity * middle * d).sum(axis=-1)
    y = (F1 / F0)[..., None]
    by_pressure = fluidity * (high**3 - low**3 - 1.5 * y * (high**2 - low**2)) / 3.0
    square = fluidity * ((high - y) ** 3 - (low - y) ** 3) / 3.0
    F2 = by_pressure.sum(axis=-1)
    below = _before(fluidity * d)
    moment = _before(fluidity * (middle - y) * d)
    inside = fluidity * ((high**3 - low**3) / 6.0 - 0.5 * low**2 * d - 0.5 * y * d**2)
    return LayerShares(
        F0=F0,
        F2=F2,
        dragged=d * (below + 0.5 * d * fluidity) / F0[..., None],
        pressed=-(d * moment + inside),
        sheared=d * fluidity / F0[..., None],
        squeezed=square / F2[..., None],
        crossed=d * fluidity * (middle - y) / F0[..., None],
    )


def _before(layers: Array) -> Array:
    """Return the sum of all layers before each."""
    return np.cumsum(layers, axis=-1) - layers
