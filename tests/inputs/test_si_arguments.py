"""Quantities with their units: a string and a float give equal objects, and what is wrong names itself."""

import dataclasses
import inspect
import math
import pickle

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm import InputError, ValidityWarning
from rotorfilm.core import BUILT, UNITS, si_name, units_of

from .public_objects import BALL, BEARING, MADE, PUBLIC

DAMPER = next(one for one in MADE if isinstance(one, rf.PorousDamper))

RESULTS = {
    "AxialStatics", "BallLoads", "BallEquilibrium", "BasinScan", "Campbell", "CircularOrbit",
    "ClearanceCheck", "CoSimulation",
    "Coefficients", "VerifiedCriticalMass", "VerifiedThreshold", "CouplingReport", "CrackedResponse",
    "CriticalMass", "CriticalSpeed", "DamperTurn", "Equilibrium", "FilmDamping", "FilmSystem",
    "HeatedJFOState", "HeatedState", "HopfPoint", "InertialCoefficients", "JFOOrbit", "JFOState",
    "FrequencyDependentCoefficients", "MeshConvergence", "PadEquilibrium", "PadMatrices", "PeriodicOrbit",
    "DeflectedShape", "OrbitsOverSpeed", "RunAmplitudes", "RunOrbits", "RunSpectra", "RunSpectrum",
    "RunWhirl", "ThrustLosses",
    "ReducedCoefficients", "Reduction", "ResonancePeak", "RingContacts", "RotorEquilibrium", "RotorModes",
    "RotorThreshold", "RuptureError", "SealFlow", "SeparationMargins", "ShaftStatics", "SqueezeImpedance",
    "SqueezeMatrices",
    "StabilityChange", "StabilityCurve", "StabilityLevelOne", "StabilityLevelTwo", "AxialTorsionalModes",
    "TiltedPads", "Trajectory", "VariableCompliance", "WhirlThreshold",
}  # fmt: skip
"""Made by rotorfilm, not by its users."""

PARTS = {"PadBearing"}
"""What bearings are made of, which have it with quantities."""

SCALED = PARTS | {"BallSupport", "ContactLaw", "HeatedBearing", "MovingContact", "OwnReaction"}
"""Made by functions, from scales that these know."""


class Quantity:
    """What a quantity of pint is for us: a magnitude in units, and the same in others."""

    def __init__(self, magnitude, units, factors):
        self.magnitude, self.units, self.factors = magnitude, units, factors

    def to(self, unit):
        if unit not in self.factors:
            raise TypeError(unit)
        return Quantity(self.magnitude * self.factors[unit], unit, {})


def written(value, unit):
    """Return a quantity as a string, also inside of tuples; "" where there is none to write."""
    if isinstance(value, tuple):
        texts = tuple(written(one, unit) for one in value)
        return texts if all(texts) else ""
    return f"{value!r} {unit}" if isinstance(value, float) and math.isfinite(value) else ""


CASES = [
    pytest.param(one, name, text, id=f"{type(one).__name__}-{name}")
    for one in MADE
    for name, unit in units_of(type(one)).items()
    if (text := written(getattr(one, name, None), unit))
]


def given_to(one):
    return {field.name: getattr(one, field.name) for field in dataclasses.fields(one) if field.init}


@pytest.mark.parametrize(("one", "name", "text"), CASES)
def test_a_string_gives_the_object_that_a_float_gives(one, name, text):
    assert type(one)(**{**given_to(one), name: text}) == one


def test_every_public_constructor_is_among_them():
    taking = {
        name
        for name, made in PUBLIC.items()
        if dataclasses.is_dataclass(made)
        and any(UNITS[si_name(unit)].exponents for unit in units_of(made).values())
    }
    assert taking - RESULTS - SCALED <= {type(one).__name__ for one in MADE}
    assert all(hasattr(PUBLIC[name].__init__, "__wrapped__") for name in taking - RESULTS - SCALED)
    assert len(CASES) > 90


@pytest.mark.parametrize(
    ("made", "floats"),
    [
        (rf.JournalBearing(diameter="100 mm", length="30 mm", clearance="100 um", viscosity="100 cP"), None),
        (rf.JournalBearing(diameter=0.1, length=0.03, clearance=1e-4, viscosity=0.1), None),
        (rf.Pad(start="0 deg", extent="180 deg"), rf.Pad(start=0.0, extent=math.pi)),
        (rf.RigidRotor(mass="12 kg", speed="3000 rpm"), rf.RigidRotor(mass=12.0, speed=100.0 * math.pi)),
        (
            rf.RigidRotor(mass=1.0, speed=0.0, gravity=("0 m/s2", "-9.81 m/s2")),
            rf.RigidRotor(mass=1.0, speed=0.0, gravity=(0.0, -9.81)),
        ),
        (rf.SpeedProfile.constant("1 rpm"), rf.SpeedProfile.constant(math.pi / 30.0)),
    ],
)
@pytest.mark.closed_form
def test_other_units_are_converted(made, floats):
    for one, other in zip(dataclasses.astuple(made), dataclasses.astuple(floats or BEARING), strict=True):
        assert one == other or one == pytest.approx(other, rel=1e-15)


@pytest.mark.closed_form
def test_a_disk_of_given_size():
    steel = rf.Disk.solid(1, density="7850 kg/m3", width="10 mm", outer_diameter="200 mm")
    assert steel.mass == pytest.approx(7850.0 * math.pi * 0.1**2 * 0.01, rel=1e-14)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"length": "3 kg"}, r"length: quantity must be measured in m or a multiple of it, got '3 kg'"),
        ({"length": "3 furlongs"}, r"length: unit must be one of .*mm.*, got 'furlongs' in '3 furlongs'"),
        ({"length": "long"}, r"length: quantity must be a number with a unit such as '1 m', got 'long'"),
        ({"radius": "50"}, r"radius must have its unit, as '50 mm', got '50'"),
        ({"length": " 30. "}, r"length must have its unit, as '30. mm', got ' 30. '"),
        ({"viscosity": "1e-1"}, r"viscosity must have its unit, as '1e-1 Pa.s', got '1e-1'"),
        ({"clearance": "-1 mm"}, r"clearance must be finite and positive, got -0.001"),
        ({"diameter": "0.1 m"}, r"radius and diameter must not both be given, got 0.05 and '0.1 m'"),
        ({"viscosity": True}, r"viscosity must be finite and positive, got True"),
    ],
)
def test_a_wrong_quantity_names_argument_rule_and_value(wrong, message):
    with pytest.raises(InputError, match=f"^{message}$"):
        rf.JournalBearing(**{**given_to(BEARING), **wrong})


def test_a_diameter_of_what_has_no_radius_is_no_argument():
    with pytest.raises(TypeError, match=r"^diameter is no known argument of Pad; known here: start, extent$"):
        rf.Pad(start=0.0, extent=1.0, diameter=1.0)


@pytest.mark.parametrize(
    ("called", "name", "hint"),
    [
        (rf.Disk, "Id", "'diametral_inertia'"),
        (rf.Disk, "Ip", "'polar_inertia'"),
        (rf.Disk, "mas", "'mass'"),
        (rf.JournalBearing, "diametral_clearance", "'clearance', half of it"),
        (rf.TiltingPadBearing, "diametral_clearance", "'pad_clearance', half of it"),
        (rf.ShaftElement, "odl", "'outer_diameter'"),
        (rf.FeedHole, "diametre", "'diameter'"),
        (rf.equilibrium, "spede", "'speed'"),
    ],
)
def test_an_unknown_argument_hints_at_the_one_that_is_meant(called, name, hint):
    with pytest.raises(
        InputError, match=f"^{name} is no known argument of {called.__name__}; did you mean {hint}\\?$"
    ):
        called(**{name: 1.0})


def test_a_missing_argument_is_still_named():
    with pytest.raises(TypeError, match="missing 1 required keyword-only argument: 'length'"):
        rf.JournalBearing(radius=0.05, clearance=1e-4, viscosity=0.1)


def test_an_array_of_one_number_is_a_number():
    made = rf.JournalBearing(**{**given_to(BEARING), "radius": np.array(0.05), "clearance": np.array(1e-4)})
    assert made == BEARING
    assert type(made.radius) is float


@pytest.mark.closed_form
def test_kilograms_are_no_load():
    with pytest.raises(InputError, match=r"^load\[1\]: .* in N .*'-100 kg'; .* 9.80665 .*, -980.665 N$"):
        rf.equilibrium(BEARING, ("0 N", "-100 kg"), "3000 rpm")
    grams = Quantity(1.0, "kilogram", {"kg": 1.0})
    with pytest.raises(InputError, match=r"^load: quantity must be measured in N .* 9.80665 m/s2 times it$"):
        rf.RollingBall(**{**given_to(BALL), "load": grams})


def test_functions_take_what_constructors_take():
    found = rf.equilibrium(BEARING, load=["0 N", "-0.5 kN"], speed="100 rad/s")
    plain = rf.equilibrium(BEARING, (0.0, -500.0), 100.0)
    assert (found.position == plain.position).all()
    found = rf.bearings.damper_groups(DAMPER, mass="1 kg", speed="100 rad/s")
    assert found == rf.bearings.damper_groups(DAMPER, mass=1.0, speed=100.0)


def test_quantities_of_pint_are_asked_for_si():
    made = rf.JournalBearing(
        diameter=Quantity(100, "millimeter", {"m": 1e-3}),
        length=Quantity(0.03, "meter", {"m": 1.0}),
        clearance=1e-4,
        viscosity=Quantity(np.float64(0.1), "pascal * second", {"Pa*s": 1.0}),
    )
    assert made == BEARING
    assert type(made.length) is type(made.viscosity) is float
    cage = rf.PorousCage(thickness=1e-3, permeability=Quantity(1.0, "micron ** 2", {"m**2": 1e-12}))
    assert cage.permeability == 1e-12
    speeds = Quantity(np.array([100.0, 200.0]), "rpm", {"rad/s": math.pi / 30.0})
    table = rf.analysis.coefficient_table(BEARING, (0.0, -500.0), speeds)
    np.testing.assert_allclose(table.speeds, [100.0 * math.pi / 30.0, 200.0 * math.pi / 30.0])
    with pytest.raises(InputError, match=r"^radius: quantity must be measured in m or a multiple of it, got"):
        rf.JournalBearing(
            radius=Quantity(1.0, "second", {"s": 1.0}), length=1.0, clearance=1.0, viscosity=1.0
        )


def test_a_hertz_of_pint_is_no_speed():
    with pytest.raises(InputError, match=r"^speed: quantity must be .* in rad/s .*, with its angle, got"):
        rf.RigidRotor(mass=1.0, speed=Quantity(50.0, "hertz", {"rad/s": 1.0}))


def test_pint_itself():
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    made = rf.JournalBearing(
        diameter=100 * unit.mm, length=30 * unit.mm, clearance=100 * unit.um, viscosity=100 * unit.cP
    )
    for name in ("radius", "length", "clearance", "viscosity"):
        assert getattr(made, name) == pytest.approx(getattr(BEARING, name), rel=1e-14)
    assert rf.RigidRotor(mass=3 * unit.g, speed=60 * unit.rpm).speed == pytest.approx(2.0 * math.pi)
    for wrong in (50 * unit.Hz, 3 * unit.m):
        with pytest.raises(InputError, match=r"^speed: quantity must be measured in rad/s"):
            rf.RigidRotor(mass=1.0, speed=wrong)
    with pytest.raises(InputError, match=r"9\.80665"):
        rf.RollingBall(**{**given_to(BALL), "load": 1 * unit.kg})


def test_dataclasses_are_what_they_were():
    assert dataclasses.replace(BEARING, length="30 mm") == BEARING
    assert pickle.loads(pickle.dumps(BEARING)) == BEARING
    assert list(inspect.signature(rf.JournalBearing).parameters)[:4] == [
        "radius", "length", "clearance", "viscosity",
    ]  # fmt: skip
    assert inspect.signature(rf.equilibrium).parameters.keys() == {"reaction", "load", "speed"}
    assert pickle.loads(pickle.dumps(rf.equilibrium)) is rf.equilibrium
    with pytest.raises(dataclasses.FrozenInstanceError):
        BEARING.radius = 1.0


def test_what_is_no_quantity_goes_in_as_it_is():
    stations = (("one", -0.1), ("two", 0.1))
    given = {**given_to(next(one for one in MADE if isinstance(one, rf.RigidShaft))), "stations": stations}
    assert rf.RigidShaft(**given).stations == stations
    speeds = np.array([1.0, 2.0])
    assert rf.SpeedProfile(times=speeds, speeds=speeds).times == (1.0, 2.0)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"radius": 50.0, "length": 30.0}, "radius should be 1e-05 to 5 m, got 50: 50 mm?"),
        ({"radius": 50, "length": 30.0}, "radius should be 1e-05 to 5 m, got 50: 50 mm?"),
        ({"radius": "50 m", "length": 30.0}, "radius should be 1e-05 to 5 m, got 50: 50 mm?"),
        ({"diameter": 100.0, "length": 30.0}, "radius should be 1e-05 to 5 m, got 50: 50 mm?"),
        (
            {"radius": 0.05, "viscosity": 5000.0},
            "viscosity should be 0 to 10 Pa s, got 5000: 5000 mPa s?",
        ),
        ({"clearance": 1e-9}, "clearance should be 1e-08 to 0.01 m, got 1e-09"),
    ],
)
@pytest.mark.filterwarnings("ignore:clearance / radius", "ignore:length should")
def test_a_size_that_is_not_built_is_another_unit(wrong, message):
    given = {**given_to(BEARING), **wrong}
    if "diameter" in wrong:
        del given["radius"]
    with pytest.warns(ValidityWarning) as caught:
        rf.JournalBearing(**given)
    assert message in [str(one.message) for one in caught]


def test_a_shaft_lighter_than_wood_and_inertias_of_no_body_are_warned_of():
    steel = {"young_modulus": 210e9, "shear_modulus": 81e9}
    with pytest.warns(
        ValidityWarning, match=r"density should be at least 500 kg/m3, got 7\.85: 7\.85 g/cm3\?"
    ):
        rf.ElasticMaterial(**steel, density=7.85)
    with pytest.warns(ValidityWarning, match=r"diametral_inertia should be at least half of polar_inertia"):
        rf.Disk(node=0, mass=1.0, diametral_inertia=0.1, polar_inertia=0.9)
    # A massless shaft and a thin disk, without a warning, which would be an error here.
    rf.ElasticMaterial(**steel, density=1e-6)
    rf.Disk(node=0, mass=1.0, diametral_inertia=0.45, polar_inertia=0.9)


def test_sizes_are_known_arguments_in_their_units():
    known = {(name, unit) for one in PUBLIC.values() if callable(one) for name, unit in units_of(one).items()}
    assert {(name, unit) for name, (unit, _, _) in BUILT.items()} <= known
    assert all(least < most for _, least, most in BUILT.values())


def test_zero_and_other_meanings_of_a_name_are_no_odd_size():
    # Without a warning, which would be an error here.
    assert rf.RollingBall(**{**given_to(BALL), "mass": 0.0}).mass == 0.0
    assert rf.RollingBall(**{**given_to(BALL), "speed": 1e-9}).speed == 1e-9
