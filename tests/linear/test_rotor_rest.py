"""Flexible rotors at rest in several bearings."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import EquilibriumError, InputError, LinearBearing
from rotorfilm.analysis import (
    campbell,
    coefficients,
    equilibrium,
    rotor_equilibrium,
    rotor_threshold,
    simulate,
)
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.bearings.pads import TiltingPadBearing, even_pivots
from rotorfilm.core import UnloadedPadWarning
from rotorfilm.rotors import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    JeffcottRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    mount,
)

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
WIDE = JournalBearing(radius=0.05, length=0.045, clearance=1.5e-4, viscosity=0.05, film=ShortFilm())
SPEED = 157.0


def shaft(pieces=6, **changes):
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(pieces),
        "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        "stations": (Station(node=0, name="left"), Station(node=pieces)),
        "speed": SPEED,
    }
    return ShaftRotor(**(parts | changes))


@pytest.mark.closed_form
def test_two_bearings_share_the_weight_by_the_lever():
    rotor = shaft()
    at = rotor_equilibrium(rotor, {"left": FILM, "": WIDE}, SPEED)
    small, large = (disk.mass for disk in rotor.disks)
    uniform = rotor.mass - small - large
    left = 9.80665 * (uniform / 2 + small * 2 / 3 + large / 3)
    assert_allclose(at.loads["left"], [0.0, -left], atol=1e-6 * left)
    assert_allclose(at.loads["left"] + at.loads[""], [0.0, -9.80665 * rotor.mass], rtol=1e-9, atol=1e-6)
    for name, film in (("left", FILM), ("", WIDE)):
        alone = equilibrium(film, at.loads[name], SPEED)
        assert_allclose(at.coefficients[name].position, alone.position, rtol=1e-7)
    assert at.residual < 1e-9


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_a_rotor_rests_where_a_pad_gets_its_film_as_each_journal_does_alone():
    """The load of the upper pad begins as a square root there, and whole Newton steps go to and fro."""
    pads = TiltingPadBearing(
        radius=0.04,
        length=0.04,
        assembled_clearance=7e-5,
        preload=0.3,
        extent=np.pi / 3.0,
        viscosity=0.02,
        pivots=even_pivots(5, between_pads=True),
    )
    rotor = shaft(
        elements=ShaftElement(length=1.5, outer_diameter=0.09, material=STEEL).split(6),
        stations=(Station(node=0, name="left"), Station(node=3), Station(node=6, name="right")),
    )
    films, unloaded = {"left": pads, "": LinearBearing(stiffness=1e7), "right": pads}, []
    for speed in (119.35, 119.3952, 119.42, 119.45, 119.5):
        at = rotor_equilibrium(rotor, films, speed)
        alone = equilibrium(pads, at.loads["right"], speed)
        assert_allclose(at.coefficients["right"].position, alone.position, rtol=1e-7, atol=1e-13)
        unloaded.append(bool(alone.pads.unloaded.any()))
    assert unloaded[0]
    assert not unloaded[-1]
    with pytest.warns(UnloadedPadWarning) as told:
        campbell(rotor, films, [119.5, 100.0, 90.0])
    told = [str(one.message) for one in told]
    assert len(told) == 2
    assert re.match("in the bearing at 'left' at 100 rad/s pads 3", told[0])
    assert re.match("in the bearing at 'right' at 100 rad/s pads 3", told[1])


@pytest.mark.closed_form
def test_a_rotor_on_tilting_pads_rests_where_each_journal_does_alone():
    """Pads that follow take no journal aside; held at the tilts of a centered journal they would."""
    pads = TiltingPadBearing(
        radius=0.05,
        length=0.05,
        assembled_clearance=7e-5,
        preload=0.3,
        extent=np.pi / 3.0,
        viscosity=0.02,
        pivots=even_pivots(5, between_pads=True),
    )
    for near in (SPEED, 1.5 * SPEED):
        at = rotor_equilibrium(shaft(), {"left": pads, "": WIDE}, near)
        place = at.coefficients["left"].position
        assert abs(place[0]) < 1e-9 * abs(place[1])
        assert_allclose(pads.at_rest().force(place, [0.0, 0.0], near), -at.loads["left"], atol=1e-6)
        assert_allclose(place, equilibrium(pads, at.loads["left"], near).position, atol=1e-12)


@pytest.mark.closed_form
def test_two_spans_on_rigid_bearings():
    """Uniform beam on three stiff supports: the middle one carries 5/8 of the weight, the ends 3/16 each."""
    light = ShaftElement(length=2.0, outer_diameter=0.02, material=STEEL)
    rotor = ShaftRotor(
        elements=light.split(8),
        stations=tuple(Station(node=n, name=f"b{n}") for n in (0, 4, 8)),
        speed=0.0,
    )
    hard = LinearBearing(stiffness=1e13)
    at = rotor_equilibrium(rotor, dict.fromkeys(("b0", "b4", "b8"), hard), 0.0)
    shares = [at.loads[name][1] / (-9.80665 * rotor.mass) for name in ("b0", "b4", "b8")]
    assert_allclose(shares, [3 / 16, 5 / 8, 3 / 16], rtol=3e-3)  # shear takes 2e-3


def test_three_films_carry_what_shaft_and_films_agree_on():
    """Forces and displacements fit, by an independent solution with a stiff shaft: all journals in line."""
    stiff = ElasticMaterial(young_modulus=211e13, shear_modulus=81e13, density=7810.0)
    piece = ShaftElement(length=1.0, outer_diameter=0.1, material=stiff)
    rotor = ShaftRotor(
        elements=piece.split(4), stations=tuple(Station(node=n, name=f"b{n}") for n in (0, 2, 4)), speed=SPEED
    )
    at = rotor_equilibrium(rotor, {"b0": FILM, "b2": WIDE, "b4": FILM}, SPEED)
    places = [at.coefficients[name].position for name in ("b0", "b2", "b4")]
    assert_allclose(places[0], places[1], atol=1e-4 * FILM.clearance)
    assert_allclose(places[0], places[2], atol=1e-4 * FILM.clearance)
    both = 2 * FILM.force(places[0], [0.0, 0.0], SPEED) + WIDE.force(places[0], [0.0, 0.0], SPEED)
    assert_allclose(both, [0.0, 9.80665 * rotor.mass], rtol=2e-3, atol=0.5)


@pytest.mark.closed_form
def test_support_gives_way_under_its_bearing():
    support = Support(mass=10.0, stiffness=((2e6, 3e5), (-1e5, 1e6)))
    rotor = shaft(stations=(Station(node=0, name="left", support=support), Station(node=6)))
    at = rotor_equilibrium(rotor, {"left": FILM, "": FILM}, SPEED)
    size = len(rotor.structure.coordinates)
    housing = at.displacement[[size - 1, 2 * size - 1]]
    expected = np.linalg.solve(support.stiffness, at.loads["left"] + [0.0, -98.0665])
    assert_allclose(housing, expected, rtol=1e-7)
    journal = at.displacement[[0, size]]
    assert_allclose(journal - housing, at.coefficients["left"].position, atol=1e-12)


def test_rotor_stays_where_it_rests():
    rotor = shaft(beam=ClassicalBeam(), internal_damping=1e-4)
    at = rotor_equilibrium(rotor, {"left": FILM, "": WIDE}, SPEED)
    start = np.concatenate([at.displacement, 0 * at.displacement])
    run = simulate(
        mount(rotor, {"left": FILM}), WIDE, duration=0.02, samples=5, initial_state=start, rtol=1e-6
    )
    drift = run.position - at.coefficients[""].position[:, None]
    assert np.abs(drift).max() < 1e-6 * WIDE.clearance


def test_no_weight_leaves_the_journals_in_the_middle():
    at = rotor_equilibrium(shaft(gravity=(0.0, 0.0)), {"left": FILM, "": FILM}, SPEED)
    assert_allclose(at.coefficients["left"].position, 0.0, atol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize(("young", "spring"), [(211e9, 1.0), (1e16, 1e6), (1e18, 1e7)])
def test_roundoff_of_stiff_shafts_on_soft_springs_is_no_imbalance(young, spring):
    material = ElasticMaterial(young_modulus=young, shear_modulus=0.4 * young, density=7810.0)
    rotor = shaft(elements=ShaftElement(length=1.5, outer_diameter=0.05, material=material).split(6))
    at = rotor_equilibrium(rotor, dict.fromkeys(("left", ""), LinearBearing(stiffness=spring)), SPEED)
    whole = sum(at.loads.values())
    assert_allclose(whole, [0.0, -9.80665 * rotor.mass], rtol=1e-6, atol=1e-6)
    assert_allclose(at.coefficients["left"].position, at.loads["left"] / spring, rtol=1e-9)


@pytest.mark.closed_form
def test_two_bearings_on_one_node_share_its_load():
    stations = (Station(node=0, name="left"), Station(node=0, name="also"), Station(node=6))
    at = rotor_equilibrium(shaft(stations=stations), {"left": FILM, "also": FILM, "": WIDE}, SPEED)
    double = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.2, film=ShortFilm())
    one = rotor_equilibrium(shaft(), {"left": double, "": WIDE}, SPEED)
    for name in ("left", "also"):
        assert_allclose(at.loads[name], one.loads["left"] / 2.0, rtol=1e-8, atol=1e-6)
        assert_allclose(at.coefficients[name].position, one.coefficients["left"].position, rtol=1e-8)


@pytest.mark.parametrize("spring", [1e-6, 1e-12])
def test_springs_so_soft_that_roundoff_is_more_than_the_weight_are_refused(spring):
    with pytest.raises(EquilibriumError, match=r"the imbalance is .* of the weight"):
        rotor_equilibrium(shaft(), dict.fromkeys(("left", ""), LinearBearing(stiffness=spring)), SPEED)


def test_what_cannot_rest_is_refused():
    with pytest.raises(EquilibriumError, match="bearings must hold the rotor, got \\['left'\\]"):
        rotor_equilibrium(shaft(), {"left": FILM}, SPEED)
    with pytest.raises(InputError, match=r"bearings must be in the stations \['left', ''\], got \['right'\]"):
        rotor_equilibrium(shaft(), {"right": FILM}, SPEED)
    with pytest.raises(EquilibriumError, match=r"capacity|carries none"):
        rotor_equilibrium(shaft(), {"left": FILM, "": FILM}, 1e-9)


class Following:
    """A spring whose states, of which it says nothing, rest with the journal."""

    def __init__(self, spring):
        self.spring, self.clearance = spring, spring.clearance
        self.inputs, self.outputs, self.states = spring.inputs, spring.outputs, ()

    def __getattr__(self, name):
        return getattr(self.spring, name)

    def at_rest(self):
        return self

    def settled(self, found):
        return found

    def coefficients(self, position, speed, frequency=None):
        return coefficients(self.spring, position, speed)


def test_a_rotor_on_films_whose_states_rest_with_the_journal_has_its_threshold():
    spring = LinearBearing(stiffness=[[1e7, 2e5], [-2e5, 1e7]], damping=300.0)
    rotor = JeffcottRotor(mass=20.0, journal_mass=1.0, stiffness=1e7, speed=100.0, internal_damping=400.0)
    speeds = np.linspace(50.0, 2000.0, 20)
    plain, following = (rotor_threshold(rotor, {"": one}, speeds) for one in (spring, Following(spring)))
    assert plain.speed is not None
    assert following.speed == pytest.approx(plain.speed, rel=1e-11)
