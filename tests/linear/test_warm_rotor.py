"""Rotors on films whose temperature follows from the balance of their heat."""

import numpy as np
import pytest

from rotorfilm import (
    ClassicalBeam,
    Cooling,
    Disk,
    ElasticMaterial,
    JournalBearing,
    Oil,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    mount,
    rotor_equilibrium,
    rotor_modes,
    simulate,
)

STEEL = ElasticMaterial(density=7850.0, young_modulus=2.1e11, shear_modulus=8.1e10)
SPEED = 50.0 * np.pi


def bearing(**changes):
    given = {
        "radius": 0.05,
        "length": 0.03,
        "clearance": 1e-4,
        "oil": Oil.iso_vg(100),
        "cooling": Cooling(supply_temperature=310.25),
    }
    return JournalBearing(**{**given, **changes})


def rotor():
    return ShaftRotor(
        elements=ShaftElement(length=1.2, outer_diameter=0.1, material=STEEL).split(6),
        disks=(Disk(node=2, mass=60.0, polar_inertia=0.5, diametral_inertia=0.3),),
        stations=(Station(name="left", node=0), Station(name="right", node=6)),
        beam=ClassicalBeam(),
        speed=SPEED,
    )


def test_each_bearing_rests_at_the_temperature_of_its_own_balance():
    warm = {"left": bearing(), "right": bearing()}
    rest = rotor_equilibrium(rotor(), warm, SPEED)
    # The one that carries more is more eccentric and leaks more.
    assert rest.temperatures["right"] > rest.temperatures["left"] > 310.25
    for name, film in warm.items():
        balanced = film.balanced_temperature(rest.coefficients[name].position, (0.0, 0.0), SPEED)
        assert rest.temperatures[name] == pytest.approx(balanced, abs=1e-6)
    frozen = {name: film.at_temperature(rest.temperatures[name]) for name, film in warm.items()}
    cold = rotor_equilibrium(rotor(), frozen, SPEED)
    for name in warm:
        assert rest.coefficients[name].stiffness == pytest.approx(cold.coefficients[name].stiffness, rel=1e-7)
    modes, same = (rotor_modes(rotor(), films, SPEED) for films in (warm, frozen))
    assert modes.eigenvalues == pytest.approx(same.eigenvalues, rel=1e-6)


def test_a_mounted_rotor_has_the_temperatures_as_states():
    mounted = mount(rotor(), {"left": bearing(), "right": bearing()})
    names = [signal.name for signal in mounted.states]
    assert names[-2:] == ["left_temperature", "right_temperature"]


@pytest.mark.long
def test_in_time_the_film_warms_and_keeps_its_temperature_in_vibration():
    cooling = Cooling(supply_temperature=310.25, bush_heat_capacity=300.0)
    run = simulate(RigidRotor(mass=50.0, speed=SPEED), bearing(cooling=cooling), duration=0.15, samples=151)
    temperature = run["temperature"]
    assert temperature[0] == 310.25
    # 200 to 500 W into some 300 J/K: the order of a kelvin a second, and no ripple of the orbit.
    assert 0.1 < temperature[-1] - temperature[0] < 0.4
    assert np.abs(np.diff(temperature, 2)).max() < 1e-4
