"""Rotors saved by ROSS."""

import math
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, LinearBearing, TabulatedBearing
from rotorfilm.analysis import coefficients, rotor_modes
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.scenes import read_ross, read_ross_bearings, to_ross, to_ross_force

STEEL = 'name = "Steel"\nrho = 7810.0\nE = 211e9\nG_s = 81.2e9\n'


def element(number, node, extra="", **changes):
    size = {"L": 0.25, "idl": 0.0, "odl": 0.05, "idr": 0.0, "odr": 0.05} | changes
    numbers = "".join(f"{key} = {value}\n" for key, value in size.items())
    table = (
        f'["ShaftElement_ShaftElement {number}"]\nn = {node}\n{numbers}{extra}shear_method_calc = "cowper"\n'
    )
    return table + f'["ShaftElement_ShaftElement {number}".material]\n{STEEL}'


def disk(number, node, diameter):
    mass = 7810.0 * math.pi / 4 * 0.07 * (diameter**2 - 0.05**2)
    polar = mass * (diameter**2 + 0.05**2) / 8
    diametral = polar / 2 + mass * 0.07**2 / 12
    numbers = f"n = {node}\nm = {mass!r}\nId = {diametral!r}\nIp = {polar!r}\n"
    return f'["DiskElement_Disk {number}"]\n{numbers}'


def bearing(number, node, body="kxx = [ 1e6,]\nkyy = [ 1e6,]\nkxy = [ 0,]\nkyx = [ 0,]\ncxx = [ 0.0,]\n"):
    return f'["BearingElement_Bearing {number}"]\nn = {node}\n{body}mxx = [ 0,]\n'


def written(folder, *parts):
    path = folder / "rotor.toml"
    path.write_text('ross_version = "2.0.0"\n[parameters]\n' + "".join(parts))
    return path


LINKED_TO_2 = bearing(9, 1, "kxx = [ 1e6,]\nkyy = [ 1e6,]\ncxx = [ 0.0,]\nn_link = 2\n")

COUPLING = """["CouplingElement_C"]
n = 1
kt_x = 1.0
kt_y = 1.0
kr_x = 1.0
kr_y = 1.0
m_l = 1.0
m_r = 1.0
Id_l = 0.1
Id_r = 0.1
Ip_l = 0.1
Ip_r = 0.1
"""
LINKED = bearing(0, 0, "kxx = 1.0\ncxx = 0\nn_link = 7\n")
MASS = '["PointMass_M"]\nn = 7\nmx = 1.0\nmy = 1.0\n'


def friswell():
    shaft = [element(k, k) for k in range(6)]
    return [*shaft, disk(0, 2, 0.28), disk(1, 4, 0.35), bearing(0, 0), bearing(1, 6)]


@pytest.mark.literature
def test_friswell_example_591_from_a_file(tmp_path):
    found = read_ross(written(tmp_path, *friswell()), speed=10.0)
    assert list(found.bearings) == ["bearing_0", "bearing_1"]
    assert found.bearings["bearing_0"] == LinearBearing(stiffness=1e6)
    assert found.rotor.speed == 10.0
    modes = rotor_modes(found.rotor, found.bearings, 4000 * math.pi / 30)
    assert_allclose(modes.frequency[:5], [85.39, 87.80, 251.78, 294.71, 600.18], atol=0.007)


# Written by ROSS 2.3.0 (`Rotor.save`) for this test, with the eigenvalues of its `Rotor.run_modal(450.0)`.
SAVED = {
    "ross_supports.toml": (
        [-7.328202 + 119.003329j, 5.275425 + 119.403441j, -65.755401 + 386.434139j, 16.018744 + 430.432194j],
        55.59207636354309,
    ),
    "ross_cone.json": (
        [
            -32.939808 + 243.477938j,
            14.324041 + 243.836372j,
            -157.438225 + 647.743471j,
            -3.508521 + 743.963729j,
        ],
        34.227494881228125,
    ),
}


@pytest.mark.parametrize("name", SAVED)
def test_files_that_ross_wrote(name):
    """A bearing on a pedestal; cones under tension and torque in bearings with a table over speed."""
    found = read_ross(Path(__file__).parent / "data" / name)
    eigenvalues, mass = SAVED[name]
    modes = rotor_modes(found.rotor, found.bearings, 450.0)
    wanted = np.array(eigenvalues)
    found_values = np.array([modes.eigenvalues[np.argmin(np.abs(modes.eigenvalues - w))] for w in wanted])
    assert_allclose(found_values, wanted, atol=1.5e-6)
    assert found.rotor.mass == pytest.approx(mass, rel=1e-12)


def test_json_that_is_none(tmp_path):
    path = tmp_path / "rotor.json"
    path.write_text("{")
    with pytest.raises(InputError, match="must be JSON, got Expecting"):
        read_ross(path)


@pytest.mark.closed_form
def test_layers_are_one_piece_of_shaft(tmp_path):
    """Without shear, whose coefficient is that of each layer, two layers are exactly the thick shaft."""
    stiff = "shear_effects = false\n"
    tube = element(1, 0, stiff, idl=0.05, odl=0.08, idr=0.05, odr=0.08)
    rotor = read_ross(written(tmp_path, element(0, 0, stiff), tube, element(2, 1, stiff))).rotor
    whole = read_ross(written(tmp_path, element(0, 0, stiff, odl=0.08, odr=0.08))).rotor
    assert len(rotor.elements) == 2
    one, other = (r.elements[0].matrices(r.beam) for r in (rotor, whole))
    for found, wanted in zip(one, other, strict=True):
        assert_allclose(found, wanted, rtol=1e-10)
    assert rotor.mass == pytest.approx(7810.0 * math.pi / 4 * 0.25 * (0.08**2 + 0.05**2))


def test_table_over_speed(tmp_path):
    body = "kxx = [1e6, 2e6]\nkxy = [1e5, 3e5]\ncxx = [1e3, 2e3]\nfrequency = [10.0, 30.0]\n"
    found = read_ross(written(tmp_path, element(0, 0), bearing(0, 0, body))).bearings["bearing_0"]
    assert isinstance(found, TabulatedBearing)
    assert_allclose(found.stiffness[1], [[2e6, 3e5], [0.0, 2e6]])
    assert_allclose(found.damping[0], [[1e3, 0.0], [0.0, 1e3]])
    assert_allclose(found.force([1.0, 0.0], [0.0, 0.0], 10.0), [-1e6, 0.0])


def test_shaft_without_shear(tmp_path):
    rotor = read_ross(written(tmp_path, element(0, 0, "shear_effects = false\n"))).rotor
    assert rotor.elements[0].shear_coefficient == math.inf


@pytest.mark.parametrize(
    ("parts", "match"),
    [
        ([element(0, 0, "beta = 5.0\ntorque = 1.0\n")], "beta must be 0 beside an axial force or a torque"),
        (
            [element(0, 0).replace("cowper", "hutchinson")],
            "shear_method_calc must be 'cowper', got 'hutchinson'",
        ),
        (
            [element(0, 0), COUPLING.replace("kt_y = 1", "kt_y = 2")],
            "kt_x must be kt_y, got 1.0 and 2.0 in 'CouplingElement_C': a part that turns",
        ),
        (
            [element(0, 0), disk(0, 1, 0.2) + "Iyy = 0.1\n"],
            "Id and Ip must be numbers and alone, got Iyy = 0.1 in",
        ),
        (
            [element(0, 0), disk(0, 1, 0.2).replace("Id = ", "Id = [0.1, 0.2] # ")],
            r"got Id = \[0.1, 0.2\] in 'DiskElement_Disk 0'",
        ),
        ([element(0, 0), COUPLING + "cr_y = 3.0\n"], "cr_y must be 0, got 3.0"),
        (
            [element(0, 0), element(1, 1), COUPLING],
            "must have no shaft element beside a coupling, got one at node 1",
        ),
        (
            [element(0, 0), LINKED, '["PointMass_M"]\nn = 1\nmx = 1.0\nmy = 1.0\n'],
            "n must be beyond the shaft's nodes",
        ),
        (
            [element(0, 0), LINKED, MASS.replace("my = 1", "my = 2")],
            "mx must be my, got 1.0 and 2.0 .*: a Support has",
        ),
        (
            [element(0, 0), LINKED, MASS],
            "n of one bearing to the ground must be that of 'PointMass_M', got 0",
        ),
        ([element(0, 0, "gyroscopic = false\n")], "gyroscopic must be true, got False"),
        ([element(0, 0), element(1, 2)], "must have a ShaftElement at every node, got none at node 1"),
        ([disk(0, 0, 0.3)], "must have a ShaftElement, got none"),
        ([element(0, 0), LINKED], r"n_link must be the node of a point mass \[\], got 7"),
        (
            [element(0, 0), bearing(0, 0, "kxx = [1.0, 2.0]\ncxx = 0\nmyy = 3.0\n")],
            "mxx, mxy, myx, myy must be 0 beside coefficients over speed",
        ),
        ([element(0, 0), bearing(0, 0, "kxx = [1.0, 2.0]\ncxx = 0\n")], "frequency must go with"),
        (
            [element(0, 0), '["GearElement_Gear"]\nn = 0\n'],
            "'GearElement_Gear' must be a shaft element, a disk",
        ),
        ([element(0, 0), '["DiskElement_Disk"]\nn = 0\n'], "must have the key 'm' in each of its elements"),
        (["]"], "must be TOML"),
    ],
)
def test_what_cannot_be_represented_is_refused(tmp_path, parts, match):
    with pytest.raises(InputError, match=match):
        read_ross(written(tmp_path, *parts))


def test_weight_hangs_along_minus_y(tmp_path):
    rotor = read_ross(written(tmp_path, *friswell())).rotor
    size = len(rotor.structure.coordinates)
    assert not rotor.structure.weight[:size].any()
    assert np.sum(rotor.structure.weight[size:][0:14:2]) == pytest.approx(-9.80665 * rotor.mass)


@pytest.mark.parametrize(
    ("key", "value"), [("modal_damping_ratio", "[0.01, 0.02]"), ("default_damping_ratio", "0.01")]
)
def test_modal_damping_is_refused(tmp_path, key, value):
    file = with_parameters(tmp_path, f"{key} = {value}", element(0, 0), disk(0, 0, 0.2), bearing(0, 1))
    with pytest.raises(
        InputError, match=rf"^{key} must be 0, got {re.escape(value)} among the parameters of"
    ):
        read_ross(file)


def with_parameters(folder, lines, *parts):
    file = folder / "rotor.toml"
    file.write_text(f"[parameters]\n{lines}\n\n" + "".join(parts))
    return file


@pytest.mark.closed_form
def test_proportional_damping_of_the_whole_rotor(tmp_path):
    """alpha M + beta K, disks and the mass of a support included; that of elements does not count beside."""
    mass = '["PointMass_M"]\nn = 2\nmx = 12.0\nmy = 12.0\n'
    ground = bearing(1, 2, "kxx = [ 2e7,]\nkyy = [ 3e7,]\ncxx = [ 1e3,]\ncyy = [ 2e3,]\n")
    parts = [element(0, 0, "alpha = 7.0\n"), disk(0, 0, 0.2), bearing(0, 0), LINKED_TO_2, ground, mass]
    s = read_ross(with_parameters(tmp_path, "alpha = 8.0\nbeta = 1e-5", *parts)).rotor.structure
    bare = read_ross(with_parameters(tmp_path, "alpha = 0.0", element(0, 0), *parts[1:])).rotor.structure
    bending = bare.stiffness.copy()
    bending[4], bending[9] = 0.0, 0.0  # of the support
    assert bare.damping[4, 4] == 1e3
    assert_allclose(s.damping, bare.damping + 8.0 * bare.mass + 1e-5 * bending, rtol=1e-12, atol=1e-12)


@pytest.mark.closed_form
def test_proportional_damping_of_elements(tmp_path):
    """Each has its own, and disks have none: the sum of own matrices."""
    pieces = [element(0, 0, "alpha = 7.0\nbeta = 1e-5\n"), element(1, 1, "beta = 3e-5\n", odl=0.06, odr=0.06)]
    rotor = read_ross(written(tmp_path, *pieces, disk(0, 1, 0.3))).rotor
    first, second = (piece.matrices(rotor.beam) for piece in rotor.elements)
    wanted = np.zeros((12, 12))
    wanted[:4, :4] = wanted[6:10, 6:10] = 7.0 * first.mass + 1e-5 * first.stiffness
    wanted[2:6, 2:6] += 3e-5 * second.stiffness
    wanted[8:12, 8:12] += 3e-5 * second.stiffness
    assert_allclose(rotor.structure.damping, wanted, rtol=1e-12, atol=1e-12)


def test_the_force_beyond_the_linear_one_completes_it():
    """K, C and what is added are the film at any state, on the coordinates of the node alone."""
    film = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
    rest = coefficients(film, [2e-5, -3e-5], 150.0)
    rotor = SimpleNamespace(number_dof=6, ndof=24)
    beyond = to_ross_force(rotor, {2: film}, {2: rest})
    state = np.random.default_rng(4).normal(size=(2, 24)) * np.array([[1e-5], [2e-3]])
    moved, moving = state[:, 12:14]
    added = beyond(7, disp_resp=state[0], velc_resp=state[1], accl_resp=None, time_step=1e-5, args=[])
    assert set(np.flatnonzero(added)) == {12, 13}
    linear = -rest.stiffness @ moved - rest.damping @ moving
    at_rest = film.force(rest.position, np.zeros(2), 150.0)
    assert_allclose(
        added[12:14] + linear + at_rest, film.force(rest.position + moved, moving, 150.0), rtol=1e-12
    )
    assert_allclose(beyond(0, disp_resp=0 * state[0], velc_resp=0 * state[0]), 0.0, atol=1e-9)
    with pytest.raises(InputError, match=r"^rests must have the nodes of the films \[2\], got \[3\]"):
        to_ross_force(rotor, {2: film}, {3: rest})


def test_a_table_over_the_frequency_of_the_whirl_is_refused(tmp_path):
    """ROSS 3 calls `speed` what was `frequency` before."""
    axis = "[ 10.0, 20.0, 30.0, 40.0,]"
    numbers = "[ 1e6, 2e6, 3e6, 4e6,]"
    body = f"kxx = {numbers}\ncxx = {numbers}\n"
    shaft = "".join([element(0, 0), disk(0, 0, 0.2)])
    file = tmp_path / "rotor.toml"
    for head, name in (("", "frequency"), ('ross_version = "3.1.0"\n', "speed")):
        file.write_text(head + shaft + bearing(0, 1, f"{name} = {axis}\n{body}"))
        [found] = read_ross(file).bearings.values()
        assert_allclose(found.speeds, [10.0, 20.0, 30.0, 40.0])
    for head, axes in (('ross_version = "3.1.0"\n', ""), ("", f"speed = {axis}\n")):
        file.write_text(head + shaft + bearing(0, 1, f"{axes}frequency = {axis}\n{body}"))
        with pytest.raises(InputError, match=r"^speed must be the only axis .*, got frequency in 'Bearing"):
            read_ross(file)


def test_a_bearing_of_other_freedoms_is_refused():
    with pytest.raises(InputError, match=r"^bearing must react to x and y alone here, got one of z, tilt_x"):
        to_ross(LinearBearing(stiffness=(1e8, 1e4), freedoms=("z", "tilt_x")), 1)


def test_bearings_alone_are_read_as_with_their_rotor(tmp_path):
    """ROSS adds each bearing that is saved to the file."""
    table = "kxx = [1e6, 2e6]\nkxy = [1e5, 3e5]\ncxx = [1e3, 2e3]\nfrequency = [10.0, 30.0]\n"
    heavy = "kxx = 1e6\ncxx = 50.0\nmxx = 3.0\nmyy = 4.0\n"
    bodies = bearing(0, 0), bearing(1, 1, table), f'["SealElement_Gap seal"]\nn = 0\n{heavy}'
    alone = tmp_path / "bearings.toml"
    alone.write_text("".join(bodies))
    found = read_ross_bearings(alone)
    assert list(found) == ["bearing_0", "bearing_1", "gap_seal"]
    whole = read_ross(written(tmp_path, element(0, 0), *bodies[:2])).bearings
    assert_allclose(whole["bearing_1"].damping, found["bearing_1"].damping)
    assert_allclose(found["bearing_1"].stiffness[1], [[2e6, 3e5], [0.0, 2e6]])
    assert_allclose(found["gap_seal"].added_mass, [[3.0, 0.0], [0.0, 4.0]])
    lone = tmp_path / "lone.json"
    lone.write_text('{"BearingElement_Drive end": {"n": 3, "kxx": [2e6], "cxx": [5e2], "kyy": [3e6]}}')
    assert_allclose(read_ross_bearings(lone)["drive_end"].stiffness, [[2e6, 0.0], [0.0, 3e6]])
    for text, match in (
        ("[]", "must have named elements, got a list"),
        ("{}", "must have a bearing with the coefficient kxx"),
        ('{"BearingElement_A": {"kxx": 1.0}}', "must have the key 'cxx'"),
        ('{"A": {"kxx": [1, 2, 3], "cxx": [1, 2, 3], "kyy": [1, 2]}}', "as many coefficients as speeds"),
        ('{"A": {"kxx": [1, 2], "cxx": [1, 2], "frequency": [1, 2, 3]}}', "as many coefficients as speeds"),
        ('{"A": {"kxx": "stiff", "cxx": 1.0}}', "must have numbers"),
    ):
        lone.write_text(text)
        with pytest.raises(InputError, match=match):
            read_ross_bearings(lone)
