"""The FMU of a bearing whose oil warms: the thermal state inside, as the model has it in Python."""

import fmpy
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rotorfilm import Cooling, JournalBearing, Oil, ShortFilm, export_fmu
from rotorfilm.bearings.journal import MapFilm

COOLING = Cooling(
    supply_temperature=310.25, housing_conductance=3.0, ambient_temperature=300.0, bush_heat_capacity=20.0
)
START = {"x": 2e-5, "y": -3e-5, "vx": 1e-4, "vy": -2e-3, "speed": 157.0}


def bearing(film):
    return JournalBearing(
        radius=0.05, length=0.03, clearance=1e-4, oil=Oil.iso_vg(100), cooling=COOLING, film=film
    )


@pytest.mark.parametrize("version", ["2.0", "3.0"])
@pytest.mark.parametrize("film", [MapFilm(), ShortFilm()], ids=["map", "short"])
def test_the_temperature_is_that_of_the_model(film, version, tmp_path):
    path = export_fmu(
        bearing(film), tmp_path / "warm.fmu", version, start=START, stop_time=20.0, step_size=0.5
    )
    assert not fmpy.read_model_description(path).modelVariables[0].name.startswith("python")
    told = fmpy.simulate_fmu(
        str(path), stop_time=20.0, step_size=0.5, output_interval=0.5, fmi_type="CoSimulation"
    )
    running, u = bearing(film).in_time(), np.array(list(START.values()))
    exact = solve_ivp(
        lambda t, x: running.derivative(t, x, u),
        (0.0, 20.0),
        running.initial_state,
        method="DOP853",
        rtol=1e-12,
        atol=1e-9,
        t_eval=told["time"],
    )
    names = {name.rpartition(".")[2]: name for name in told.dtype.names}
    assert np.abs(told[names["film_temperature"]] / exact.y[0] - 1.0).max() < 1e-9
    for k, name in enumerate(signal.name for signal in running.outputs):
        outputs = [running.output(t, [T], u)[k] for t, T in zip(told["time"], exact.y[0], strict=True)]
        assert told[names[name]] == pytest.approx(outputs, rel=1e-8)
