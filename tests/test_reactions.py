"""Whatever asks for a Reaction says what one lacks, and arguments of the wrong kind name themselves."""

import pytest

from rotorfilm import (
    ElasticMaterial,
    InputError,
    JournalBearing,
    LinearBearing,
    OperatingPoint,
    Reaction,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    campbell,
    closed_loop,
    coefficients,
    critical_speeds,
    equilibrium,
    linearize,
    mount,
    orbit_coefficients,
    rotor_equilibrium,
    rotor_modes,
    rotor_threshold,
    rotor_transmissibility,
    simulate,
    small_motion_transmissibility,
    synchronous_orbits,
    transmissibility,
    unbalance_response,
    whirl_threshold,
    with_springs,
)
from rotorfilm.analysis import coefficient_table, orbit_system
from rotorfilm.core import CircularOrbit
from rotorfilm.core.errors import require_kind

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
SHAFT = ShaftRotor(
    elements=ShaftElement(length=1.0, outer_diameter=0.05, material=STEEL).split(2),
    stations=(Station(node=0, name="left"), Station(node=2, name="right")),
    speed=100.0,
)
RIGID = RigidRotor(mass=10.0, speed=100.0, unbalance=1e-4, gravity=(0.0, 0.0))
SPRING = LinearBearing(stiffness=1e6)
LOAD, SPEEDS = [0.0, -100.0], [50.0, 100.0]


class Poor:
    """A bearing without derivatives, and without a word about its signals."""

    clearance = 1e-4

    def force(self, position, velocity, speed):
        raise AssertionError("nobody asks a bearing that is refused")


POOR = Poor()

ASKED = {
    "equilibrium": lambda film: equilibrium(film, LOAD, 100.0),
    "coefficients": lambda film: coefficients(film, [0.0, 0.0], 100.0),
    "coefficient_table": lambda film: coefficient_table(film, LOAD, SPEEDS),
    "whirl_threshold": lambda film: whirl_threshold(film, LOAD, 10.0),
    "transmissibility": lambda film: transmissibility(RIGID, film, LOAD, SPEEDS),
    "closed_loop": lambda film: closed_loop(RIGID, film, None),
    "linearize": lambda film: linearize(film, OperatingPoint()),
    "orbit_coefficients": lambda film: orbit_coefficients(film, 0.5, 100.0),
    "orbit_system": lambda film: orbit_system(RIGID, film, CircularOrbit),
    "small_motion_transmissibility": lambda film: small_motion_transmissibility(RIGID, film),
    "synchronous_orbits": lambda film: synchronous_orbits(RIGID, film),
    "simulate": lambda film: simulate(RIGID, film, duration=0.1),
    "with_springs": lambda film: with_springs(film, 1e6),
}
WITH_STATIONS = {
    "mount": lambda films: mount(SHAFT, films),
    "rotor_equilibrium": lambda films: rotor_equilibrium(SHAFT, films, 100.0),
    "rotor_modes": lambda films: rotor_modes(SHAFT, films, 100.0),
    "campbell": lambda films: campbell(SHAFT, films, SPEEDS),
    "critical_speeds": lambda films: critical_speeds(SHAFT, films, SPEEDS),
    "rotor_threshold": lambda films: rotor_threshold(SHAFT, films, SPEEDS),
    "rotor_transmissibility": lambda films: rotor_transmissibility(SHAFT, films, SPEEDS),
}


@pytest.mark.parametrize("ask", ASKED.values(), ids=ASKED)
def test_what_lacks_methods_is_told_which(ask):
    with pytest.raises(
        InputError, match=r"(reaction|model) must be a .*Poor object.* without .*jacobian|linearization"
    ):
        ask(POOR)


@pytest.mark.parametrize("ask", ASKED.values(), ids=ASKED)
def test_a_class_in_place_of_a_bearing_is_named(ask):
    with pytest.raises(InputError, match=r"(reaction|model) must be a .*, got <class .*JournalBearing'>"):
        ask(JournalBearing)


@pytest.mark.parametrize("ask", WITH_STATIONS.values(), ids=WITH_STATIONS)
def test_films_without_stations_name_themselves(ask):
    with pytest.raises(
        InputError, match=r"bearings must be a mapping such as \{'left': film\}, got LinearBearing"
    ):
        ask(SPRING)
    with pytest.raises(
        InputError, match=r"bearings\['right'\] must be a Reaction .* without .*linearization"
    ):
        ask({"left": SPRING, "right": POOR})


@pytest.mark.parametrize("ask", [campbell, rotor_threshold, unbalance_response, rotor_transmissibility])
def test_a_rotor_of_the_wrong_kind_names_itself(ask):
    with pytest.raises(
        InputError,
        match="rotor must be a flexible rotor such as a ShaftRotor or a RigidShaft, got LinearBearing",
    ):
        ask(SPRING, {"left": SPRING}, SPEEDS)


def test_a_run_without_a_rotor_names_it():
    with pytest.raises(InputError, match=r"rotor must be a rotor .* without inputs, linearization"):
        simulate(POOR, SPRING, duration=0.1)
    with pytest.raises(InputError, match=r"rotor must have the outputs .* without"):
        simulate(SPRING, SPRING, duration=0.1)
    with pytest.raises(InputError, match=r"rotor must be a rotor .*, got LinearBearing"):
        mount(SPRING, {"left": SPRING})


def test_the_check_agrees_with_the_protocol_and_asks_no_property():
    asked = []

    class Asked(LinearBearing):
        @property
        def inputs(self):
            asked.append("inputs")
            return super().inputs

    spring = Asked(stiffness=1e6)
    require_kind("reaction", spring, Reaction, "a Reaction")
    assert asked == []
    assert isinstance(spring, Reaction)
    assert not isinstance(POOR, Reaction)
