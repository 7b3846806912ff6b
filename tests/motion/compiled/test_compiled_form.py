"""The compiled integration and scipy's give one motion; which is taken follows from rotor and films."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.integrate import Radau

from rotorfilm import (
    ClassicalBeam,
    ContactError,
    Disk,
    ElasticMaterial,
    Groove,
    GroovedMapFilm,
    JournalBearing,
    LinearBearing,
    Pad,
    PorousDamper,
    ReynoldsFilm,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    ShortFilm,
    SpeedProfile,
    Station,
    mount,
    periodic_orbit,
    reduce_rotor,
    simulate,
    simulate_rotor,
    with_springs,
)
from rotorfilm.analysis.compiled_rotor import compiled_form
from rotorfilm.bearings import FiniteSqueeze, FullFilm, HalfSommerfeld, MapSqueeze

SIZES = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
MAP = JournalBearing(**SIZES)
GROOVES = tuple(Groove(center=angle, width=0.3) for angle in (0.0, math.pi))
GRID = ReynoldsFilm(cells=(32, 4))
OPEN = {
    "grid": JournalBearing(**SIZES, film=GRID),
    "grid, supply": JournalBearing(**SIZES, film=GRID, grooves=GROOVES, supply_pressure=5e4),
    "grid, pads": JournalBearing(
        **SIZES, film=GRID, pads=(Pad(start=3.3, extent=2.6), Pad(start=0.2, extent=2.6))
    ),
    "grooved map": JournalBearing(
        **SIZES, film=GroovedMapFilm(cells=(32, 4), nodes=(6, 12, 12)), grooves=GROOVES
    ),
}
SMOOTH = {
    "map": MAP,
    "short": JournalBearing(**SIZES, film=ShortFilm()),
    "linear": LinearBearing(stiffness=((5e6, 1e6), (-1e6, 5e6)), damping=3e3),
    "sprung": with_springs(MAP, 1e6),
    "grooved map": OPEN["grooved map"],
}
DAMPER = PorousDamper(
    radius=0.05, length=0.02, clearance=1e-4, viscosity=0.02, extent=HalfSommerfeld(), film=MapSqueeze()
)


def rigid(**changes):
    values = {"mass": 53.5, "speed": 157.08, "unbalance": 2e-3, "position": (1e-5, -2e-5)}
    return RigidRotor(**(values | changes))


def shaft(speed=400.0, **changes):
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = Disk.solid(2, outer_diameter=0.28, density=7810.0, width=0.07, inner_diameter=0.05)
    return ShaftRotor(
        elements=ShaftElement(length=1.0, outer_diameter=0.05, material=steel).split(4),
        disks=(disk,),
        stations=(Station(node=0, name="left"), Station(node=4, name="")),
        beam=ClassicalBeam(),
        speed=speed,
        **changes,
    )


def both(rotor, bearing, **arguments):
    """Return the compiled run and scipy's."""
    runs = [simulate(rotor, bearing, **arguments, **method) for method in ({}, {"method": Radau})]
    assert ["rejected" in run.work for run in runs] == [True, False]
    assert list(runs[0].signals) == list(runs[1].signals)
    return runs


@pytest.mark.parametrize("name", SMOOTH)
@pytest.mark.parametrize("rtol", [1e-4, 1e-7])
def test_both_routes_are_within_the_tolerance(name, rtol):
    own, other = both(rigid(), SMOOTH[name], duration=0.05, samples=41, rtol=rtol)
    exact = simulate(rigid(), SMOOTH[name], duration=0.05, samples=41, rtol=1e-11)
    size = 1e-4
    assert np.abs(own.position - exact.position).max() < 5.0 * rtol * size
    assert np.abs(other.position - exact.position).max() < 50.0 * rtol * size


@pytest.mark.parametrize("name", [name for name in OPEN if name.startswith("grid")])
def test_both_routes_agree_on_grids(name):
    # The lines of a grid follow the journal: its force has kinks, which no step sees to a tight tolerance.
    own, other = both(rigid(), OPEN[name], duration=0.02, samples=11, rtol=1e-4)
    np.testing.assert_allclose(own.position, other.position, atol=2e-3 * 1e-4)


@pytest.mark.long
def test_both_routes_agree_on_a_damper_that_is_run_up_between_springs():
    support = with_springs(DAMPER, 2e6)
    profile = SpeedProfile(times=(0.0, 0.1), speeds=(50.0, 400.0))
    rotor = rigid(speed=profile, gravity=(0.0, 0.0))
    own, other = both(rotor, support, duration=0.12, samples=41, rtol=1e-7)
    np.testing.assert_allclose(own.position, other.position, atol=1e-5 * 1e-4)
    np.testing.assert_allclose(own["force_x"], other["force_x"], atol=1e-5 * np.abs(own["force_x"]).max())
    assert own.work["film_evaluations"] < other.work["film_evaluations"]


def test_both_routes_agree_on_a_shaft_with_bearings_in_two_stations():
    small = mount(reduce_rotor(shaft(), frequency=500.0, tolerance=1e-1).rotor, {"left": MAP})
    own, other = both(small, MAP, duration=0.02, samples=21, rtol=1e-6)
    for name in ("left_x", "left_y", "x", "y"):
        np.testing.assert_allclose(own[name], other[name], atol=1e-4 * 1e-4)
    for name in ("left_force_y", "force_x", "force_y"):
        np.testing.assert_allclose(own[name], other[name], atol=1e-3 * np.abs(other[name]).max())


@pytest.mark.filterwarnings("ignore:eccentricity ratio .* is beyond the map", "ignore:a journal went beyond")
def test_contact_keeps_the_same_partial_result():
    arguments = {"duration": 0.05, "samples": 2001, "rtol": 1e-6}
    weak = replace(MAP, viscosity=1e-9)
    runs = []
    for method in ({}, {"method": Radau}):
        with pytest.raises(ContactError, match="journal reached the wall at t = ") as caught:
            simulate(rigid(unbalance=0.0), weak, **arguments, **method)
        runs.append(caught.value.partial)
    count = min(len(run.time) for run in runs)
    assert count > 50
    assert abs(len(runs[0].time) - len(runs[1].time)) <= 5
    assert list(runs[0].signals) == list(runs[1].signals)


class Heavier(RigidRotor):
    """A rotor with equations of its own."""

    def derivative(self, t, x, u):
        return super().derivative(t, x, u) * np.array([1.0, 1.0, 0.5, 0.5])


@dataclass(frozen=True, kw_only=True)
class OwnBearing(JournalBearing):
    """A bearing of a user."""


WITHOUT_KERNEL = PorousDamper(
    radius=0.05, length=0.02, clearance=1e-4, viscosity=0.02, film=FiniteSqueeze(), extent=FullFilm()
)


@pytest.mark.parametrize(
    ("rotor", "bearing"),
    [
        (Heavier(mass=53.5, speed=157.0), MAP),
        (rigid(), OwnBearing(**SIZES)),
        (rigid(), WITHOUT_KERNEL),
        (mount(shaft(), {"left": OwnBearing(**SIZES)}), MAP),
        (mount(shaft(loss_factor=0.01), {"left": MAP}), MAP),
    ],
    ids=[
        "own rotor",
        "own bearing",
        "film without kernel",
        "own bearing mounted",
        "hysteresis",
    ],
)
def test_what_the_compiled_integration_does_not_take_is_left_to_scipy(rotor, bearing):
    assert compiled_form(rotor, bearing) is None


@pytest.mark.parametrize("name", OPEN)
def test_films_with_openings_are_mounted_and_have_orbits(name):
    mounted = mount(rigid(unbalance=5e-4), {"": OPEN[name]})
    tight = 1e-7 if "map" in name else 1e-4
    orbit = periodic_orbit(mounted, tolerance=10.0 * tight, stability=False)
    run = simulate_rotor(mounted, duration=orbit.period, initial_state=orbit.state, rtol=tight, samples=9)
    np.testing.assert_allclose(run.position, orbit.position(run.time)[0], atol=100.0 * tight * 1e-4)
