"""Rotors saved by ROSS."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm.bearings import LinearBearing, TabulatedBearing
from rotorfilm.errors import InputError
from rotorfilm.linear import rotor_modes
from rotorfilm.scenes import read_ross

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
        ([element(0, 0, odr=0.06)], "idl, odl must be idr, odr: a cylinder, got a taper"),
        ([element(0, 0, "axial_force = 5.0\n")], "axial_force must be 0, got 5.0"),
        ([element(0, 0, "gyroscopic = false\n")], "gyroscopic must be true, got False"),
        ([element(0, 0), element(1, 2)], "must have a ShaftElement at every node, got none at node 1"),
        ([disk(0, 0, 0.3)], "must have a ShaftElement, got none"),
        ([element(0, 0), bearing(0, 0, "kxx = 1.0\ncxx = 0\nn_link = 7\n")], "n_link must be absent, got 7"),
        ([element(0, 0), bearing(0, 0, "kxx = 1.0\ncxx = 0\nmyy = 3.0\n")], "mxx, mxy, myx, myy must be 0"),
        ([element(0, 0), bearing(0, 0, "kxx = [1.0, 2.0]\ncxx = 0\n")], "frequency must go with"),
        ([element(0, 0), '["PointMass_Mass"]\nn = 0\n'], "'PointMass_Mass' must be a shaft element, a disk"),
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
