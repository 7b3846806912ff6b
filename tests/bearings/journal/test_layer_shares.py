"""Flow and heat of layers between two walls against Dowson's integrals."""

import numpy as np
import pytest

from rotorfilm.bearings.films.finite_volumes import thickness
from rotorfilm.bearings.journal import HeatedFilm, JournalBearing, LayeredTemperature
from rotorfilm.bearings.journal.energy_equation import Heating, layer_heat, layer_shares
from rotorfilm.bearings.journal.film_flow import fed_film
from rotorfilm.bearings.oil import Cooling, Oil

LAYERS, FINE = 5, 4000


def layered(values):
    """Return the sums over each layer of a function at the middles of a fine division of the gap."""
    return values.reshape(LAYERS, FINE).sum(axis=1) / (LAYERS * FINE)


@pytest.mark.closed_form
def test_shares_are_integrals_over_the_gap():
    f = np.array([1.0, 1.7, 0.8, 2.5, 3.0])
    shares = layer_shares(f[None, None])
    eta = (np.arange(LAYERS * FINE) + 0.5) / (LAYERS * FINE)
    fine = np.repeat(f, FINE)
    F0, y = fine.mean(), (fine * eta).mean() / fine.mean()
    F2 = (fine * eta * (eta - y)).mean()
    step = 1.0 / (LAYERS * FINE)
    dragged = (np.cumsum(fine) - 0.5 * fine) * step / F0
    moment = fine * (eta - y)
    pressed = -(np.cumsum(moment) - 0.5 * moment) * step
    found = [shares.F0, shares.F2, shares.dragged, shares.pressed]
    wanted = [F0, F2, layered(dragged), layered(pressed)]
    for own, exact in zip(found, wanted, strict=True):
        np.testing.assert_allclose(np.squeeze(own), exact, rtol=1e-6)
    assert shares.dragged.sum() == pytest.approx(1.0 - y, rel=1e-7)
    assert shares.pressed.sum() == pytest.approx(F2, rel=1e-7)
    pull, slope = 0.7, -2.0
    heat = layered((slope * (eta - y) + pull / F0) ** 2 * fine)
    own = (
        pull**2 / F0 * shares.sheared + slope**2 * F2 * shares.squeezed + 2.0 * pull * slope * shares.crossed
    )
    np.testing.assert_allclose(own.ravel(), heat, rtol=1e-6)


def test_layers_make_the_heat_of_their_velocity():
    """(h p_x (eta - 1/2) + U/h)^2/mu + (h p_z (eta - 1/2))^2/mu in cells that the film fills."""
    speed, e = 300.0, np.array([0.1, -0.5])
    cooling = Cooling(supply_temperature=318.15)
    bearing = JournalBearing(
        radius=0.05, length=0.05, clearance=75e-6, oil=Oil.constant(0.03), cooling=cooling
    )
    film = HeatedFilm(bearing=bearing, cells=(160, 16), profile=LayeredTemperature(LAYERS)).cold()
    film, found, flow = fed_film(film, e * bearing.clearance, speed, full_gap=False)
    cells = film.cells
    shape = (*cells.shape, LAYERS)
    heating = Heating(
        opening=np.full(cells.shape, -1),
        flow=flow,
        speed=speed,
        viscosity=np.ones(shape),
        thinning=np.zeros(shape),
        temperature=np.zeros(shape),
        capacity=1.0,
        friction=1.0,
        conductance=0.0,
        carry_over=0.8,
        walls=None,
    )
    heat = layer_heat(heating, layer_shares(np.ones(shape)))
    P, H = found.pressure, thickness(e, cells.theta)
    around = (np.roll(P, -1, axis=0) - np.roll(P, 1, axis=0)) / (cells.gap + np.roll(cells.gap, 1))[:, None]
    nodes = np.append(0.0, np.cumsum(1.0 / cells.conductance))[: P.shape[1]]
    along = np.gradient(P, nodes, axis=1) / cells.slenderness
    low, high = np.arange(LAYERS) / LAYERS - 0.5, np.arange(1, LAYERS + 1) / LAYERS - 0.5
    square = (high**3 - low**3) / 3.0
    H, width = H[:, None, None], (cells.extent[:, None] * cells.width[:-1])[..., None]
    cubed = 144.0 * H**3 * (around**2 + along**2)[..., None] * square
    both = 12.0 * speed * H * around[..., None] * (high**2 - low**2)
    exact = width * (cubed + both + speed**2 / H / LAYERS)
    inside = found.full & np.roll(found.full, 1, 0) & np.roll(found.full, -1, 0)
    inside[:, [0, -2, -1]] = False
    assert inside.sum() > 500
    scale = exact[inside].mean(axis=1, keepdims=True)
    np.testing.assert_allclose(heat[:, :-1][inside] / scale, exact[inside] / scale, atol=0.05)
    assert (np.abs(both[inside] * width[inside]) / scale).max() > 0.3
