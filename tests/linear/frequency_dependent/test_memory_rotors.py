"""Flexible rotors on films that remember: the equations at each exponent, and a rigid journal as a limit."""

import sys

import numpy as np
import pytest
from scipy.linalg import eigvals

from rotorfilm import (
    ConvergenceError,
    Disk,
    ElasticMaterial,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    Station,
    TiltingPadBearing,
    Unbalance,
    campbell,
    critical_speeds,
    even_pivots,
    rotor_equilibrium,
    rotor_modes,
    rotor_threshold,
    unbalance_response,
    whirl_threshold,
)
from rotorfilm.analysis import frequency_dependent as remembered, rotor_system
from rotorfilm.analysis.frequency_dependent import rotor_growing
from rotorfilm.analysis.rotor_matrices import whirl_near, whirls_near
from rotorfilm.analysis.speed_events import CRITICAL, Start, value_rate, whirl_of
from rotorfilm.bearings import PadMapFilm, PadResolution

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
RIGID = RigidShaft(
    mass=1200.0,
    diametral_inertia=50.0,
    polar_inertia=1.0,
    stations=(("left", -0.5), ("right", 0.5)),
    speed=300.0,
)


def shaft(elements=4):
    pieces = ShaftElement(length=1.5, outer_diameter=0.1, material=STEEL).split(elements)
    return ShaftRotor(
        elements=pieces,
        stations=(Station(node=0, name="left"), Station(node=elements, name="right")),
        disks=(Disk(node=elements // 2, mass=600.0, diametral_inertia=5.0, polar_inertia=9.0),),
        unbalances=(Unbalance(node=elements // 2, unbalance=1e-3),),
        speed=157.08,
    )


@pytest.fixture(scope="module")
def films(film_of):
    """Return a film with a hole and a film with a groove, at the two ends."""
    return {"left": film_of("hole", 2e5), "right": film_of("top", 1e5)}


def equations(rotor, films, speed, s):
    """Return L(s) with K(s) as the films themselves give it."""
    m = rotor.structure
    at = rotor_equilibrium(rotor, films, speed)
    L = s**2 * m.mass + s * (m.damping + speed * m.gyroscopic) + m.stiffness + speed * m.circulation
    for k, name in enumerate(m.stations):
        rows = m.journals[2 * k : 2 * k + 2]
        L = L + rows.T @ films[name].complex_stiffness(at.coefficients[name].position, speed, s) @ rows
    return L


def imbalance(L, shape):
    """Return |L q| over the forces that cancel in it."""
    return np.abs(L @ shape).max() / (np.abs(L) @ np.abs(shape)).max()


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [120.0, 400.0])
def test_modes_solve_the_equations_at_their_own_exponents(films, speed):
    rotor = shaft()
    modes = rotor_modes(rotor, films, speed, 1500.0)
    assert len(modes.eigenvalues) >= 4
    for s, shape in zip(modes.eigenvalues, modes.shapes.T, strict=True):
        assert imbalance(equations(rotor, films, speed, s), shape) < 1e-9
        off = equations(rotor, films, speed, s * (1.0 + 1e-4))
        assert imbalance(off, shape) > 1e-9


@pytest.mark.closed_form
def test_a_rigid_shaft_in_two_films_is_the_rigid_journal(film_of):
    """And tilt does not matter: it loses stability later."""
    film = film_of("hole", 2e5)
    alone = whirl_threshold(film, [0.0, -600.0 * 9.80665], 600.0, speed_range=(300.0, 900.0))
    found = rotor_threshold(RIGID, {"left": film, "right": film}, [300.0, 900.0])
    assert found.speed == pytest.approx(alone.speed, rel=1e-8)
    assert found.whirl_ratio == pytest.approx(alone.whirl_ratio, rel=1e-6)


def test_what_grows_is_counted_besides(films, monkeypatch):
    rotor = shaft(2)
    for speed, growing in ((150.0, 0), (350.0, 2)):
        modes = rotor_modes(rotor, films, speed, 1500.0)
        at = rotor_equilibrium(rotor, films, speed)
        assert rotor_growing(rotor.structure, at, modes.eigenvalues) == growing
        assert 2 * np.sum(modes.eigenvalues.real > 0.0) == growing
        with monkeypatch.context() as patch:  # without any help of modes
            patch.setattr(remembered, "TOLD", -1.0)
            assert rotor_growing(rotor.structure, at, modes.eigenvalues) == growing
    monkeypatch.setattr(remembered, "growing_count", lambda *given: 4)
    with pytest.raises(ConvergenceError, match="only 0 of 4 growing motions were found"):
        rotor_threshold(rotor, films, [150.0, 350.0])


@pytest.mark.closed_form
def test_the_response_to_unbalance_has_the_stiffness_at_the_speed(films):
    rotor = shaft()
    speeds = [90.0, 250.0]
    found = unbalance_response(rotor, films, speeds)
    rows = rotor.structure.journals
    for k, speed in enumerate(speeds):
        force = speed**2 * rotor.structure.unbalance @ np.array([1.0, -1.0j])
        journals = rows @ np.linalg.solve(equations(rotor, films, speed, 1j * speed), force)
        data = [found.frdata[found.output_labels.index(n), 0, k] for n in ("left_x", "left_y", "right_x")]
        np.testing.assert_allclose(data, journals[:3], rtol=1e-8)


@pytest.mark.long
def test_campbell_diagram_and_critical_speeds_have_the_same_whirls(films):
    rotor, speeds = shaft(2), [130.0, 150.0]
    chart = campbell(rotor, films, speeds, 400.0)
    modes = rotor_modes(rotor, films, 150.0, 400.0)
    for s in modes.eigenvalues[modes.eigenvalues.imag < 300.0]:
        assert np.nanmin(np.abs(chart.eigenvalues[:, 1] - s)) < 1e-8 * abs(s)
    found = critical_speeds(rotor, films, speeds)
    assert found
    for one in found:
        s = one.speed * complex(-one.log_decrement / (2.0 * np.pi), 1.0)
        L = equations(rotor, films, one.speed, s)
        sizes = np.linalg.svd(L / np.sqrt(np.outer(*2 * [np.abs(L).max(axis=1)])), compute_uv=False)
        assert sizes[-1] < 1e-8 * sizes[0]


def test_a_rotor_in_few_shapes_is_the_whole_one(films):
    """The error that it tells covers what the shapes leave out."""
    rotor, h = shaft(8), 1e-4
    few = rotor_modes(rotor, films, 300.0, 400.0)
    assert 0.0 < few.error < 1e-6
    for s in few.eigenvalues:
        L = equations(rotor, films, 300.0, s)
        slope = (equations(rotor, films, 300.0, s + h) - equations(rotor, films, 300.0, s - h)) / (2.0 * h)
        step = np.abs(eigvals(L, slope)).min()  # Newton's, to the exponent of the whole
        assert step < 3.0 * few.error * abs(s)


PADS = {
    name: TiltingPadBearing(
        radius=0.05,
        length=0.05,
        viscosity=0.02,
        pivots=even_pivots(4, between_pads=True),
        extent=np.radians(80.0),
        preload=0.3,
        pad_clearance=1e-4,
        film=PadMapFilm(resolution=PadResolution(cells=(32, 4), nodes=(8, 9, 24))),
    )
    for name in ("left", "right")
}


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_a_critical_speed_on_pads_has_their_stiffness_at_the_exponent():
    rotor = shaft(2)
    first = critical_speeds(rotor, PADS, [140.0, 155.0])[0]
    start = Start(first.speed * 1.01, 1j * first.speed, np.ones(len(rotor.structure.weight), dtype=complex))
    whirl, _ = whirl_of(CRITICAL, rotor, PADS, PADS, start)
    assert whirl.at.speed == pytest.approx(first.speed, rel=1e-8)
    assert imbalance(pad_equations(rotor, whirl.at, whirl.value), whirl.right) < 1e-9
    near = [rotor_modes(rotor, PADS, first.speed * share, 400.0).eigenvalues for share in (0.999, 1.001)]
    low, high = (values[np.argmin(np.abs(values - whirl.value))] for values in near)
    rate = value_rate(rotor.structure, whirl, PADS)
    assert rate == pytest.approx((high - low) / (0.002 * first.speed), rel=0.01)


def pad_equations(rotor, at, s):
    m = rotor.structure
    L = s**2 * m.mass + s * (m.damping + at.speed * m.gyroscopic) + m.stiffness + at.speed * m.circulation
    for k, name in enumerate(m.stations):
        rows = m.journals[2 * k : 2 * k + 2]
        K = PADS[name].at_rest().matrices(at.coefficients[name].position, at.speed).dynamic_stiffness(s)[0]
        L = L + rows.T @ K @ rows
    return L


def test_python_control_has_the_films_at_all_frequencies_up_to_the_speed(films):
    rotor, speed = shaft(2), 350.0
    system = rotor_system(rotor, rotor_equilibrium(rotor, films, speed))
    poles, modes = system.poles(), rotor_modes(rotor, films, speed, 1500.0).eigenvalues
    slow = modes[(np.abs(modes) < speed) & (modes.imag > -modes.real)]
    assert np.sum(poles.real > 0.0) == 2
    assert len(slow) >= 2
    for s in slow:
        assert np.abs(poles - s).min() < 2e-3 * abs(s)
    frequency = 160.0
    push = rotor.structure.journals[:1].T
    wanted = np.linalg.solve(equations(rotor, films, speed, 1j * frequency), push)
    column = system.input_labels.index("left_force_x")
    row = system.output_labels.index("left_x")
    assert system(1j * frequency)[row, column] == pytest.approx(
        (rotor.structure.journals[0] @ wanted).item(), rel=2e-3
    )


def test_modes_follow_only_exponents_that_may_come_within_the_range(films, monkeypatch):
    followed = []

    def counted(structure, at, frequency, values, shapes):
        followed.extend(values)
        return frequency_dependent_motions(structure, at, frequency, values, shapes)

    module = sys.modules["rotorfilm.analysis.rotor_modes"]
    frequency_dependent_motions = module.frequency_dependent_motions
    monkeypatch.setattr(module, "frequency_dependent_motions", counted)
    modes = rotor_modes(shaft(), films, 120.0, 1500.0)
    # All motions of the 20 coordinates would be more than 20, and twice that with those of films with states.
    assert len(modes.eigenvalues) <= len(followed) <= 3 * len(modes.eigenvalues)
    assert len(set(followed)) == len(followed)


@pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.UnloadedPadWarning")
def test_rests_over_speed_are_sought_once_and_lead_to_the_modes_of_each_speed(films):
    """A Campbell diagram begins each search at its neighbors, `rotor_modes` begins anew."""
    rotor, speeds = shaft(2), np.linspace(120.0, 200.0, 5)
    found = campbell(rotor, films, speeds, 1500.0)
    assert found.work["equilibria"] == len(speeds)
    for values, speed in zip(found.eigenvalues.T, speeds, strict=True):
        alone = rotor_modes(rotor, films, speed, 1500.0).eigenvalues
        apart = np.abs(values[np.isfinite(values), None] - alone).min(axis=1)
        assert np.all(apart < 1e-9 * np.abs(values[np.isfinite(values)]))
    assert rotor_threshold(rotor, PADS, speeds).work["equilibria"] == len(speeds)


def test_whirls_sought_together_are_those_sought_alone(films, monkeypatch):
    """Where K(s) of a film is not known for one of them, that one alone is not found."""
    structure, at = shaft(2).structure, rotor_equilibrium(shaft(2), films, 150.0)
    starts, load = np.array([90.0j, 150.0j, -40.0 + 400.0j]), np.ones(len(structure.weight)) + 0j
    found, right, left, ended = whirls_near(structure, at, 150.0, starts, np.array([load] * 3))
    assert ended.all()
    for k, start in enumerate(starts):
        value, first, last = whirl_near(structure, at, 150.0, start, load)
        assert found[k] == pytest.approx(value, rel=1e-13)
        assert abs(np.vdot(right[k], first)) == pytest.approx(1.0, rel=1e-12)
        assert abs(np.vdot(left[k], last)) == pytest.approx(1.0, rel=1e-12)
    motion = type(at.coefficients["left"].dynamic_stiffness)
    known = motion.__call__

    def refusing(self, s):
        if abs(s - starts[1]) < 1e-6:
            raise ConvergenceError("no K(s)")
        return known(self, s)

    monkeypatch.setattr(motion, "__call__", refusing)
    others, *_, ended = whirls_near(structure, at, 150.0, starts, np.array([load] * 3))
    assert ended.tolist() == [True, False, True]
    assert others[[0, 2]] == pytest.approx(found[[0, 2]], rel=1e-13)
