"""Rotors of many elements: few shapes beside all coordinates, critical speeds, changes of stability."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import sparse

from rotorfilm import ConvergenceError, InputError, LinearBearing, TabulatedBearing
from rotorfilm.analysis import (
    campbell,
    critical as crossings,
    critical_speed_map,
    critical_speeds,
    modal_reduction as banded,
    rotor_equilibrium,
    rotor_modes,
    rotor_threshold,
    rotor_transmissibility,
    stability_changes,
    unbalance_response,
)
from rotorfilm.analysis.modal_reduction import (
    TOLERANCE,
    WHOLE,
    BandedCholesky,
    BandedFactor,
    models,
    usual_frequency,
)
from rotorfilm.analysis.rotor_equilibrium import rest
from rotorfilm.analysis.rotor_matrices import FullRotorModel, second_order, seen_rows, whirl_errors
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.rotors import (
    Coupling,
    Disk,
    ElasticMaterial,
    JeffcottRotor,
    Probe,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    TiltSpring,
    Unbalance,
)

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
FILMS = {"left": FILM, "right": FILM}
SPRINGS = dict.fromkeys(FILMS, LinearBearing(stiffness=1e6, damping=50.0))


def long_rotor(count, **changes):
    """The rotor of Friswell et al. (2010), section 5.9, in so many elements, a multiple of three."""
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    small, large = count // 3, 2 * count // 3
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(count),
        "disks": (
            Disk.solid(small, outer_diameter=0.28, **disk),
            Disk.solid(large, outer_diameter=0.35, **disk),
        ),
        "stations": (Station(node=0, name="left"), Station(node=count, name="right")),
        "unbalances": (Unbalance(node=small, unbalance=1e-3, unbalance_angle=0.5),),
        "probes": (Probe(node=large, name="large"),),
        "speed": 0.0,
    }
    return ShaftRotor(**(parts | changes))


def mixed_rotor():
    """A coupling, supports of two stiffnesses and masses, a tilt spring, a torque, three stations."""
    piece = ShaftElement(length=0.9, outer_diameter=0.06, material=STEEL, torque=2e3, axial_force=1e4)
    soft = Support(mass=25.0, stiffness=((3e7, 0.0), (0.0, 9e7)), damping=2e3)
    return ShaftRotor(
        elements=(*piece.split(14), Coupling(stiffness=1e8, tilt_stiffness=1e5), *piece.split(14)),
        disks=(Disk(node=7, mass=20.0, diametral_inertia=0.1, polar_inertia=0.2), Disk(node=22, mass=30.0)),
        stations=(
            Station(node=0, name="left", support=soft),
            Station(node=13, name="middle"),
            Station(node=29, name="right", support=soft),
        ),
        tilt_springs=(TiltSpring(node=29, stiffness=2e4),),
        unbalances=(Unbalance(node=7, unbalance=1e-3), Unbalance(node=22, unbalance=2e-3)),
        internal_damping=2e-6,
        speed=0.0,
    )


CASES = {
    "films": (long_rotor(30), FILMS, 300.0, 1500.0),
    "the other way": (long_rotor(30), FILMS, -300.0, 1500.0),
    "at rest": (long_rotor(30), SPRINGS, 0.0, 3000.0),
    "hysteresis": (long_rotor(30, loss_factor=0.02), SPRINGS, 300.0, 1500.0),
    "free": (long_rotor(30, gravity=(0.0, 0.0)), {}, 200.0, 3000.0),
    "mixed": (
        mixed_rotor(),
        dict.fromkeys(("left", "middle", "right"), LinearBearing(stiffness=[[5e7, 2e7], [-2e7, 8e7]])),
        400.0,
        2000.0,
    ),
}


def all_eigenvalues(rotor, bearings, speed, slower):
    """Return the eigenvalues of all coordinates by numpy, from matrices written here."""
    s = rotor.structure
    at = rest(s, bearings, speed)
    damping, stiffness = s.damping + speed * s.gyroscopic, s.stiffness + speed * s.circulation
    for name, film in at.coefficients.items():
        k = 2 * s.stations.index(name)
        rows = s.journals[k : k + 2]
        damping, stiffness = (
            damping + rows.T @ film.damping @ rows,
            stiffness + rows.T @ film.stiffness @ rows,
        )
    if s.hysteresis is not None:
        n, zero = len(s.coordinates), np.zeros_like(s.hysteresis)
        turned = np.block([[zero, s.hysteresis], [-s.hysteresis, zero]])
        resisting = 1j * np.block([[s.hysteresis, zero], [zero, s.hysteresis]])
        assert turned.shape == (2 * n, 2 * n)
        stiffness = stiffness + (np.sign(speed) * turned if slower else resisting)
    solved = np.linalg.solve(s.mass, np.hstack([stiffness, damping]))
    return np.linalg.eigvals(np.vstack([np.eye(len(s.mass), 2 * len(s.mass), len(s.mass)), -solved]))


@pytest.mark.closed_form
@pytest.mark.parametrize("case", CASES)
def test_whirls_in_few_shapes_are_those_of_all_coordinates(case):
    rotor, bearings, speed, highest = CASES[case]
    assert len(rotor.assembly.weight) > WHOLE
    modes = rotor_modes(rotor, bearings, speed, highest)
    slow, fast = (all_eigenvalues(rotor, bearings, speed, slower) for slower in (True, False))
    turn = abs(speed)
    wanted = np.concatenate([slow[slow.imag < turn], fast[fast.imag >= turn]])
    # motion that nothing holds has roundoff of either sign
    wanted = wanted[(wanted.imag > 1e-3 * highest) & (np.abs(wanted) < highest)]
    wanted = wanted[np.argsort(wanted.imag)]
    assert len(modes.eigenvalues) == len(wanted) > 3
    misses = [np.abs(wanted - one).min() / abs(one) for one in modes.eigenvalues]
    roundoff = 3e-8
    assert 0.0 < modes.error <= TOLERANCE
    assert max(misses) <= 2.0 * modes.error + roundoff
    assert modes.shapes.shape == (len(rotor.assembly.weight), len(wanted))


@pytest.mark.closed_form
@pytest.mark.parametrize("damping", [50.0, 3e3])
def test_the_error_of_few_shapes_is_estimated(damping):
    """A range too wide for the shapes first taken: the estimate is 4/3 of the error, its factor of safety."""
    rotor, bearings = long_rotor(30), dict.fromkeys(FILMS, LinearBearing(stiffness=1e6, damping=damping))
    model = next(models(rotor, 300.0))
    at = rest(model.structure, bearings, 200.0)
    system = second_order(model.structure, at)
    values, vectors = np.linalg.eig(system.state_matrix())
    left = np.linalg.inv(vectors).conj().T[len(system.mass) :]
    chosen = np.flatnonzero((values.imag > 400.0) & (values.imag < 1100.0))
    ends = model.lifted(np.linalg.solve(system.mass, left[:, chosen]))
    whole = FullRotorModel(model.whole, at, 0.0)
    found = model.lifted(vectors[: len(system.mass), chosen])
    estimates = whirl_errors(model, whole, values[chosen], found, ends)
    exact = all_eigenvalues(rotor, bearings, 200.0, True)
    errors = [np.abs(exact - one).min() / abs(one) for one in values[chosen]]
    seen = np.array(errors) > 1e-6
    assert np.any(seen)
    assert_allclose(estimates[seen], 4.0 / 3.0 * np.array(errors)[seen], rtol=0.02)


def test_responses_are_checked_by_displacements():
    """Forces on the ground, which are millions of times as large, would hide them."""
    assert set(np.unique(seen_rows(mixed_rotor().assembly))) == {-1.0, 0.0, 1.0}


@pytest.mark.closed_form
def test_two_hundred_elements_have_the_modes_of_the_rotating_beam():
    """Pinned: (1 + r^2 b^2) w^2 - 2 r^2 b^2 W w - b^4 E I / (rho A) = 0, b = n pi / L, r^2 = I / A."""
    length, diameter, speed = 2.0, 0.02, 4000.0
    piece = ShaftElement(length=length, outer_diameter=diameter, material=STEEL)
    rotor = ShaftRotor(
        elements=piece.split(200),
        stations=(Station(node=0, name="left"), Station(node=200, name="right")),
        speed=0.0,
        gravity=(0.0, 0.0),
    )
    pins = dict.fromkeys(FILMS, LinearBearing(stiffness=1e11))
    modes = rotor_modes(rotor, pins, speed, 1500.0)
    square = diameter**2 / 16.0
    wanted = []
    for n in (1, 2, 3):
        b = n * math.pi / length
        r = square * b * b
        wanted += np.abs(np.roots([1 + r, -2 * r * speed, -(b**4) * 211e9 * square / 7810.0])).tolist()
    assert_allclose(modes.frequency[:6], np.sort(wanted), rtol=1e-3)
    assert_allclose(modes.direction[:6], [-1, 1] * 3, atol=1e-4)


@pytest.mark.closed_form
def test_a_large_rotor_rests_where_all_its_coordinates_do():
    rotor = long_rotor(30, internal_damping=1e-5)
    found, wanted = rotor_equilibrium(rotor, FILMS, 150.0), rest(rotor.structure, FILMS, 150.0)
    assert_allclose(
        found.displacement, wanted.displacement, atol=1e-7 * np.abs(wanted.displacement).max(), rtol=0
    )
    assert_allclose(found.coefficients["left"].stiffness, wanted.coefficients["left"].stiffness, rtol=1e-8)


@pytest.mark.filterwarnings("ignore:speeds should be below the threshold")
@pytest.mark.closed_form
@pytest.mark.parametrize("rotor", [long_rotor(30), long_rotor(30, loss_factor=0.01)], ids=["", "hysteresis"])
def test_responses_in_few_shapes_are_those_of_all_coordinates(rotor):
    speeds = np.array([60.0, 109.0, 250.0, 410.0])
    found = unbalance_response(rotor, FILMS, speeds)
    passed = rotor_transmissibility(rotor, FILMS, speeds)
    s = rotor.structure
    for column, speed in enumerate(speeds):
        at = rest(s, FILMS, speed)
        system = second_order(s, at)
        stiffness = system.stiffness.astype(complex)
        if s.hysteresis is not None:
            n = len(s.coordinates)
            for half in (slice(n), slice(n, None)):
                stiffness[half, half] += 0.5j * s.hysteresis
            stiffness[:n, n:] += 0.5 * s.hysteresis
            stiffness[n:, :n] -= 0.5 * s.hysteresis
        whole = stiffness - speed**2 * system.mass + 1j * speed * system.damping
        motion = np.linalg.solve(whole, speed**2 * s.unbalance @ [1.0, -1.0j])
        labels = ("left_x", "left_y", "right_x", "right_y", "large_x", "large_y")
        seen = [found.output_labels.index(name) for name in labels]
        moved = seen_rows(s) @ motion
        assert_allclose(found.complex[seen, 0, column], moved, rtol=0, atol=TOLERANCE * np.abs(moved).max())
        pushed = np.linalg.solve(whole, s.journals.T)
        film = at.coefficients["right"]
        force = (film.stiffness + 1j * speed * film.damping) @ (s.journals[2:] @ pushed)
        assert_allclose(passed.complex[2:, :, column], force, rtol=0, atol=TOLERANCE * np.abs(force).max())


@pytest.mark.closed_form
def test_banded_factors_solve():
    random = np.random.default_rng(3)
    near = sparse.diags_array([np.full(60 - k, 0.3) for k in (2, 1, 0, 1, 2)], offsets=(-2, -1, 0, 1, 2))
    shuffled = sparse.csr_array(near)[random.permutation(60)][:, random.permutation(60)]
    matrix = sparse.csr_array(shuffled @ shuffled.T + 0.1 * sparse.eye_array(60))
    load = random.normal(size=(60, 2)) + 1j * random.normal(size=(60, 2))
    assert_allclose(BandedCholesky(matrix).solve(load), np.linalg.solve(matrix.toarray(), load), rtol=1e-9)
    skewed = sparse.csr_array(matrix + 0.4j * sparse.triu(matrix))
    factor = BandedFactor.of(skewed)
    dense = skewed.toarray()
    assert_allclose(factor.solve(load[:, 0]), np.linalg.solve(dense, load[:, 0]), rtol=1e-9)
    assert_allclose(
        factor.solve(load[:, 0], adjoint=True), np.linalg.solve(dense.conj().T, load[:, 0]), rtol=1e-9
    )


@pytest.mark.closed_form
def test_a_chain_stays_banded_in_a_thousand_elements(monkeypatch):
    """Both planes of a fourth-order element are twelve unknowns a node; no dense matrix is made."""
    widths = []
    kept = banded.cholesky_banded
    monkeypatch.setattr(banded, "cholesky_banded", lambda ab, **k: widths.append(len(ab)) or kept(ab, **k))
    rotor = long_rotor(999)
    modes = rotor_modes(rotor, SPRINGS, 300.0, 400.0)
    coarse = rotor_modes(long_rotor(48), SPRINGS, 300.0, 400.0)
    assert_allclose(modes.eigenvalues, coarse.eigenvalues, rtol=1e-7)
    assert max(widths) <= 10
    assert "structure" not in rotor.__dict__


@pytest.mark.closed_form
@pytest.mark.parametrize("rotor", [long_rotor(6), long_rotor(30)], ids=["small", "large"])
def test_critical_speeds_are_roots_of_the_whole_rotor(rotor):
    """s = x + i W with L(s) singular in all coordinates, found by numpy; directions to be told apart."""
    found = critical_speeds(rotor, SPRINGS, np.linspace(20.0, 700.0, 12))
    assert len(found) == 5
    for one in found:
        value = one.speed * complex(-one.log_decrement / (2.0 * math.pi), 1.0)
        exact = all_eigenvalues(rotor, SPRINGS, one.speed, True)
        assert np.abs(exact - value).min() < 3e-8 * one.speed
    mapped = critical_speed_map(rotor, [1e6])[:2, 0]
    undamped = dict.fromkeys(FILMS, LinearBearing(stiffness=1e6))
    forward = [one.speed for one in critical_speeds(rotor, undamped, [20.0, 400.0]) if one.direction > 0.0]
    assert_allclose(forward, mapped, rtol=1e-7)


@pytest.mark.long
def test_critical_speeds_of_coarse_steps_are_those_of_fine_ones(monkeypatch):
    """Steps are halved until all is proven. All coordinates are solved a few times per critical speed."""
    rotor = long_rotor(30)
    count = []
    matrices = crossings.rotor_matrices
    kept = matrices.inverse_steps
    large = len(rotor.assembly.weight)
    monkeypatch.setattr(
        crossings.rotor_matrices,
        "inverse_steps",
        lambda *a: count.append(a[0].mass.shape[0] == large) or kept(*a),
    )
    fine = critical_speeds(rotor, FILMS, np.linspace(20.0, 700.0, 35))
    assert len(fine) <= sum(count) <= 4 * len(fine)
    coarse = critical_speeds(rotor, FILMS, [20.0, 250.0, 700.0])
    assert_allclose([one.speed for one in coarse], [one.speed for one in fine], rtol=1e-8)


@pytest.mark.parametrize("count", [6, 30])
def test_an_interval_in_which_critical_speeds_are_not_proven_is_named(count, monkeypatch):
    """Springs that stiffen a thousandfold at 200 rad/s: no whirl of one side is one of the other."""
    given = np.linspace(20.0, 700.0, 12)
    if count > 6:  # each halving takes the eigenvalues of a large matrix: a step near the jump, few halvings
        given = np.array([20.0, 199.9, 200.13, 700.0])
        monkeypatch.setattr(crossings, "HALVINGS", 6)
        monkeypatch.setattr(crossings, "LEAP_HALVINGS", 4)
    springs = np.array([1e5, 1e5, 1e8, 1e8])[:, None, None] * np.eye(2)
    speeds = [0.0, 200.0, 200.001, 800.0]
    film = TabulatedBearing(speeds=speeds, stiffness=springs, damping=[50.0 * np.eye(2)] * 4)
    with pytest.raises(ConvergenceError, match=r"proven complete between (199\.99|200\.00).* rad/s") as told:
        critical_speeds(long_rotor(count), dict.fromkeys(FILMS, film), given)
    assert re.search(r"(stiffness|damping) of the bearing at '\w*' jumps there", str(told.value))
    found = [one.speed for one in told.value.partial]
    assert found == sorted(found)
    assert found[0] < 200.0 < found[-1]


def spun(**changes):
    parts = {"mass": 3.0, "journal_mass": 0.1, "stiffness": 2e5, "speed": 0.0, "external_damping": 30.0}
    return JeffcottRotor(**(parts | changes))


def test_the_frequency_of_a_threshold_is_that_of_its_whirl():
    """Modes above, that nothing damps but roundoff, are not taken for it."""
    found = rotor_threshold(long_rotor(12), FILMS, np.linspace(50.0, 400.0, 15))
    assert found.whirl_ratio == pytest.approx(0.51, abs=0.01)


@pytest.mark.closed_form
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rotor_that_turns_either_way_whirls_beyond_its_threshold(sense):
    """Rotating damping: stable between -w (1 + c_e / c_i) and w (1 + c_e / c_i)."""
    rotor, hard = spun(internal_damping=20.0), {"": LinearBearing(stiffness=1e12)}
    found = stability_changes(rotor, hard, sense * np.linspace(-1000.0, 1000.0, 21))
    limit, natural = 2.5 * math.sqrt(2e5 / 3.0), math.sqrt(2e5 / 3.0)
    assert_allclose([one.speed for one in found], [-sense * limit, sense * limit], rtol=1e-5)
    assert_allclose([one.whirl_frequency for one in found], natural, rtol=1e-5)
    assert [one.growing for one in found] == [0, 2]
    assert all(one.direction > 0.9 for one in found)


@pytest.mark.closed_form
def test_cross_coupling_that_comes_and_goes():
    """m u'' + c u' + (k - i q) u = 0 grows where |q| > c sqrt(k / m); q over speed is a parabola."""
    mass, k, c = 20.0, 1e6, 400.0
    shaft = RigidShaft(
        mass=mass,
        diametral_inertia=3.2 / 1.44,
        polar_inertia=0.0,
        stations=(("left", -0.4), ("right", 0.4)),
        speed=0.0,
        gravity=(0.0, 0.0),
    )
    speeds = np.array([0.0, 200.0, 400.0])
    peak = 1.5 * c * math.sqrt(2 * k / mass)
    cross = np.array([0.0, peak, 0.0])
    springs = k * np.eye(2) + cross[:, None, None] * np.array([[0.0, 1.0], [-1.0, 0.0]])
    film = TabulatedBearing(speeds=speeds, stiffness=springs, damping=[c * np.eye(2)] * 3)
    table = dict.fromkeys(FILMS, film)
    # tilt has I for m, and a^2 times k, c and q
    bounce = math.sqrt(2 * k / mass)
    found = stability_changes(shaft, table, np.linspace(5.0, 395.0, 40))
    wanted = sorted(
        (speed, frequency)
        for frequency in (bounce, 1.2 * bounce)
        for speed in 200.0 + 200.0 * math.sqrt(1.0 - c * frequency / peak) * np.array([-1.0, 1.0])
    )
    assert_allclose([one.speed for one in found], [speed for speed, _ in wanted], rtol=1e-6)
    assert_allclose([one.whirl_frequency for one in found], [frequency for _, frequency in wanted], rtol=1e-5)
    assert [one.growing for one in found] == [2, 4, 2, 0]
    back = stability_changes(shaft, table, np.linspace(395.0, 5.0, 40))
    assert_allclose([one.speed for one in back], [one.speed for one in found][::-1], rtol=1e-6)


@pytest.mark.closed_form
def test_divergence_in_one_direction_ends_at_higher_speed():
    """kxx, a parabola over the speed, is negative within 90 / sqrt(2) of 100 rad/s: one root."""
    along = np.array([1e5, -1e5, 1e5])
    springs = np.array([np.diag([value, 3e5]) for value in along])
    film = TabulatedBearing(speeds=[10.0, 100.0, 190.0], stiffness=springs, damping=[300.0 * np.eye(2)] * 3)
    rotor = replace(spun(), gravity=(0.0, 0.0))
    found = stability_changes(rotor, {"": film}, np.linspace(10.0, 190.0, 12))
    away = 90.0 / math.sqrt(2.0)
    assert_allclose([one.speed for one in found], [100.0 - away, 100.0 + away], rtol=1e-8)
    assert [(one.whirl_frequency, one.growing) for one in found] == [(0.0, 1), (0.0, 0)]


def test_a_campbell_diagram_tells_its_error():
    speeds = np.linspace(50.0, 300.0, 4)
    assert campbell(long_rotor(6), SPRINGS, speeds, 1000.0).error == 0.0
    chart = campbell(long_rotor(30), SPRINGS, speeds, 1000.0)
    assert 0.0 < chart.error <= TOLERANCE
    wanted = rotor_modes(long_rotor(30), SPRINGS, 300.0, 1000.0)
    assert_allclose(np.sort(chart.frequency[:, -1])[: len(wanted.frequency)], wanted.frequency, rtol=1e-5)


def test_modes_and_diagrams_tell_up_to_which_frequency_they_are():
    speeds, large, small = [50.0, 150.0], long_rotor(30), long_rotor(12)
    assert rotor_modes(small, SPRINGS, 100.0).highest_frequency == math.inf
    assert campbell(small, SPRINGS, speeds).highest_frequency == math.inf
    assert rotor_modes(large, SPRINGS, 100.0, 400.0).highest_frequency == 400.0
    assert campbell(large, SPRINGS, speeds, 400.0).highest_frequency == 400.0
    modes = rotor_modes(large, SPRINGS, 100.0)
    free = all_eigenvalues(replace(large, gravity=(0.0, 0.0)), {}, 0.0, True)
    tenth = np.sort(free.imag[free.imag > 1.0])[2 * 8 - 1]  # in a plane two of them are no oscillation
    assert modes.highest_frequency == pytest.approx(tenth, rel=1e-6)
    assert campbell(large, SPRINGS, speeds).highest_frequency == modes.highest_frequency
    assert modes.frequency.max() < tenth
    assert usual_frequency(large, 1e4) == 2e4


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, -math.inf, None, [1.0]])
@pytest.mark.parametrize(
    "ask",
    [
        lambda v: rotor_modes(long_rotor(6), SPRINGS, 1.0, v),
        lambda v: campbell(long_rotor(6), SPRINGS, [1.0], v),
    ],
)
def test_a_frequency_that_is_none_is_refused(ask, value):
    with pytest.raises(InputError, match=r"highest_frequency must be finite and positive, got (?!-1\.5)"):
        ask(value)


def test_a_frequency_beyond_all_asks_for_all():
    assert rotor_modes(long_rotor(30), SPRINGS, 1.0, 1e149).eigenvalues.size == 244


@pytest.mark.parametrize("speed", [math.nan, math.inf, [1.0, 2.0]])
def test_a_speed_that_is_none_is_refused(speed):
    with pytest.raises(InputError, match="speed must be a single finite number"):
        rotor_modes(long_rotor(6), SPRINGS, speed)


@pytest.mark.parametrize("count", [-1, 0, 2.5, True])
def test_a_number_of_critical_speeds_that_is_none_is_refused(count):
    with pytest.raises(InputError, match="count must be an integer, at least 1"):
        critical_speed_map(long_rotor(6), [1e6], count)
