"""Kernels with a mobility among their tables answer as the library does, and refuse tables that are none."""

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave

import rotorfilm as rf
from rotorfilm.bearings import Mobility, mobility_of

SIZE = {"radius": 0.05, "length": 0.06, "viscosity": 0.02}
INPUTS, OUTPUTS = ("x", "y", "vx", "vy", "speed"), ("force_x", "force_y")
TOY = mobility_of(lambda X: (1.0 / (1.0 + X), 1.0 / (1.0 + 0.5 * X), 1.0 + 0.1 * X, 1.0 + X), cells=24)
MOVING = Mobility(
    coefficients=TOY.coefficients, scale=30.0 * TOY.scale, last_node=TOY.last_node, density=2000.0
)


def bearing(name, mobility):
    """Return a journal, with grooves or without, or a pressure dam."""
    if name == "dam":
        pads = rf.pressure_dam_pads(depth=5e-5, end=2.2, share=0.6)
        return rf.PressureDamBearing(**SIZE, pad_clearance=1e-4, pads=pads, cells=(16, 8), mobility=mobility)
    grooves = (rf.Groove(center=0.4, width=0.3),) if name == "grooved" else ()
    film = rf.ReynoldsFilm(cells=(32, 8), mobility=mobility)
    return rf.JournalBearing(**SIZE, clearance=1e-4, film=film, grooves=grooves)


@pytest.mark.parametrize("mobility", [TOY, MOVING], ids=["fixed", "moving"])
@pytest.mark.parametrize("name", ["plain", "grooved", "dam"])
def test_an_fmu_of_a_film_on_a_grid_carries_its_mobility(unzipped, name, mobility):
    model = bearing(name, mobility)
    client = unzipped(model).open(FMU2Slave).start()
    state = np.array([2e-5, -3e-5, 1e-3, 2e-3, 200.0])
    client.set(**dict(zip(INPUTS, state, strict=True)))
    wanted = model.force(state[:2], state[2:4], state[4])
    np.testing.assert_allclose(client.get(*OUTPUTS), wanted, rtol=1e-14)
    by = model.jacobian(state[:2], state[2:4], state[4])
    for k, one in enumerate(INPUTS):
        np.testing.assert_allclose(client.differentiate(OUTPUTS, [one], [1.0]), by[:, k], rtol=1e-12)
    laminar = bearing(name, None).force(state[:2], state[2:4], state[4])
    assert np.abs(wanted - laminar).max() > 0.05 * np.abs(laminar).max()
