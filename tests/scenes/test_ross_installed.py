"""Files that ROSS itself writes, and rotors that ROSS computes: needs the extra `ross`, 2.3.0 or 3.1.0."""

import warnings
from dataclasses import replace
from inspect import signature
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotorfilm import InputError, LinearBearing, TabulatedBearing
from rotorfilm.analysis import (
    coefficient_table,
    critical_speed_map,
    critical_speeds,
    rotor_equilibrium,
    rotor_modes,
    simulate,
    unbalance_response,
)
from rotorfilm.analysis.closed_loop import second_order
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.rotors import Probe, Unbalance, mount, reduce_rotor
from rotorfilm.scenes import read_ross, read_ross_bearings, to_ross, to_ross_force

with warnings.catch_warnings():
    warnings.simplefilter("ignore")  # of ROSS and what it imports
    ross = pytest.importorskip("ross")

pytestmark = pytest.mark.filterwarnings("ignore")

AXIS = "speed" if "speed" in signature(ross.BearingElement).parameters else "frequency"
SPEED = 4000 * np.pi / 30
COEFFICIENTS = {
    "kxx": 1e6, "kyy": 8e5, "kxy": 2e5, "kyx": -3e5, "cxx": 300.0, "cyy": 400.0, "cxy": 20.0, "cyx": -10.0,
}  # fmt: skip
SPEEDS = np.array([50.0, 150.0, 300.0, 450.0, 600.0])


def steel():
    return ross.Material("Steel", rho=7810, E=211e9, G_s=81.2e9)


def shaft(pieces=6, **changes):
    size = {"L": 1.5 / pieces, "idl": 0.0, "odl": 0.05} | changes
    return [ross.ShaftElement(material=steel(), n=k, **size) for k in range(pieces)]


def disks():
    size = {"material": steel(), "width": 0.07, "i_d": 0.05}
    return [
        ross.DiskElement.from_geometry(n=2, o_d=0.28, **size),
        ross.DiskElement.from_geometry(n=4, o_d=0.35, **size),
    ]


def bearings(last=6, **changes):
    return [ross.BearingElement(n=n, **(COEFFICIENTS | changes)) for n in (0, last)]


def over_speed():
    table = {key: value * (1 + 1e-3 * SPEEDS) for key, value in COEFFICIENTS.items()}
    return [ross.BearingElement(n=n, **{AXIS: SPEEDS}, **table) for n in (0, 6)]


def cones():
    ends = np.linspace(0.04, 0.07, 7)
    bores = np.linspace(0.0, 0.02, 7)
    return [
        ross.ShaftElement(
            L=0.25, odl=ends[k], odr=ends[k + 1], idl=bores[k], idr=bores[k + 1], material=steel(), n=k
        )
        for k in range(6)
    ]


def on_supports():
    ground = {"kxx": 2e7, "kyy": 3e7, "cxx": 1e3, "cyy": 2e3}
    return ross.Rotor(
        shaft(),
        disks(),
        [
            ross.BearingElement(n=0, n_link=7, **COEFFICIENTS),
            ross.BearingElement(n=7, tag="pedestal", **ground),
            ross.BearingElement(n=6, tag="far", **COEFFICIENTS),
        ],
        [ross.PointMass(n=7, m=12.0)],
    )


def coupled():
    middle = ross.CouplingElement(
        m_l=3.0, m_r=4.0, Ip_l=0.02, Ip_r=0.03, kt_x=1e8, kt_y=1e8, kr_x=2e4, kr_y=2e4, n=3
    )
    pieces = shaft()
    pieces[3] = middle
    more = [ross.BearingElement(n=n, kxx=5e7, cxx=0.0) for n in (3, 4)]
    return ross.Rotor(pieces, disks(), [*bearings(), *more])


ROTORS = {
    "cross-coupled": lambda: ross.Rotor(shaft(), disks(), bearings()),
    "hollow": lambda: ross.Rotor(shaft(idl=0.03), disks(), bearings()),
    "no shear": lambda: ross.Rotor(shaft(shear_effects=False), disks(), bearings()),
    "tension": lambda: ross.Rotor(shaft(axial_force=1e5), disks(), bearings()),
    "compression": lambda: ross.Rotor(shaft(axial_force=-1e4), disks(), bearings()),
    "torque": lambda: ross.Rotor(shaft(torque=5e4), disks(), bearings()),
    "tapered": lambda: ross.Rotor(cones(), disks(), bearings()),
    "supports": on_supports,
    "coupling": coupled,
    "proportional elements": lambda: ross.Rotor(shaft(alpha=8.0501, beta=1e-5), disks(), bearings()),
    "table": lambda: ross.Rotor(shaft(), disks(), over_speed()),
}


def theirs(rotor, speed):
    """Return the eigenvalues that ROSS has, of bending only, with a positive imaginary part."""
    n = rotor.ndof
    keep = np.setdiff1d(np.arange(n), [*range(2, n, 6), *range(5, n, 6)])
    if rotor.point_mass_elements:  # their nodes have three coordinates, x, y, z
        base = 6 * (max(e.n for e in rotor.shaft_elements) + 2)
        keep = np.setdiff1d(np.arange(n), [*range(2, base, 6), *range(5, base, 6), *range(base + 2, n, 3)])
    M, K = rotor.M(speed), rotor.K(speed)
    C = rotor.C(speed) + rotor.G() * speed
    M, K, C = (matrix[np.ix_(keep, keep)] for matrix in (M, K, C))
    size = len(M)
    A = np.block([[np.zeros((size, size)), np.eye(size)], [-np.linalg.solve(M, np.hstack([K, C]))]])
    roots = np.linalg.eigvals(A)
    return np.sort_complex(roots[roots.imag > 1e-3].imag * 1j + roots[roots.imag > 1e-3].real)


def ours(file, speed):
    found = read_ross(file)
    modes = rotor_modes(found.rotor, found.bearings, speed)
    return found, np.sort_complex(modes.eigenvalues)


def nearest(values, wanted):
    """Return of `values` the one nearest to each wanted, each used once."""
    left = list(values)
    return np.array([left.pop(int(np.argmin(np.abs(np.array(left) - w)))) for w in wanted])


@pytest.mark.parametrize("suffix", ["toml", "json"])
@pytest.mark.parametrize("name", ROTORS)
def test_eigenvalues_are_those_of_ross(tmp_path, name, suffix):
    """All of them, damping and all, from the file that ROSS saved; both solve the same matrices."""
    rotor = ROTORS[name]()
    file = tmp_path / f"rotor.{suffix}"
    rotor.save(file)
    for speed in (SPEEDS[0], SPEEDS[3]):  # at speeds of the table: ROSS has another spline between them
        wanted = theirs(rotor, speed)
        _, found = ours(file, speed)
        assert len(found) == len(wanted)
        slow = wanted[np.abs(wanted) < 2e4]
        assert len(slow) >= 8
        assert_allclose(nearest(found, slow), slow, rtol=2e-9)


@pytest.mark.skipif("alpha" not in signature(ross.Rotor).parameters, reason="of ROSS 3.1")
@pytest.mark.parametrize("name", ["supports", "coupling"])
def test_proportional_damping_of_the_whole_rotor(tmp_path, name):
    """That of ROSS's own matrices, those of disks, flanges and housings included."""
    bare = ROTORS[name]()
    parts = bare.shaft_elements, bare.disk_elements, bare.bearing_elements, bare.point_mass_elements
    rotor = ross.Rotor(*parts, alpha=8.0501, beta=1e-5)
    rotor.save(tmp_path / "rotor.toml")
    wanted = theirs(rotor, SPEEDS[0])
    slow = wanted[np.abs(wanted) < 2e4]
    assert len(slow) >= 8
    assert_allclose(nearest(ours(tmp_path / "rotor.toml", SPEEDS[0])[1], slow), slow, rtol=2e-9)


@pytest.mark.parametrize("name", ["cross-coupled", "supports", "torque"])
def test_modal_analysis_of_ross_itself(tmp_path, name):
    """Through its own `run_modal`, damped frequency and logarithmic decrement of the lowest modes."""
    rotor = ROTORS[name]()
    file = tmp_path / "rotor.toml"
    rotor.save(file)
    modal = rotor.run_modal(SPEED, num_modes=16)
    found = read_ross(file)
    modes = rotor_modes(found.rotor, found.bearings, SPEED)
    for frequency, decrement in zip(modal.wd[:4], modal.log_dec[:4], strict=True):
        k = int(np.argmin(np.abs(modes.frequency - frequency)))
        assert modes.frequency[k] == pytest.approx(frequency, rel=1e-6)
        # ROSS has 2 pi z / sqrt(1 - z^2), which is -2 pi Re / Im
        assert modes.log_decrement[k] == pytest.approx(decrement, rel=1e-4)


@pytest.mark.parametrize("file", sorted((Path(ross.__file__).parent / "tests" / "data").glob("*.toml")))
def test_files_that_come_with_ross(file):
    """A compressor of 48 elements, some of them hollow, two bearings and twelve seals over speed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rotor = ross.Rotor.load(file)
    speed = float(np.asarray(getattr(rotor.bearing_elements[0], AXIS))[3])
    found, roots = ours(file, speed)
    assert found.rotor.mass == pytest.approx(rotor.m, rel=1e-12)
    assert len(found.bearings) == len(rotor.bearing_elements)
    wanted = theirs(rotor, speed)
    slow = wanted[np.abs(wanted) < 3e3]
    assert len(slow) >= 6
    # the compressor has layers: ours stay together along their length, those of ROSS at the nodes only
    assert_allclose(nearest(roots, slow), slow, rtol=2e-3)


def test_unbalance_response_is_that_of_ross(tmp_path):
    rotor = ROTORS["cross-coupled"]()
    file = tmp_path / "rotor.toml"
    rotor.save(file)
    grid = np.array([60.0, 85.0, 120.0, 250.0, 400.0])
    answer = rotor.run_unbalance_response(
        2, 1e-3, 0.4, grid
    )  # by place: ROSS 3 has another name for the last
    found = read_ross(file)
    ready = replace(
        found.rotor,
        unbalances=(Unbalance(node=2, unbalance=1e-3, unbalance_angle=0.4),),
        probes=(Probe(node=4, name="large"),),
    )
    response = unbalance_response(ready, found.bearings, grid)
    for axis, place in (("x", 0), ("y", 1)):
        mine = response.complex[response.output_labels.index(f"large_{axis}"), 0]
        assert_allclose(mine, answer.forced_resp[4 * 6 + place], rtol=1e-8)


# Nelson & McVaugh (1976), J. Eng. Ind. 98, 593-600, in cm as a public script has it: places of the nodes,
# inner and outer radii.
PLACES = [0.00, 1.27, 5.08, 7.62, 8.89, 10.16, 10.67, 11.43, 12.70, 13.46, 16.51, 19.05, 22.86, 26.67, 28.70,
          30.48, 31.50, 34.54, 35.81]  # fmt: skip
INNER = [0, 0, 0, 0, 0, 0, 1.52, 1.78, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1.52]
OUTER = [0.51, 1.02, 0.76, 2.03, 2.03, 3.30, 3.30, 2.54, 2.54, 1.27, 1.27, 1.52, 1.52, 1.27, 1.27, 3.81, 2.03,
         2.03]  # fmt: skip


def nelson_mcvaugh(**bearing):
    metal = ross.Material("N", rho=7806, E=2.078e11, Poisson=0.3)
    lengths = np.diff(PLACES) / 100
    return ross.Rotor(
        [
            ross.ShaftElement(L=length, idl=bore / 50, odl=out / 50, material=metal, shear_effects=False)
            for length, bore, out in zip(lengths, INNER, OUTER, strict=True)
        ],
        [ross.DiskElement(n=4, m=1.401, Ip=0.00203, Id=0.00136)],
        [ross.BearingElement(n=n, **bearing) for n in (10, 14)],
    )


@pytest.mark.parametrize(
    "bearing",
    [
        {"kxx": 4.378e7, "cxx": 0.0},
        {"kxx": 3.503e7, "kyy": 3.503e7, "kxy": -8.756e6, "kyx": -8.756e6, "cxx": 1752.0},
    ],
)
def test_critical_speeds_of_the_rotor_of_nelson_and_mcvaugh(tmp_path, bearing):
    """Every crossing with the speed: at each of them ROSS has a mode of that frequency, and no other has."""
    rotor = nelson_mcvaugh(**bearing)
    rotor.save(tmp_path / "rotor.toml")
    found = read_ross(tmp_path / "rotor.toml")
    grid = np.linspace(200.0, 10500.0, 104)
    critical = critical_speeds(found.rotor, found.bearings, grid)
    assert len(critical) == 6
    for one in critical:
        assert np.abs(theirs(rotor, one.speed).imag - one.speed).min() < 1e-6 * one.speed
    slower = [np.sum(theirs(rotor, speed).imag < speed) for speed in grid[[0, -1]]]
    assert slower[1] - slower[0] == len(critical)
    if "kxy" not in bearing:
        forward = [one.speed for one in critical if one.direction > 0.0]
        assert_allclose(forward, critical_speed_map(found.rotor, [4.378e7], count=3)[:, 0], rtol=1e-8)


@pytest.fixture(scope="module")
def film():
    return JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())


@pytest.mark.literature
def test_a_film_in_ross_has_the_axes_of_the_short_bearing_of_ross(film):
    """Friswell et al. (2010), example 5.9.6: their own CylindricalBearing, every entry in its place."""
    speeds = np.array([80.0, 1500 * np.pi / 30, 250.0, 400.0])
    element = to_ross(coefficient_table(film, [0.0, -525.0], speeds), 0, tag="film")
    own = ross.CylindricalBearing(
        n=0, speed=speeds, weight=525.0, bearing_length=0.03, journal_diameter=0.1,
        radial_clearance=1e-4, oil_viscosity=0.1,
    )  # fmt: skip
    for letter in "kc":
        for entry in ("xx", "xy", "yx", "yy"):
            mine = getattr(element, f"{letter}{entry}")
            assert_allclose(mine, getattr(own, f"{letter}{entry}"), rtol=1e-6)
    assert_allclose(
        [element.kxx[1], element.kxy[1], element.kyx[1], element.kyy[1]],
        [12807959, 16393593, -25060393, 8815302],
        rtol=1e-7,
    )


def test_a_rotor_of_ross_on_our_films_is_ours(tmp_path, film):
    """The way out and the way back: eigenvalues of ROSS with the element, of rotorfilm on the film."""
    speeds = np.array([100.0, 140.0, 180.0, 220.0, 260.0])
    plain = ross.Rotor(shaft(), disks(), bearings())
    plain.save(tmp_path / "rotor.toml")
    rotor = read_ross(tmp_path / "rotor.toml").rotor
    names = rotor.structure.stations
    at = rotor_equilibrium(rotor, dict.fromkeys(names, film), float(speeds[2]))
    elements = [
        to_ross(coefficient_table(film, at.loads[name], speeds), node)
        for name, node in zip(names, (0, 6), strict=True)
    ]
    wanted = theirs(ross.Rotor(shaft(), disks(), elements), float(speeds[2]))
    system = second_order(rotor.structure, at)
    roots = np.linalg.eigvals(system.state_matrix())
    slow = wanted[np.abs(wanted) < 2e4]
    # ROSS smooths its tables (UnivariateSpline without s): some N/m, and N s/m, which is 1e-5 of the damping
    assert_allclose(nearest(roots, slow), slow, rtol=2e-5)


@pytest.mark.parametrize("unbalance", [1e-4, 2e-3])
def test_the_time_response_of_ross_with_a_film_is_ours(tmp_path, film, unbalance):
    """Small and large motion: Newmark's method with the film's force beyond K and C, and `simulate`."""
    ross.Rotor(shaft(), disks(), bearings()).save(tmp_path / "rotor.toml")
    found = read_ross(tmp_path / "rotor.toml").rotor
    stations = (replace(found.stations[0], name=""), found.stations[1])
    whole = replace(found, stations=stations, unbalances=(Unbalance(node=2, unbalance=unbalance),))
    small = reduce_rotor(replace(whole, speed=SPEED), frequency=1500.0, tolerance=1e-3).rotor
    names = small.structure.stations
    at = rotor_equilibrium(small, dict.fromkeys(names, film), SPEED)
    rests = {node: at.coefficients[name] for name, node in zip(names, (0, 6), strict=True)}
    elements = [
        to_ross(LinearBearing(stiffness=rest.stiffness, damping=rest.damping), node)
        for node, rest in rests.items()
    ]
    machine = ross.Rotor(shaft(), disks(), elements)
    t = np.linspace(0.0, 0.02, 4001)
    pull = np.zeros((len(t), machine.ndof))
    first = 2 * machine.number_dof
    pull[:, first : first + 2] = unbalance * SPEED**2 * np.stack([np.cos(SPEED * t), np.sin(SPEED * t)], 1)
    beyond = to_ross_force(machine, dict.fromkeys(rests, film), rests)
    full, linear = (
        machine.run_time_response(SPEED, pull, t, method="newmark", **more).yout[:, :2]
        for more in ({"add_to_RHS": beyond}, {})
    )
    start = np.concatenate([at.displacement, np.zeros(len(at.displacement))])
    turning = mount(replace(small, initial=tuple(start.tolist())), {names[1]: film})
    mine = (
        simulate(turning, film, duration=float(t[-1]), times=t[::40], rtol=1e-6).position.T
        - rests[0].position
    )
    size = np.abs(mine).max()
    assert np.abs(full[::40] - mine).max() < 1e-2 * size
    assert (np.abs(linear[::40] - mine).max() > 0.1 * size) == (unbalance > 1e-3)


def test_what_goes_to_ross_comes_back(tmp_path):
    bearing = LinearBearing(stiffness=((1e6, 2e5), (-3e5, 8e5)), damping=((3.0, 1.0), (2.0, 4.0)))
    elements = [to_ross(bearing, n, tag=tag) for n, tag in ((0, "drive end"), (6, "free end"))]
    ross.Rotor(shaft(), disks(), elements).save(tmp_path / "rotor.json")
    assert read_ross(tmp_path / "rotor.json").bearings == {"drive_end": bearing, "free_end": bearing}


def test_what_ross_cannot_take_is_refused(film):
    with pytest.raises(InputError, match="bearing must be a LinearBearing, a TabulatedBearing or a seal"):
        to_ross(film, 0)
    short = TabulatedBearing(speeds=[1.0, 2.0], stiffness=np.ones((2, 2, 2)), damping=np.ones((2, 2, 2)))
    with pytest.raises(InputError, match=r"speeds must be at least 4 numbers, .* got 2"):
        to_ross(short, 0)


def test_a_bearing_alone_comes_back_from_a_file_of_ross(tmp_path):
    matrix, speeds = np.array([[3e6, 1e5], [-2e5, 4e6]]), np.linspace(50.0, 350.0, 4)
    table = TabulatedBearing(
        speeds=speeds,
        stiffness=matrix * np.linspace(1.0, 2.0, 4)[:, None, None],
        damping=1e-4 * np.stack([matrix] * 4),
    )
    given = {"plain": LinearBearing(stiffness=matrix, damping=1e-4 * matrix), "table": table}
    for name, one in given.items():
        to_ross(one, 3, tag=name).save(tmp_path / f"{name}.toml")
        found = read_ross_bearings(tmp_path / f"{name}.toml")
        assert list(found) == [name]
        assert type(found[name]) is type(one)
        for part in ("stiffness", "damping"):
            assert_allclose(getattr(found[name], part), getattr(one, part), rtol=1e-12)
    assert_allclose(found["table"].speeds, speeds)
