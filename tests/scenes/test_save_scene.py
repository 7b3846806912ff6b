"""A rotor with its bearings as a scene file and back; bearings with a mass from files of ROSS."""

from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.bearings import FrequencyDependentReaction
from rotorfilm.scenes import scene_of
from rotorfilm.scenes.ross import read_bearing, to_ross

STEEL = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
ROTOR = rf.ShaftRotor(
    elements=rf.ShaftElement(length=1.2, outer_diameter=0.05, material=STEEL).split(4),
    stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
    disks=(rf.Disk.solid(2, density=7810.0, width=0.07, outer_diameter=0.28), rf.Disk(node=3, mass=1.0)),
    unbalances=(rf.Unbalance(node=2, unbalance=1e-4, unbalance_angle=0.2),),
    probes=(rf.Probe(node=1, name="probe", angle=0.7),),
    speed=100.0,
)
FILM = rf.JournalBearing(
    radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=rf.ReynoldsFilm(cells=(48, 4)),
    grooves=(rf.Groove(center=1.5, width=0.2),),
)  # fmt: skip
SEAL = rf.AnnularSeal(
    radius=0.04, length=0.02, clearance=2e-4, pressure_drop=1e6, viscosity=1e-3, density=1000.0
)
SPRING = rf.LinearBearing(stiffness=((1e7, 2e5), (0.0, 9e6)), damping=1e4)


@pytest.mark.parametrize("bearing", [FILM, SEAL, SPRING], ids=lambda one: type(one).__name__)
def test_a_rotor_and_its_bearings_come_back_from_a_file(bearing, tmp_path):
    scene = scene_of(ROTOR, {"left": bearing, "right": SPRING}, np.linspace(100.0, 400.0, 7), "saved")
    again = rf.Scene.load(scene.save(tmp_path / "rotor.toml"))
    assert again.title == "saved"
    assert again.shaft.build(speed=again.speed) == ROTOR
    assert again.shaft.build_bearings() == {"left": bearing, "right": SPRING}
    np.testing.assert_allclose(again.shaft.speeds.build(), np.linspace(100.0, 400.0, 7))


def test_what_a_file_cannot_hold_is_refused(tmp_path):
    pads = rf.TiltingPadBearing(
        radius=0.05, length=0.03, pad_clearance=1e-4, viscosity=0.1, preload=0.3, extent=1.0,
        pivots=rf.even_pivots(5),
    )  # fmt: skip
    with pytest.raises(rf.InputError, match=r"bearings\['left'\] must be a JournalBearing.*mount") as caught:
        scene_of(ROTOR, {"left": pads, "right": SPRING}, [100.0, 200.0])
    assert "got TiltingPadBearing; tilting pads, lobes" in str(caught.value)
    with pytest.raises(rf.InputError, match=r"shaft\.gravity is no known key"):
        scene_of(replace(ROTOR, gravity=(0.0, 0.0)), {"left": FILM, "right": SPRING}, [100.0, 200.0])
    with pytest.raises(rf.InputError, match=r"bearings\['left'\] must be one that a scene file can describe"):
        scene_of(ROTOR, {"left": replace(SEAL, added_mass=False), "right": SPRING}, [100.0, 200.0])
    for bearings in ({"left": FILM}, {"left": FILM, "right": SPRING, "third": SPRING}):
        with pytest.raises(rf.InputError, match="bearings must be one for each station"):
            scene_of(ROTOR, bearings, [100.0, 200.0])
    for speeds in ([100.0, 200.0, 500.0], [], [[1.0]]):
        with pytest.raises(rf.InputError, match="speeds must be an even list"):
            scene_of(ROTOR, {"left": FILM, "right": SPRING}, speeds)
    with pytest.raises(rf.InputError, match="speed is required for an AnnularSeal"):
        to_ross(SEAL, 0)
    made = scene_of(ROTOR, {"left": FILM, "right": SPRING}, [100.0, 200.0])
    with pytest.raises(rf.InputError, match=r"scene must come from Scene\.load"):
        replace(made, title="in Python").save(tmp_path / "scene.toml")


@pytest.mark.closed_form
def test_a_bearing_of_ross_with_mass_shakes_a_journal_as_k_c_and_m_do():
    """At exp(s t) the force is -(K + s C + s^2 M) q."""
    found = read_bearing("seal", {"kxx": 2e6, "kxy": 1e5, "kyx": -1e5, "cxx": 300.0, "mxx": 5.0, "myy": 6.0})
    assert isinstance(found, FrequencyDependentReaction)
    at = rf.coefficients(found, [0.0, 0.0], 100.0, 80.0)
    np.testing.assert_allclose(
        at.stiffness + 80j * at.damping,
        [[2e6 + 24e3j - 6400.0 * 5.0, 1e5], [-1e5, 2e6 + 24e3j - 6400.0 * 6.0]],
    )


@pytest.mark.closed_form
def test_the_receptance_of_a_turning_rotor_is_that_of_its_unbalance_and_is_reciprocal_at_rest():
    """At the frequency of the speed an unbalance is a forward force u w^2 (1, -i); K is symmetric at rest."""
    springs = dict.fromkeys(("left", "right"), rf.LinearBearing(stiffness=1e7, damping=1e4))
    rotor = replace(
        ROTOR, unbalances=(rf.Unbalance(node=2, unbalance=1e-4),), probes=(rf.Probe(node=1, name="p"),)
    )
    speeds = np.array([150.0, 300.0])
    wanted = rf.unbalance_response(rotor, springs, speeds)
    row = wanted.output_labels.index("p_x")
    for k, speed in enumerate(speeds):
        found = rf.analysis.receptance(rotor, springs, speed, [speed], [1, 2])
        assert found.input_labels == ["node_1_force_x", "node_1_force_y", "node_2_force_x", "node_2_force_y"]
        moved = found.frdata[0, 2:4, 0] @ (1e-4 * speed**2 * np.array([1.0, -1j]))
        assert moved == pytest.approx(wanted.frdata[row, 0, k], rel=1e-7)
    still = rf.analysis.receptance(rotor, springs, 0.0, [50.0, 200.0], [1, 3]).frdata
    np.testing.assert_allclose(still, still.transpose(1, 0, 2), rtol=1e-9, atol=1e-16)


@pytest.mark.closed_form
def test_probes_at_an_angle_see_the_orbit_on_turned_axes():
    springs = dict.fromkeys(("left", "right"), SPRING)
    rotors = [replace(ROTOR, probes=(rf.Probe(node=1, name="p", angle=angle),)) for angle in (0.0, 0.7)]
    plain, turned = (rf.unbalance_response(one, springs, [200.0]) for one in rotors)
    first = plain.output_labels.index("p_x")
    x, y = plain.frdata[first : first + 2, 0, 0]
    cos, sin = np.cos(0.7), np.sin(0.7)
    np.testing.assert_allclose(turned.frdata[first : first + 2, 0, 0], [cos * x + sin * y, cos * y - sin * x])


def test_bearings_of_a_saved_rotor_stay_as_turbulent_as_they_are(tmp_path):
    thin = replace(FILM, viscosity=1e-3, grooves=())
    held = {"left": thin, "right": replace(thin, turbulence=rf.bearings.Turbulence(closure="hirs"))}
    scene = scene_of(ROTOR, held, np.linspace(1000.0, 4000.0, 7))
    assert scene.shaft.build_bearings() == held
    assert rf.Scene.load(scene.save(tmp_path / "rotor.toml")).shaft.build_bearings() == held
