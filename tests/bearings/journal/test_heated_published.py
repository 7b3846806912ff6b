"""Films that warm against other programs: that of ROSS, and an independent code of the same equations."""

import dataclasses
import functools

import numpy as np
import pytest

from rotorfilm import Groove
from rotorfilm.analysis import coefficients, heated_equilibrium
from rotorfilm.bearings.journal import (
    BushRing,
    HeatedFilm,
    JournalBearing,
    LayeredTemperature,
    MeanTemperature,
)
from rotorfilm.bearings.oil import Cooling, Exponential, Oil

CELSIUS = 273.15


def two_grooves(width):
    return (Groove(center=0.0, width=width), Groove(center=np.pi, width=width))


ROSS_OIL = Oil(
    law=Exponential(value=0.01901574, temperature=322.983, decay=np.log(0.01901574 / 0.00771523) / 30.0),
    reference_density=854.9516 / (1.0 - 0.00064 * (322.983 - 288.15)),
    fixed_heat_capacity=1951.5015,
)
ROSS = JournalBearing(
    radius=0.1999996,
    length=0.263144,
    clearance=194.564e-6,
    oil=ROSS_OIL,
    cooling=Cooling(supply_temperature=323.0),
    grooves=two_grooves(np.pi - 3.07178),
)
ROSS_LOAD, ROSS_SPEED = [0.0, -112814.907], 30.0 * np.pi


@pytest.mark.literature
def test_adiabatic_bearing_of_ross():
    """fixed_adiabatic.json of petrobras/ross: its own solver on 20 x 10 elements."""
    found = heated_equilibrium(HeatedFilm(bearing=ROSS, cells=(160, 8)), ROSS_LOAD, ROSS_SPEED)
    state = found.state
    assert found.rest.eccentricity_ratio == pytest.approx(0.6114, rel=0.01)
    assert found.rest.attitude_angle == pytest.approx(0.8050, rel=0.01)
    assert state.power_loss == pytest.approx(8380.0, rel=0.01)
    assert state.side_flow == pytest.approx(3.683e-4, rel=0.01)
    assert state.maximum_temperature == pytest.approx(345.14, abs=0.5)
    mixed = {round(T, 9) for T in state.oil_temperature[state.film.cells.held].ravel()}
    assert sorted(mixed) == pytest.approx([329.32, 335.71], abs=0.5)
    assert abs(state.heat.missing) < 1e-12 * state.heat.made


@pytest.mark.literature
def test_isothermal_bearing_of_ross():
    """fixed_isoviscous.json."""
    oil = Oil.constant(float(ROSS_OIL.viscosity(322.983)))
    film = HeatedFilm(bearing=dataclasses.replace(ROSS, oil=oil), cells=(160, 8))
    found = heated_equilibrium(film, ROSS_LOAD, ROSS_SPEED)
    assert found.rest.eccentricity_ratio == pytest.approx(0.5410, rel=0.01)
    assert found.rest.attitude_angle == pytest.approx(0.8436, rel=0.01)
    assert found.state.power_loss == pytest.approx(11675.0, rel=0.01)
    assert found.state.side_flow == pytest.approx(3.352e-4, rel=0.01)


@pytest.mark.literature
def test_conducting_bearing_of_ross():
    """fixed_full_tempj_noflux.json; its pads deform too: eps .6266, attitude .7736, P 8223, T_j 336.4."""
    ring = BushRing(
        outer_radius=ROSS.radius + 0.1496, conductivity=50.09, transfer=735.9, ambient_temperature=326.0
    )
    film = HeatedFilm(bearing=ROSS, walls=ring, profile=LayeredTemperature(8))
    found = heated_equilibrium(film, ROSS_LOAD, ROSS_SPEED)
    assert found.rest.eccentricity_ratio == pytest.approx(0.6266, rel=0.01)
    assert found.rest.attitude_angle == pytest.approx(0.7736, rel=0.045)
    assert found.state.power_loss == pytest.approx(8223.0, rel=0.045)
    assert found.state.maximum_temperature == pytest.approx(344.9, abs=1.5)
    assert found.state.journal_temperature == pytest.approx(336.4, abs=2.0)


def bearing_of(radius, length, clearance, grade, supply, grooves=()):
    oil, cooling = Oil.iso_vg(grade), Cooling(supply_temperature=supply + CELSIUS)
    return JournalBearing(
        radius=radius, length=length, clearance=clearance, oil=oil, cooling=cooling, grooves=grooves
    )


TWENTY = two_grooves(np.radians(20.0))
TOP = (Groove(center=0.5 * np.pi, width=np.radians(20.0)),)
CASES = {
    "demo": (bearing_of(0.05, 0.03, 1e-4, 100, 37.1), 525.0, 1500.0),
    "VG 46": (bearing_of(0.05, 0.05, 75e-6, 46, 45.0, TWENTY), 5000.0, 3000.0),
    "turbine": (bearing_of(0.1, 0.16, 150e-6, 32, 45.0, TWENTY), 30000.0, 3000.0),
    "small": (bearing_of(0.01, 0.01, 20e-6, 22, 50.0), 100.0, 60000.0),
    "slow": (bearing_of(0.15, 0.18, 2e-4, 220, 40.0, TOP), 60000.0, 100.0),
    "ROSS": (ROSS, 112814.907, 900.0),
}
RUNGS = {
    "T2 adiabatic": (False, MeanTemperature()),
    "T2 bush": (True, MeanTemperature()),
    "T3 bush": (True, LayeredTemperature(12)),
}
# eccentricity ratio, attitude [deg], power [W], largest temperature [degC], K_yy [MN/m]
TABLE = {
    ("demo", "T2 adiabatic"): (0.441, 61.9, 236.0, 64.1, 12.5),
    ("demo", "T2 bush"): (0.439, 62.5, 254.0, 57.4, 12.2),
    ("demo", "T3 bush"): (0.458, 61.2, 260.0, 58.3, 12.7),
    ("VG 46", "T2 adiabatic"): (0.569, 48.9, 758.0, 74.4, 218.0),
    ("VG 46", "T2 bush"): (0.572, 48.7, 787.0, 68.1, 218.0),
    ("VG 46", "T3 bush"): (0.594, 47.2, 789.0, 70.9, 230.0),
    ("turbine", "T2 adiabatic"): (0.448, 53.2, 7320.0, 66.6, 461.0),
    ("turbine", "T2 bush"): (0.446, 53.4, 7420.0, 65.5, 456.0),
    ("turbine", "T3 bush"): (0.474, 54.3, 7350.0, 71.7, 474.0),
    ("small", "T2 adiabatic"): (0.264, 74.7, 312.0, 133.6, 8.4),
    ("small", "T2 bush"): (0.267, 75.0, 316.0, 125.3, 8.4),
    ("small", "T3 bush"): (0.274, 76.6, 333.0, 131.2, 7.8),
    ("slow", "T2 adiabatic"): (0.746, 40.8, 325.0, 59.1, 1498.0),
    ("slow", "T2 bush"): (0.718, 40.8, 412.0, 44.4, 1360.0),
    ("slow", "T3 bush"): (0.719, 40.4, 415.0, 44.5, 1382.0),
    ("ROSS", "T2 adiabatic"): (0.609, 46.1, 8310.0, 71.7, 1950.0),
    ("ROSS", "T2 bush"): (0.606, 46.3, 8560.0, 67.7, 1920.0),
    ("ROSS", "T3 bush"): (0.628, 46.2, 8590.0, 70.9, 2020.0),
}


@functools.cache
def found_by_rung(case, rung):
    """Return eccentricity ratio, attitude [deg], power [W], largest temperature [degC], K_yy [MN/m]."""
    bearing, load, rpm = CASES[case]
    with_bush, profile = RUNGS[rung]
    across = isinstance(profile, LayeredTemperature)
    walls = {"walls": BushRing(outer_radius=2.0 * bearing.radius)} if with_bush else {}
    film = HeatedFilm(bearing=bearing, profile=profile, cells=(80 if across else 120, 8), **walls)
    speed = rpm * np.pi / 30.0
    found = heated_equilibrium(film, [0.0, -load], speed)
    rest, state = found.rest, found.state
    K = coefficients(state.film, rest.position, speed).stiffness[1, 1]
    T = state.maximum_temperature - CELSIUS
    return rest.eccentricity_ratio, np.degrees(rest.attitude_angle), state.power_loss, T, 1e-6 * K


@pytest.mark.literature
@pytest.mark.parametrize(
    ("case", "rung"),
    [
        pytest.param(*row, marks=[pytest.mark.long] * (row[1] == "T3 bush" and row[0] != "demo"))
        for row in TABLE
    ],
)
def test_table_of_an_independent_code(case, rung):
    """A prototype in plain numpy, on 120 x 8 cells and 12 layers; layers are on 80 x 8 here."""
    eccentricity, attitude, power, warmest, K = TABLE[case, rung]
    found = found_by_rung(case, rung)
    assert found[0] == pytest.approx(eccentricity, rel=0.01)
    assert found[1] == pytest.approx(attitude, abs=0.6)
    assert found[2] == pytest.approx(power, rel=0.02)
    assert found[3] == pytest.approx(warmest, abs=1.5)
    assert found[4] == pytest.approx(K, rel=0.05)
