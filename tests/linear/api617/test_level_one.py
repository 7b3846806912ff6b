"""Stability with applied cross-coupling, as API 617 screens compressors."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.analysis.api617 import border_ratio, in_region_b, screened

MASS, LENGTH, DIAMETER, SPEED = 400.0, 1.2, 0.11, 1200.0
STIFFNESS, DAMPING = 6e7, 1.2e5
LIGHT = rf.ElasticMaterial(young_modulus=2e11, shear_modulus=8e10, density=0.01)
SHAFT = 48.0 * LIGHT.young_modulus * math.pi * DIAMETER**4 / 64.0 / LENGTH**3
HEAVY = MASS

IMPELLER = rf.analysis.Impeller(
    power="700 kW", diameter="400 mm", width="12 mm", suction_density=20.0, discharge_density=30.0
)


@dataclass(frozen=True)
class OwnStage:
    """A stage whose cross-coupling is known."""

    known: float

    def cross_coupling(self, speed):
        return self.known


def jeffcott(**changes):
    piece = rf.ShaftElement(
        length=LENGTH, outer_diameter=DIAMETER, material=LIGHT, shear_coefficient=math.inf
    )
    stations = (rf.Station(node=0, name="left"), rf.Station(node=2, name="right"))
    rotor = rf.ShaftRotor(
        elements=piece.split(2),
        disks=(rf.Disk(node=1, mass=MASS),),
        stations=stations,
        speed=SPEED,
        beam=rf.ClassicalBeam(),
    )
    return replace(rotor, **changes)


def springs(stiffness=STIFFNESS, damping=DAMPING):
    return dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=stiffness, damping=damping))


def whirl(cross_coupling):
    """Return the forward whirl of a mass on a shaft in series with two bearings, cleared of fractions."""
    bearings = np.array([2.0 * DAMPING, 2.0 * STIFFNESS])
    held = np.polyadd(
        np.polymul([HEAVY, 0.0, -1j * cross_coupling], np.polyadd(bearings, [SHAFT])), SHAFT * bearings
    )
    roots = np.roots(held)
    return roots[np.argmax(roots.imag)]


def decrement(cross_coupling):
    value = whirl(cross_coupling)
    return -2.0 * math.pi * value.real / value.imag


@pytest.fixture(scope="module")
def found():
    return rf.stability_level_one(jeffcott(), {"as built": springs()}, SPEED, [IMPELLER])


@pytest.mark.closed_form
def test_decrement_over_cross_coupling_of_a_mass_on_a_shaft(found):
    (curve,) = found.curves
    wanted = [decrement(q) for q in curve.cross_coupling]
    assert curve.log_decrement == pytest.approx(wanted, abs=1e-7)
    assert curve.frequency == pytest.approx([whirl(q).imag for q in curve.cross_coupling], rel=1e-7)
    assert found.anticipated_decrement == pytest.approx(decrement(IMPELLER.cross_coupling(SPEED)), abs=1e-7)


@pytest.mark.closed_form
def test_cross_coupling_at_the_decrement_of_zero(found):
    """At i w the real part of the dynamic stiffness vanishes; the imaginary part is the cross-coupling."""
    from scipy.optimize import brentq

    def held(w):
        bearings = 2.0 * (STIFFNESS + 1j * w * DAMPING)
        return SHAFT * bearings / (SHAFT + bearings) - HEAVY * w**2

    w = brentq(lambda w: held(w).real, 1.0, 2.0 * math.sqrt(SHAFT / HEAVY))
    assert found.zero_cross_coupling == pytest.approx(held(w).imag, rel=1e-7)
    assert found.curves[0].log_decrement[-1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.closed_form
def test_critical_speed_ratio_on_rigid_supports(found):
    rigid = math.sqrt(SHAFT / HEAVY)
    assert rf.analysis.rigid_support_speed(jeffcott()) == pytest.approx(rigid, rel=1e-7)
    assert found.critical_speed_ratio == pytest.approx(SPEED / rigid, rel=1e-7)


@pytest.mark.closed_form
def test_rigid_supports_of_a_gyroscopic_uniform_shaft():
    """Forward whirl with rotary inertia, no shear, w = speed: (1 - r^2 b^2) w^2 = b^4 EI / (rho A)."""
    steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
    piece = rf.ShaftElement(length=1.0, outer_diameter=0.1, material=steel, shear_coefficient=math.inf)
    ends = (rf.Station(node=0, name="a"), rf.Station(node=12, name="b"))
    rotor = rf.ShaftRotor(elements=piece.split(12), stations=ends, speed=0.0, beam=rf.ClassicalBeam())
    b, r = math.pi, 0.1 / 4.0
    wanted = b**2 * math.sqrt(steel.young_modulus * r**2 / steel.density / (1.0 - (r * b) ** 2))
    assert rf.analysis.rigid_support_speed(rotor) == pytest.approx(wanted, rel=1e-5)


@pytest.mark.literature
def test_anticipated_cross_coupling_in_published_units():
    """API 617: C = 9.55 for N m/s, mm, rpm and kN/mm; 63 for hp, in, rpm and klbf/in."""
    si = rf.analysis.Impeller(
        power="700 kW", diameter="400 mm", width="12 mm", suction_density=20.0, discharge_density=30.0
    )
    wanted = 3.0 * 700e3 * 9.55 / (400.0 * 12.0 * 11000.0) * 30.0 / 20.0 * 1e6
    assert si.cross_coupling(11000.0 * math.pi / 30.0) == pytest.approx(wanted, rel=1e-4)
    us = rf.analysis.Impeller(
        power="940 hp",
        diameter="15.75 in",
        width="0.47 in",
        suction_density="1.25 lb/ft3",
        discharge_density="1.9 lb/ft3",
    )
    kip_per_inch = 4448.2216 / 0.0254
    wanted = 3.0 * 940.0 * 63.0 / (15.75 * 0.47 * 11000.0) * 1.9 / 1.25 * kip_per_inch
    assert us.cross_coupling(11000.0 * math.pi / 30.0) == pytest.approx(wanted, rel=5e-4)
    blades = rf.analysis.AxialStage(power="500 kW", diameter="600 mm", height="80 mm")
    wanted = 1.5 * 500e3 * 9.55 / (600.0 * 80.0 * 11000.0) * 1e6
    assert blades.cross_coupling(-11000.0 * math.pi / 30.0) == pytest.approx(wanted, rel=1e-4)


@pytest.mark.literature
def test_wachel_is_api_for_a_molecular_weight_of_thirty():
    given = {
        "power": 7e5,
        "diameter": 0.4,
        "width": 0.012,
        "suction_density": 20.0,
        "discharge_density": 30.0,
    }
    light = rf.analysis.Impeller.wachel(**given, molecular_weight=18.0)
    # Wachel & von Nimitz (1981): 6300 hp MW / (D h N) rho_d / rho_s [lbf/in], D and h in inches
    hp, inch = 7e5 / 745.69987, 1.0 / 0.0254
    wanted = 6300.0 * hp * 18.0 / (0.4 * inch * 0.012 * inch * 9000.0) * 1.5 * 4.4482216 / 0.0254
    assert light.cross_coupling(300.0 * math.pi) == pytest.approx(wanted, rel=5e-4)
    heavy = rf.analysis.Impeller.wachel(**given, molecular_weight=30.0)
    assert heavy == rf.analysis.Impeller(**given)


@pytest.mark.literature
def test_border_of_region_b():
    """The figure of API 617, as ROSS reads it too: -.0115 density + 2.69 from 16.53 to 60 kg/m3."""
    assert border_ratio(5.0) == 2.5
    assert border_ratio(40.0) == pytest.approx(-0.0115 * 40.0 + 2.69, abs=2e-3)
    assert in_region_b(1.1, 61.0)
    assert not in_region_b(2.49, 16.0)


@pytest.mark.parametrize(
    ("margin", "least", "ratio", "density", "reasons"),
    [
        (11.0, 0.2, 4.0, 80.0, []),
        (9.0, 0.2, 2.4, 10.0, []),
        (9.0, 0.2, 2.6, 10.0, ["region B"]),
        (1.9, 0.2, 1.0, 10.0, ["below 2"]),
        (11.0, 0.09, 1.0, 10.0, ["delta_A"]),
        (1.5, 0.01, 1.0, 10.0, ["delta_A", "below 2"]),
        (1.5, 0.2, 9.0, None, []),
    ],
)
def test_criteria(margin, least, ratio, density, reasons):
    said = list(screened(margin, least, ratio, density))
    assert len(said) == len(reasons)
    assert all(reason in text for reason, text in zip(reasons, said, strict=True))


def test_verdict_takes_the_worst_of_the_clearances(found):
    soft = springs(damping=0.2 * DAMPING)
    both = rf.stability_level_one(jeffcott(), {"minimum": springs(), "maximum": soft}, SPEED, [IMPELLER])
    assert both.zero_cross_coupling == min(curve.zero_cross_coupling for curve in both.curves)
    assert both.anticipated_decrement == both.curves[1].anticipated_decrement < found.anticipated_decrement
    assert both.level_two_required
    assert "level II is required" in both.verdict


@pytest.mark.closed_form
def test_rotation_the_other_way_round(found):
    back = rf.stability_level_one(jeffcott(), {"as built": springs()}, -SPEED, [IMPELLER])
    assert back.zero_cross_coupling == pytest.approx(found.zero_cross_coupling, rel=1e-9)
    assert back.anticipated_decrement == pytest.approx(found.anticipated_decrement, rel=1e-9)


def test_shares_of_two_nodes_are_scaled():
    two = {0: 3.0, 1: 1.0}
    one = rf.stability_level_one(jeffcott(), {"a": springs()}, SPEED, [IMPELLER], nodes=two)
    assert one.nodes == {"0": 0.75, "1": 0.25}
    far = rf.stability_level_one(jeffcott(), {"a": springs()}, SPEED, [IMPELLER], nodes={1: 7.0})
    assert one.zero_cross_coupling > far.zero_cross_coupling


def test_a_rotor_that_whirls_by_itself():
    kinds = springs(stiffness=((STIFFNESS, 2e8), (-2e8, STIFFNESS)))
    found = rf.stability_level_one(jeffcott(), {"a": kinds}, SPEED, [IMPELLER])
    assert found.zero_cross_coupling == 0.0
    assert found.anticipated_decrement < 0.0
    assert found.level_two_required


@pytest.mark.closed_form
def test_level_two():
    built = jeffcott(stations=(*jeffcott().stations, rf.Station(node=1, name="seal")))
    q = IMPELLER.cross_coupling(SPEED)
    seal = rf.LinearBearing(stiffness=((0.0, q), (-q, 0.0)))
    found = rf.stability_level_two(built, springs() | {"seal": seal}, SPEED)
    assert found.log_decrement == pytest.approx(decrement(q), abs=1e-6)
    assert found.acceptable
    assert decrement(q) > 0.1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"cases": {}}, "cases must hold at least one"),
        ({"stages": []}, "stages must be at least one"),
        ({"speed": 0.0}, "speed| must be finite and positive"),
        ({"nodes": {}}, "nodes must name at least one node"),
        ({"nodes": {1: -1.0}}, r"nodes\[1\] must be finite and positive"),
        ({"nodes": {9: 1.0}}, "node 0 to 2"),
        ({"average_density": math.nan}, "average_density must be finite and positive"),
        ({"average_density": -1.0}, "average_density must be finite and positive"),
        ({"stage_speed": 0.0}, r"\|stage_speed\| must be finite and positive"),
        (
            {"stages": [OwnStage(0.0)], "average_density": 5.0},
            "anticipated cross-coupling of all stages must",
        ),
        ({"stages": [OwnStage(math.nan)], "average_density": 5.0}, "anticipated cross-coupling of all"),
        ({"stages": [OwnStage(1e6)]}, "average_density must be given"),
        ({"supports": ["middle"]}, r"supports must be among \['left', 'right'\], got \['middle'\]"),
    ],
)
def test_bad_input(change, message):
    given = {"rotor": jeffcott(), "cases": {"a": springs()}, "speed": SPEED, "stages": [IMPELLER]} | change
    with pytest.raises(rf.InputError, match=message):
        rf.stability_level_one(**given)


def test_a_stage_must_be_positive_and_compress():
    with pytest.raises(rf.InputError, match="power must be finite and positive"):
        replace(IMPELLER, power=-1.0)
    with pytest.raises(rf.InputError, match="discharge_density must be at least"):
        replace(IMPELLER, discharge_density=0.01)


def test_no_node_near_the_middle_is_warned_of():
    piece = rf.ShaftElement(length=1.0, outer_diameter=0.1, material=LIGHT)
    uneven = (replace(piece, length=0.4), replace(piece, length=0.8))
    with pytest.warns(rf.ValidityWarning, match="mid-span"):
        rf.stability_level_one(jeffcott(elements=uneven), {"a": springs()}, SPEED, [IMPELLER])


@pytest.mark.closed_form
def test_rigid_supports_of_many_elements():
    few = jeffcott()
    ends = (rf.Station(node=0, name="left"), rf.Station(node=240, name="right"))
    many = rf.ShaftRotor(
        elements=few.elements[0].split(120) * 2,
        disks=(rf.Disk(node=120, mass=MASS),),
        stations=ends,
        speed=0.0,
        beam=few.beam,
    )
    assert rf.analysis.rigid_support_speed(many) == pytest.approx(
        rf.analysis.rigid_support_speed(few), rel=1e-6
    )


def test_one_rigid_bearing_does_not_hold_a_rotor():
    with pytest.raises(rf.InputError, match="stations must hold the rotor"):
        rf.analysis.rigid_support_speed(jeffcott(stations=(rf.Station(node=1, name="left"),)))


def test_level_two_refuses_what_else_grows():
    """A bearing that drives whirl against the rotation: the first forward whirl is damped all the more."""
    against = springs(stiffness=((STIFFNESS, -2e8), (2e8, STIFFNESS)))
    found = rf.stability_level_two(jeffcott(), against, SPEED)
    assert found.log_decrement > 0.1
    assert not found.acceptable
    assert found.verdict.startswith("not acceptable: final log decrement")
    assert "another whirl, of " in found.verdict
    assert found.verdict.endswith("grows at 1200 rad/s")


def test_a_stage_of_ones_own_is_judged_by_margin_and_density(found):
    """The same cross-coupling, but below half of Q0: a criterion of centrifugal compressors."""
    own = OwnStage(0.6 * found.zero_cross_coupling)
    given = jeffcott(), {"as built": springs()}, SPEED, [own]
    assert "Q0/QA = 1.67, below 2" in rf.stability_level_one(*given, average_density=5.0).verdict


@pytest.mark.closed_form
def test_a_seal_is_no_rigid_support(found):
    """A seal in the middle leaves the critical speed ratio and mid-span what the bearings make them."""
    sealed = jeffcott(
        stations=(*jeffcott().stations, rf.Station(node=1, name="seal"), rf.Station(node=2, name="end"))
    )
    seal = rf.AnnularSeal(
        radius="60 mm",
        length="25 mm",
        clearance="0.6 mm",
        pressure_drop="6 bar",
        viscosity="1 mPa s",
        density=1000.0,
        added_mass=False,
    )
    cases = {"as built": springs() | {"seal": seal, "end": seal}}
    one = rf.stability_level_one(sealed, cases, SPEED, [IMPELLER])
    assert one.critical_speed_ratio == pytest.approx(SPEED / math.sqrt(SHAFT / HEAVY), rel=1e-7)
    assert one.nodes == {"1": 1.0}
    lumped = {"as built": springs() | dict.fromkeys(("seal", "end"), rf.LinearBearing(stiffness=1e5))}
    named = rf.stability_level_one(sealed, lumped, SPEED, [IMPELLER], supports=["left", "right"])
    assert named.critical_speed_ratio == pytest.approx(found.critical_speed_ratio, rel=1e-9)
