"""Critical speeds that are proven to be all, and what the proof stands on."""

import math
import sys
from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import sparse
from scipy.linalg import eigh

import rotorfilm as rf
from rotorfilm import (
    ConvergenceError,
    JournalBearing,
    LinearBearing,
    ShortFilm,
    TabulatedBearing,
    TiltingPadBearing,
    even_pivots,
)
from rotorfilm.analysis import (
    base_system,
    critical as searching,
    critical_speed_map,
    critical_speeds,
    modal_reduction,
    rotor_equilibrium,
    rotor_modes,
    rotor_system,
    rotor_threshold,
    rotor_thresholds as thresholds,
    stability_changes,
    unbalance_response,
)
from rotorfilm.analysis.critical import Changing, branches_on_line, require_all_undamped
from rotorfilm.analysis.modal_reduction import exact_structure, models, negative_count
from rotorfilm.analysis.rotor_equilibrium import RestEquations, rest
from rotorfilm.analysis.rotor_matrices import FullRotorModel, LeftOut, seen_rows, small_motion
from rotorfilm.core import UnloadedPadWarning
from rotorfilm.rotors import (
    Disk,
    ElasticMaterial,
    JeffcottRotor,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    Station,
)

from .test_big_rotors import FILMS, SPRINGS, long_rotor


def bouncing(**changes):
    """Return a rigid shaft whose bearings are beside its middle: bounce at sqrt(2 k / m), fast tilt."""
    parts = {
        "mass": 20.0,
        "diametral_inertia": 0.05,
        "polar_inertia": 0.0,
        "stations": (("left", -0.4), ("right", 0.4)),
        "speed": 0.0,
        "gravity": (0.0, 0.0),
    }
    return RigidShaft(**(parts | changes))


def stiffening(first, last, speeds=(20.0, 60.0, 100.0, 140.0, 180.0)):
    """Return springs with which the bounce has the frequency w + (w - first) (w - last) / 40."""
    w = np.linspace(speeds[0], speeds[-1], 161)
    frequency = w + (w - first) * (w - last) / 40.0
    springs = 10.0 * frequency[:, None, None] ** 2 * np.eye(2)
    film = TabulatedBearing(speeds=w, stiffness=springs, damping=[np.zeros((2, 2))] * len(w))
    return {"left": film, "right": film}


@pytest.mark.closed_form
@pytest.mark.parametrize("grid", [[30.0, 170.0], np.linspace(170.0, 30.0, 9)])
def test_a_whirl_that_crosses_to_and_fro_in_one_step_is_found_twice(grid):
    """As many whirls are slower than the rotation at both ends; a count there sees nothing."""
    found = critical_speeds(bouncing(), stiffening(98.0, 107.0), grid)
    assert_allclose([one.speed for one in found], [98.0, 98.0, 107.0, 107.0], rtol=2e-5)


@pytest.mark.closed_form
def test_whirls_that_only_come_near_the_rotation_are_none():
    """w + (w - a)^2 / 40 + .1 never is w."""
    w = np.linspace(20.0, 180.0, 161)
    frequency = w + (w - 100.0) ** 2 / 40.0 + 0.1
    springs = 10.0 * frequency[:, None, None] ** 2 * np.eye(2)
    film = TabulatedBearing(speeds=w, stiffness=springs, damping=[np.zeros((2, 2))] * len(w))
    found = critical_speeds(bouncing(), {"left": film, "right": film}, [30.0, 170.0])
    assert found == ()
    assert found.work["eigenproblems"] > 2


@dataclass(frozen=True)
class JumpingSpring:
    """A spring that is another one from a speed on, as no table is."""

    before: float
    after: float
    at: float
    clearance: float = math.inf

    def stiffness(self, speed):
        return self.before if abs(speed) < self.at else self.after

    def force(self, position, velocity, speed):
        return -self.stiffness(speed) * np.asarray(position)

    def jacobian(self, position, velocity, speed):
        return np.hstack([-self.stiffness(speed) * np.eye(2), np.zeros((2, 3))])


@pytest.mark.closed_form
def test_a_whirl_that_leaps_over_the_rotation_is_told_beside_those_that_cross():
    """The bounce has sqrt(2 k / m): 50 before 100 rad/s, then 120. It crosses twice and leaps between."""
    spring = JumpingSpring(10.0 * 50.0**2, 10.0 * 120.0**2, 100.0)
    with pytest.raises(ConvergenceError, match=r"stiffness of the bearing at 'left' jumps there") as raised:
        critical_speeds(bouncing(), {"left": spring, "right": spring}, [30.0, 170.0])
    found = raised.value.partial
    assert_allclose([one.speed for one in found], [50.0, 50.0, 120.0, 120.0], rtol=1e-9)
    assert found.work["equilibria"] > 2


@pytest.mark.closed_form
@pytest.mark.parametrize(("before", "after"), [(101.0, 99.0), (99.0, 101.0)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_critical_speed_within_a_small_jump_is_found_to_a_part_of_a_step(before, after, sign):
    """The bounce passes 100 rad/s within the jump; if it rises there, it crosses before and after, too."""
    spring = JumpingSpring(10.0 * before**2, 10.0 * after**2, 100.0)
    springs = {"left": spring, "right": spring}
    found = critical_speeds(bouncing(), springs, sign * np.linspace(95.0, 106.0, 8))
    wanted = np.repeat([100.0] if before > after else [99.0, 100.0, 101.0], 2)
    assert_allclose([one.speed for one in found], np.sort(sign * wanted), rtol=1e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize("size", [0.03, pytest.param(0.2, marks=pytest.mark.long), 0.7])
def test_a_jump_at_a_given_speed_hides_no_critical_speed(size):
    grid = np.linspace(95.0, 106.0, 8)
    for at in grid[1:-1]:
        spring = JumpingSpring(10.0 * (at + 0.5 * size) ** 2, 10.0 * (at - 0.5 * size) ** 2, at)
        found = critical_speeds(bouncing(), {"left": spring, "right": spring}, grid)
        assert_allclose([one.speed for one in found], [at, at], rtol=1e-4)


@pytest.mark.closed_form
def test_a_whirl_that_leaps_on_one_side_of_the_rotation_is_none():
    spring = JumpingSpring(10.0 * 50.0**2, 10.0 * 90.0**2, 100.0)
    found = critical_speeds(bouncing(), {"left": spring, "right": spring}, [30.0, 170.0])
    assert_allclose([one.speed for one in found], [50.0, 50.0], rtol=1e-9)


def test_a_search_ends_with_what_it_found(monkeypatch):
    """Without an allowance for more equilibria."""
    monkeypatch.setattr(searching, "MOST", 4)
    monkeypatch.setattr(searching, "MOST_PER_STEP", 0)
    with pytest.raises(ConvergenceError, match=r"between .* with 4 equilibria.* The 2 that were") as raised:
        critical_speeds(bouncing(), stiffening(98.0, 107.0), [95.0, 100.0, 103.0, 170.0])
    assert_allclose([one.speed for one in raised.value.partial], [98.0, 98.0], rtol=2e-5)


@pytest.mark.closed_form
def test_tilting_pads_of_which_one_is_loaded_first_leave_the_list_proven():
    """C jumps by a tenth where the upper pad gets a film, at 143.94 rad/s; the whirls are near 270."""
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    rotor = ShaftRotor(
        elements=ShaftElement(length=1.5, outer_diameter=0.08, material=steel).split(6),
        disks=(Disk(node=3, mass=50.0, polar_inertia=0.6, diametral_inertia=0.3),),
        stations=(Station(node=0, name="left"), Station(node=6, name="right")),
        speed=0.0,
    )
    pads = TiltingPadBearing(
        radius=0.04,
        length=0.04,
        assembled_clearance=7e-5,
        preload=0.3,
        extent=math.pi / 3.0,
        viscosity=0.02,
        pivots=even_pivots(5, between_pads=True),
    )
    films = dict.fromkeys(("left", "right"), pads)
    with pytest.warns(UnloadedPadWarning):
        found = critical_speeds(rotor, films, [143.9, 144.0])
    assert found == ()
    assert found.work["eigenproblems"] > 14
    with pytest.warns(UnloadedPadWarning):
        below = rotor_equilibrium(rotor, films, 143.9).coefficients["left"]
    above = rotor_equilibrium(rotor, films, 144.0).coefficients["left"]
    assert above.damping[1, 1] > 1.1 * below.damping[1, 1]


@pytest.mark.closed_form
@pytest.mark.parametrize("zeta", [0.05, 0.5, 0.9])
def test_damped_critical_speeds_are_damped_natural_frequencies(zeta):
    """Whirl that decays faster than it turns too: w sqrt(1 - z^2), both directions."""
    rotor = JeffcottRotor(
        mass=3.0, journal_mass=1e-3, stiffness=2e5, speed=0.0, external_damping=2 * zeta * math.sqrt(6e5)
    )
    natural = math.sqrt(2e5 / 3.0)
    found = critical_speeds(rotor, {"": LinearBearing(stiffness=1e11)}, np.linspace(20.0, 400.0, 5))
    wanted = natural * math.sqrt(1.0 - zeta**2)
    assert_allclose([one.speed for one in found], [wanted, wanted], rtol=1e-5)
    assert_allclose(found[0].log_decrement, 2 * np.pi * zeta / math.sqrt(1 - zeta**2), rtol=1e-4)


@pytest.mark.closed_form
@pytest.mark.parametrize("seed", range(4))
def test_bounds_hold_for_matrices_at_random(seed):
    """Every eigenvalue that a proven step lets come to the line goes as the bounds say, no other comes."""
    rng = np.random.default_rng(seed)
    n, half = 8, 1.0
    values = rng.uniform(-20.0, 20.0, n) + 1j * rng.uniform(-60.0, 60.0, n)
    rates, bends = (s * (rng.normal(size=(n, n)) + 1j * rng.normal(size=(n, n))) for s in (0.5, 0.2))
    line = np.array([9.0, 11.0])
    ways = branches_on_line(Changing(values, rates, np.abs(bends), half), line)
    assert ways is not None
    before = values[ways.places]
    for d in np.linspace(0.0, half, 101):
        T = np.diag(values) + d * rates + (d / half) ** 2 * bends
        own = np.linalg.eigvals(T)
        expected = values[ways.places] + d * np.diag(rates)[ways.places]
        now = np.array([own[np.abs(own - one).argmin()] for one in before])
        assert np.all(np.abs(now - expected) <= ways.drifts)
        if d:
            speed = (now - before) / (half / 100.0)
            assert np.all(np.abs(speed - np.diag(rates)[ways.places]) <= ways.slopes)
        others = [one for one in own if np.abs(now - one).min() > 1e-9]
        assert all(abs(one.imag - 10.0 - d) > 0.0 for one in others)
        before = now


def test_a_matrix_whose_eigenvalues_meet_is_not_proven():
    values = np.array([10.0j, 10.0j + 1e-3])
    coupled = np.array([[0.0, 1.0], [1.0, 0.0]], dtype=complex)
    assert branches_on_line(Changing(values, coupled, np.zeros((2, 2)), 1.0), np.array([9.0, 11.0])) is None


@pytest.mark.closed_form
@pytest.mark.parametrize("count", [6, 30])
def test_undamped_critical_speeds_are_counted_in_all_coordinates(count):
    """Sylvester's law: one less, or one more, is told."""
    rotor, springs = long_rotor(count), dict.fromkeys(FILMS, LinearBearing(stiffness=1e6))
    found = critical_speeds(rotor, springs, [20.0, 700.0])
    whole = exact_structure(rotor)
    low, high = (rest(whole if count == 6 else rotor.structure, springs, w) for w in (20.0, 700.0))
    require_all_undamped(whole, low, high, len(found))
    for wrong in (len(found) - 1, len(found) + 1):
        with pytest.raises(ConvergenceError, match=f"{wrong} of {len(found)} critical speeds"):
            require_all_undamped(whole, low, high, wrong)
    damped = replace(low, coefficients=rest(rotor.structure, SPRINGS, 20.0).coefficients)
    require_all_undamped(whole, damped, damped, 99)


@pytest.mark.closed_form
def test_the_law_of_inertia_counts_eigenvalues():
    rng = np.random.default_rng(1)
    bands = [rng.normal(size=60 - k) for k in range(4)]
    stiffness = sparse.csr_array(sparse.diags_array(bands, offsets=[0, 1, 2, 3]))
    stiffness = stiffness + stiffness.T
    mass = sparse.csr_array(sparse.diags_array(rng.uniform(1.0, 2.0, 60)))
    for square in (-2.0, -0.1, 0.0, 0.5, 3.0):
        wanted = int(np.sum(np.linalg.eigvalsh((stiffness - square * mass).toarray()) < 0.0))
        assert negative_count(stiffness, square, mass) == wanted
        assert negative_count(stiffness.toarray(), square, mass.toarray()) == wanted


def test_the_error_of_a_response_is_that_of_the_large_matrices():
    """l* A r with r and l as the whole rotor has them."""
    rotor, speed = replace(long_rotor(30), internal_damping=1e-5, loss_factor=0.01), 130.0
    model = next(models(rotor, 200.0))
    at = rest(model.structure, SPRINGS, speed)
    loads = rotor.assembly.unbalance
    L = small_motion(model.structure, at, speed).dynamic_stiffness(speed)
    amplitudes = speed**2 * np.array([[1.0], [-1.0j]])
    few = np.linalg.solve(L, model.seen(loads) @ amplitudes)
    left_out = LeftOut(model, loads)
    dual = np.linalg.solve(L.conj().T, left_out.seen.T)
    whole, places = FullRotorModel(model.whole, at, speed), seen_rows(model.whole)
    unbalanced = model.answer(loads @ amplitudes - whole.forces(1j * speed, model.lifted(few)))
    other = places.T - whole.adjoint_forces(1j * speed, model.lifted(dual))
    wanted = np.abs(other.conj().T @ unbalanced).max() / np.abs(places @ model.lifted(few)).max() * 4.0 / 3.0
    assert left_out.error(at, speed, amplitudes, few, dual) == pytest.approx(wanted, rel=1e-3)


@pytest.mark.closed_form
def test_a_threshold_tells_the_error_of_its_speed():
    """In few shapes beside all coordinates; a small rotor has none."""
    speeds = np.linspace(150.0, 300.0, 4)
    found = rotor_threshold(long_rotor(30), FILMS, speeds)
    assert 0.0 < found.speed_error < 1e-4
    assert found.work["eigenproblems"] <= len(speeds) + 3, (
        "the motion is followed, and looked at on both sides"
    )
    stable = rotor_threshold(long_rotor(30), FILMS, speeds[:2])
    assert (stable.speed, stable.work["eigenproblems"]) == (None, 2), "one look at each speed"
    exact = stability_changes(long_rotor(12), FILMS, speeds)[0]
    assert exact.speed_error == 0.0
    assert abs(found.speed - exact.speed) < 10.0 * found.speed_error + 1e-6 * exact.speed


def test_the_first_of_many_speeds_at_which_a_motion_grows_takes_few_looks(monkeypatch):
    """The speed is that of a look at each; the motion that grows at the top tells where to look."""
    rotor, speeds = long_rotor(30), np.linspace(150.0, 300.0, 31)
    growing = [rotor_modes(rotor, FILMS, speed).grows.any() for speed in speeds.tolist()]
    looks, motions_at = [], thresholds.motions_at
    monkeypatch.setattr(thresholds, "motions_at", lambda *given: looks.append(given) or motions_at(*given))
    speed, value = thresholds.first_growing(rotor, FILMS, speeds)
    assert speed == speeds[growing.index(True)]
    assert value.real > 0.0
    assert len(looks) == 3
    monkeypatch.setattr(thresholds, "_onset_of", lambda *given: len(speeds) - 1)
    assert_allclose(thresholds.first_growing(rotor, FILMS, speeds), (speed, value), rtol=1e-10)
    assert len(looks) > 8


def test_analyses_count_their_work():
    rotor, speeds = long_rotor(30), np.linspace(50.0, 300.0, 6)
    assert rotor_modes(rotor, SPRINGS, 100.0).work["eigenproblems"] == 1
    response = unbalance_response(rotor, SPRINGS, speeds)
    assert response.work["solutions"] == 6
    assert response.work["equilibria"] == 1, "springs rest alike at all speeds"
    found = critical_speeds(rotor, SPRINGS, speeds)
    assert found.work["eigenproblems"] <= 2 * (len(speeds) - 1)
    assert 0 < found.work["factorizations"] <= 8 * (len(found) + 1)
    assert stability_changes(rotor, FILMS, speeds[:2]).work["equilibria"] >= 2
    at = rotor_equilibrium(long_rotor(6), SPRINGS, 100.0)
    for system in (rotor_system(long_rotor(6), at), base_system(long_rotor(6), at)):
        assert system.work == {"equilibria": 0, "solutions": 0, "factorizations": 1}


def test_a_short_rotor_is_proven_in_few_shapes_and_solved_in_all_coordinates(monkeypatch):
    """All coordinates of six elements need nine times as many steps for the same critical speeds."""
    rotor, speeds = long_rotor(6), np.linspace(20.0, 700.0, 15)
    found = critical_speeds(rotor, FILMS, speeds)
    assert found.work["eigenproblems"] <= 100
    monkeypatch.setattr(modal_reduction, "FEW", 1000)
    whole = critical_speeds(rotor, FILMS, [found[0].speed - 1.0, found[0].speed + 1.0])
    assert_allclose(found[0].speed, whole[0].speed, rtol=1e-9)
    assert_allclose(found[0].log_decrement, whole[0].log_decrement, rtol=1e-9)


def test_a_search_takes_up_where_more_shapes_are_asked_for(monkeypatch):
    """Steps that were proven in fewer shapes are not proven again."""
    rotor, speeds = long_rotor(30), np.linspace(20.0, 700.0, 15)
    wanted = critical_speeds(rotor, FILMS, speeds)
    monkeypatch.setattr(searching, "REACH", 0.3)
    steps, proven = [], searching._Search._proven

    def noted(search, low, middle, high):
        steps.append((low, high, len(search.model.structure.mass)))
        return proven(search, low, middle, high)

    monkeypatch.setattr(searching._Search, "_proven", noted)
    found = critical_speeds(rotor, FILMS, speeds)
    assert_allclose([one.speed for one in found], [one.speed for one in wanted], rtol=1e-9)
    few, last = steps[0][2], steps[-1]
    assert few < last[2]
    assert not any(size > few for low, _, size in steps if low < 60.0)


def test_a_map_counts_its_eigenproblems(monkeypatch):
    """Beside those that numpy is asked for; the shapes of a rotor are found once."""
    asked = []

    def counting(*given, **options):
        asked.append(1)
        return eigh(*given, **options)

    monkeypatch.setattr(sys.modules[critical_speed_map.__module__], "eigh", counting)
    rotor = long_rotor(31)  # rotors of the same matrices share their shapes
    found = critical_speed_map(rotor, [1e6, 1e7, 1e8], 2)
    assert found.work["eigenproblems"] == len(asked) >= 3
    assert found.work["factorizations"] > 0
    assert critical_speed_map(rotor, [1e6], 2).work["factorizations"] == 0
    assert (found * 2.0).work == {}


@pytest.mark.closed_form
@pytest.mark.parametrize("count", [6, 30])
def test_critical_speeds_on_rigid_bearings_are_the_limit_of_stiff_ones(count):
    """Journals that cannot move, solved apart; no digit is lost on the way."""
    rotor = long_rotor(count)
    s, n = rotor.structure, len(rotor.assembly.coordinates)
    free = np.delete(np.eye(n), [0, 2 * count], axis=1)
    polar = s.gyroscopic[:n, n:]
    stiffness, inertia = (free.T @ part @ free for part in (s.stiffness[:n, :n], s.mass[:n, :n] - polar))
    squares = 1.0 / np.sort(np.linalg.eigvals(np.linalg.solve(stiffness, inertia)).real)[::-1][:2]
    found = critical_speed_map(rotor, [1e13, 1e18, 1e25], 2)
    assert_allclose(found[:, 1:], np.sqrt(squares)[:, None] * [1.0, 1.0], rtol=1e-8)
    assert_allclose(found[:, 0], np.sqrt(squares), rtol=1e-6)


def test_equilibria_count_their_steps():
    assert 1 <= rotor_equilibrium(long_rotor(6), FILMS, 150.0).work["newton_steps"] <= 12


def test_each_speed_is_searched_once_and_slopes_are_kept_near_an_equilibrium(monkeypatch):
    """Newton's method evaluates the derivatives of the films in some of its steps only."""
    steps, slopes, found = [], [], []
    equations, search = sys.modules["rotorfilm.analysis.rotor_equilibrium"], RestEquations.slopes

    def solved(system, *given, **options):
        steps.append(system.speed)
        return solve(system, *given, **options)

    solve, result = RestEquations.solve, equations._result
    monkeypatch.setattr(RestEquations, "solve", solved)
    monkeypatch.setattr(RestEquations, "slopes", lambda *given: slopes.append(given) or search(*given))
    monkeypatch.setattr(equations, "_result", lambda *given: found.append(result(*given)) or found[-1])
    with modal_reduction.counted("newton_steps") as work:
        critical_speeds(long_rotor(6), FILMS, np.linspace(20.0, 700.0, 15))
    assert len(steps) == len(set(steps)) > 40
    assert len(slopes) < 0.5 * work["newton_steps"]
    assert max(at.residual for at in found) <= 1e-9


def two_disks(count):
    steel = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    return rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.5, outer_diameter=0.05, material=steel).split(count),
        disks=tuple(rf.Disk.solid(k * count // 3, outer_diameter=0.3, **disk) for k in (1, 2)),
        stations=(rf.Station(node=0, name="left"), rf.Station(node=count, name="right")),
        speed=100.0,
    )


def on_pads():
    pads = rf.TiltingPadBearing(
        radius=0.05,
        length=0.05,
        assembled_clearance=1e-4,
        viscosity=0.05,
        pivots=rf.even_pivots(4, between_pads=True),
        extent=math.radians(72),
        preload=0.3,
    )
    return {"left": pads, "right": pads}


def test_critical_speeds_on_tilting_pads_are_proven_in_few_shapes():
    rotor, bearings = two_disks(12), on_pads()
    found = critical_speeds(rotor, bearings, np.linspace(90.0, 150.0, 4))
    assert len(found) == 2
    # The shapes of a rotor of 52 coordinates suffice where the error of a whirl is that of its own K(s).
    assert found.work["eigenproblems"] < 40
    for one in found:
        near = rotor_modes(rotor, bearings, one.speed, 500.0).frequency
        assert np.abs(near - one.speed).min() < 1e-8 * one.speed


def test_motions_on_tilting_pads_are_those_of_one_system_with_the_pads():
    modes = rotor_modes(two_disks(3), on_pads(), 200.0)
    # Each is polished once; the few that the pads damp more than they turn are iterated.
    assert modes.work["factorizations"] < 3 * len(modes.eigenvalues)


@pytest.mark.long
def test_a_threshold_follows_its_whirl():
    plain = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.05, film=ShortFilm())
    bearings = {"left": plain, "right": plain}
    found = [rotor_threshold(two_disks(n), bearings, np.linspace(50.0, 400.0, 8)) for n in (3, 6, 12)]
    first, second = np.abs(np.diff([one.speed for one in found]))
    assert first > 10.0 * second > 0.0  # elements of fourth order
    assert all(one.work["eigenproblems"] < 25 for one in found)
    assert all(one.whirl_ratio == pytest.approx(0.5, abs=0.1) for one in found)
