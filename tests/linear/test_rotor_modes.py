"""Modes, Campbell diagram, critical speeds and unbalance response of flexible rotors."""

import math
from dataclasses import replace

import control
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.linalg import eig

from rotorfilm import (
    BallBearing,
    EquilibriumError,
    InputError,
    LinearBearing,
    TabulatedBearing,
    ValidityWarning,
)
from rotorfilm.analysis import (
    campbell,
    closed_loop,
    critical_speed_map,
    critical_speeds,
    equilibrium,
    rotor_equilibrium,
    rotor_modes,
    rotor_system,
    rotor_threshold,
    rotor_transmissibility,
    to_nlsys,
    unbalance_response,
    whirl_threshold,
)
from rotorfilm.analysis.rotor_matrices import roundoff
from rotorfilm.analysis.rotor_modes import log_decrement
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.core import names
from rotorfilm.cosim import critical_macro_step
from rotorfilm.rotors import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    JeffcottRotor,
    Probe,
    RigidRotor,
    RigidShaft,
    ShaftElement,
    ShaftRotor,
    Station,
    Support,
    Unbalance,
    mount,
    reduce_rotor,
)

STEEL = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
FILM = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=ShortFilm())
SPRING = LinearBearing(stiffness=1e6)
RPM = math.pi / 30.0


def friswell(**changes):
    disk = {"density": 7810.0, "width": 0.07, "inner_diameter": 0.05}
    parts = {
        "elements": ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(6),
        "disks": (Disk.solid(2, outer_diameter=0.28, **disk), Disk.solid(4, outer_diameter=0.35, **disk)),
        "stations": (Station(node=0, name="left"), Station(node=6, name="right")),
        "unbalances": (Unbalance(node=2, unbalance=1e-3, unbalance_angle=0.5),),
        "probes": (Probe(node=2, name="small"),),
        "speed": 0.0,
        "beam": ClassicalBeam(),
    }
    return ShaftRotor(**(parts | changes))


def both(bearing):
    return {"left": bearing, "right": bearing}


def rigid_shaft(**changes):
    parts = {
        "mass": 20.0,
        "diametral_inertia": 0.8,
        "polar_inertia": 0.5,
        "stations": (("left", -0.4), ("right", 0.4)),
        "unbalances": ((0.1, 1e-3, 0.3),),
        "speed": 0.0,
    }
    return RigidShaft(**(parts | changes))


@pytest.mark.literature
def test_friswell_example_591_with_its_directions():
    modes = rotor_modes(friswell(), both(SPRING), 4000 * RPM)
    assert_allclose(modes.frequency[:5], [85.39, 87.80, 251.78, 294.71, 600.18], atol=0.007)
    assert_allclose(modes.direction[:5], [-1, 1, -1, 1, -1], atol=1e-6)
    other_way = rotor_modes(friswell(), both(SPRING), -4000 * RPM)
    assert_allclose(other_way.direction[:5], modes.direction[:5], atol=1e-6)
    assert_allclose(modes.log_decrement[:5], 0.0, atol=1e-8)


@pytest.mark.closed_form
def test_log_decrement_of_a_damped_oscillator():
    zeta = 0.1
    assert log_decrement([-zeta + 1j * math.sqrt(1 - zeta**2)])[0] == pytest.approx(
        2 * math.pi * zeta / math.sqrt(1 - zeta**2)
    )


@pytest.mark.closed_form
def test_system_has_the_poles_of_rotor_and_films_as_one_model():
    rotor = friswell(speed=150.0, internal_damping=1e-5)
    at = rotor_equilibrium(rotor, both(FILM), 150.0)
    loop = rotor_system(rotor, at, name="shaft")
    assert isinstance(loop, control.StateSpace)
    assert loop.input_labels == names(rotor.inputs)
    assert loop.output_labels[-4:] == [f"{s}_housing_force_{a}" for s in ("left", "right") for a in "xy"]
    model = mount(rotor, both(FILM))
    state = np.concatenate([at.displacement, 0 * at.displacement])
    assert_allclose(
        loop.A, model.linearization(0.0, state, []).A, rtol=1e-7, atol=1e-6 * np.abs(loop.A).max() * 1e-6
    )


@pytest.mark.closed_form
def test_statics_pass_to_the_housings():
    rotor = friswell(speed=150.0)
    gain = rotor_system(rotor, rotor_equilibrium(rotor, both(FILM), 150.0)).dcgain()
    assert_allclose(gain[-4:], np.eye(4), atol=1e-5)


@pytest.mark.closed_form
def test_rigid_rotor_by_both_routes():
    """One film under a mass: the system is that of closed_loop."""
    rotor = rigid_shaft(stations=(("", 0.0),), speed=150.0, unbalances=())
    at = rotor_equilibrium_of_one(rotor)
    loop = rotor_system(rotor, at)
    flat = RigidRotor(mass=20.0, speed=150.0)
    wanted = closed_loop(flat, FILM, equilibrium(FILM, flat.static_load, 150.0))
    s = 30.0 + 100.0j
    outputs = [loop.output_labels.index(name) for name in wanted.output_labels]
    assert_allclose(loop(s)[outputs], wanted(s), rtol=1e-8)


def rotor_equilibrium_of_one(rotor):
    """A shaft on one film would tilt: its own equilibrium, with a station that holds the tilt."""
    from rotorfilm.analysis import RotorEquilibrium, coefficients

    at = equilibrium(FILM, [0.0, -20.0 * 9.80665], 150.0)
    return RotorEquilibrium(
        speed=150.0,
        coefficients={"": coefficients(FILM, at.position, 150.0)},
        loads={"": at.load},
        displacement=np.zeros(4),
        residual=0.0,
    )


@pytest.mark.closed_form
def test_light_load_whirls_at_half_the_speed():
    """Kxy = speed Cxx / 2 at no eccentricity: whatever the shaft, the film drives half-speed whirl."""
    speed = 5.0
    rotor = friswell(gravity=(0.0, -1e-9))
    film = rotor_equilibrium(rotor, both(FILM), speed).coefficients["left"]
    assert film.stiffness[0, 1] == pytest.approx(speed * film.damping[0, 0] / 2, rel=1e-6)
    modes = rotor_modes(rotor, both(FILM), speed)
    slow = np.argsort(np.abs(modes.eigenvalues))[:2]  # others barely oscillate, but die out at once
    assert_allclose(modes.frequency[slow], speed / 2, rtol=1e-4)
    assert np.all(modes.direction[slow] > 0.99)
    # (C per bearing) Re = mass per bearing (speed / 2)^2, of both rigid modes together
    size = len(rotor.structure.coordinates)
    journals = rotor.structure.journals[::2, :size]
    z = np.array([0.0, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5])
    rigid = np.zeros((size, 2))
    rigid[0:14:2] = np.column_stack([1.0 - z / 1.5, z / 1.5])
    rigid[1:14:2] = [-1.0 / 1.5, 1.0 / 1.5]
    # at half the speed the gyroscopic effect takes twice the polar inertia away
    inertia = rotor.structure.mass[:size, :size] - 2.0 * rotor.structure.gyroscopic[:size, size:]
    inertia = rigid.T @ inertia @ rigid
    growth = np.linalg.eigvalsh(inertia) * (speed / 2) ** 2 / film.damping[0, 0]
    assert_allclose(journals @ rigid, np.eye(2), atol=1e-12)
    assert_allclose(np.sort(modes.eigenvalues.real[slow]), growth, rtol=0.02)


@pytest.mark.closed_form
def test_campbell_follows_closed_form_through_a_crossing():
    """Bounce at sqrt(2 k / m) crosses the backward tilt, I p^2 - J w p - 2 k a^2 = 0."""
    k, a = 1e6, 0.4
    speeds = np.linspace(20.0, 900.0, 60)
    chart = campbell(rigid_shaft(diametral_inertia=2.9), both(LinearBearing(stiffness=k)), speeds)
    bounce = np.full(60, math.sqrt(2 * k / 20.0))
    tilts = np.array([np.sort(np.abs(np.roots([2.9, -0.5 * w, -2 * k * a**2]))) for w in speeds]).T
    wanted = np.array([bounce, bounce, *tilts])
    for track in chart.frequency:
        best = np.abs(wanted / track - 1.0).max(axis=1).min()
        assert best < 1e-7, "a curve follows one mode from end to end"
    assert chart.frequency.shape == (4, 60)


@pytest.mark.closed_form
def test_damped_critical_speeds_are_those_of_the_map_without_damping():
    rotor = friswell()
    speeds = np.linspace(20.0, 700.0, 35)
    found = critical_speeds(rotor, both(SPRING), speeds)
    forward = [one.speed for one in found if one.direction > 0]
    mapped = critical_speed_map(rotor, [1e6])[:, 0]
    assert_allclose(forward[:2], mapped[:2], rtol=1e-9)
    assert len(found) > len(forward), "backward whirl crosses the speed too"


@pytest.mark.closed_form
def test_map_of_a_tilting_rigid_rotor():
    """Bounce at sqrt(2 k / m), tilt at sqrt(2 k a^2 / (I - J)), none when J > I."""
    stiffness = np.array([1e5, 1e7])
    found = critical_speed_map(rigid_shaft(), stiffness, 2)
    assert_allclose(found[0], np.sqrt(2 * stiffness / 20.0), rtol=1e-10)
    assert_allclose(found[1], np.sqrt(2 * stiffness * 0.16 / 0.3), rtol=1e-10)
    disk = critical_speed_map(rigid_shaft(polar_inertia=1.2), stiffness, 2)
    assert np.isnan(disk[1]).all()
    with pytest.raises(InputError, match="stiffness must be a list of positive numbers"):
        critical_speed_map(rigid_shaft(), [0.0])


@pytest.mark.closed_form
def test_critical_speed_of_an_elastic_jeffcott_rotor():
    """Shaft and bearing in series, journal without weight: sqrt(k k_b / ((k + k_b) m))."""
    rotor = JeffcottRotor(mass=3.0, journal_mass=1e-7, stiffness=2e5, speed=0.0)
    found = critical_speeds(rotor, {"": LinearBearing(stiffness=3e5)}, np.linspace(50.0, 400.0, 8))
    assert_allclose([one.speed for one in found], math.sqrt(1.2e5 / 3.0), rtol=1e-6)


@pytest.mark.closed_form
def test_unbalance_response_of_the_textbook():
    """|r| / u = s^2 / sqrt((1 - s^2)^2 + (2 z s)^2), forward circles, phase from 0 to -180 deg."""
    mass, k, zeta, offset, angle = 20.0, 1e6, 0.1, 1e-5, 0.3
    natural = math.sqrt(2 * k / mass)
    bearing = LinearBearing(stiffness=k, damping=zeta * mass * natural)
    rotor = rigid_shaft(unbalances=((0.0, mass * offset, angle),))
    s = np.array([0.2, 1.0, 3.0])
    response = unbalance_response(rotor, both(bearing), s * natural)
    assert isinstance(response, control.FrequencyResponseData)
    assert response.input_labels == ["unbalance"]
    x = response.complex[response.output_labels.index("left_x"), 0]
    y = response.complex[response.output_labels.index("left_y"), 0]
    expected = offset * s**2 / (1 - s**2 + 2j * zeta * s) * np.exp(1j * angle)
    assert_allclose(x, expected, rtol=1e-9)
    assert_allclose(y, -1j * expected, rtol=1e-9)
    housing = response.complex[response.output_labels.index("left_housing_force_x"), 0]
    assert_allclose(housing, (k + 1j * s * natural * zeta * mass * natural) * expected, rtol=1e-9)


@pytest.mark.filterwarnings("ignore:speeds should be below the threshold")
def test_a_response_that_the_film_has_no_room_for_is_warned_of():
    """Half axis of the orbit, the largest distance over a turn, in least films at rest."""
    heavy = (Unbalance(node=2, unbalance=2e-2),)
    small = unbalance_response(friswell(unbalances=(Unbalance(node=2, unbalance=1e-5),)), both(FILM), [90.0])
    with pytest.warns(
        ValidityWarning, match=r"the journal of 'right' should move by less than 0\.5 of its least"
    ):
        large = unbalance_response(friswell(unbalances=heavy), both(FILM), [90.0, 111.0])
    rows = [large.output_labels.index(f"left_{axis}") for axis in "xy"]
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 3601))
    rest = rotor_equilibrium(friswell(), both(FILM), 111.0).coefficients["left"].position
    moved = np.hypot(*(large.complex[rows, 0, 1][:, None] * turn).real).max()
    share, speed = large.largest_moves["left"]
    assert (share, speed) == (pytest.approx(moved / (FILM.clearance - np.hypot(*rest)), rel=1e-5), 111.0)
    assert small.largest_moves["left"].share < 0.01 * share


def test_balls_have_no_film_that_a_response_could_leave():
    balls = BallBearing(balls=9, ball_diameter=12e-3, pitch_diameter=65e-3, internal_clearance=1e-5)
    found = unbalance_response(friswell(unbalances=(Unbalance(node=2, unbalance=1e-2),)), both(balls), [20.0])
    assert found.largest_moves == {}


def test_unbalance_response_is_the_motion_of_the_model_in_time():
    """At small unbalance on films: the state that the phasors give moves as they say."""
    rotor = friswell(speed=120.0, internal_damping=1e-5)
    response = unbalance_response(rotor, both(FILM), [120.0])
    at = rotor_equilibrium(rotor, both(FILM), 120.0)
    model = mount(rotor, both(FILM))
    rest = np.concatenate([at.displacement, 0 * at.displacement])
    A, _, C, _ = model.linearization(0.0, rest, [])
    quiet = mount(friswell(speed=120.0, internal_damping=1e-5, unbalances=()), both(FILM))
    pushes = [model.derivative(t, rest, []) - quiet.derivative(t, rest, []) for t in (0.0, math.pi / 240.0)]
    motion = np.linalg.solve(120.0j * np.eye(len(A)) - A, pushes[0] - 1j * pushes[1])
    row = response.output_labels.index("small_x")
    assert response.complex[row, 0, 0] == pytest.approx(
        (C @ motion)[names(model.outputs).index("small_x")], rel=1e-6
    )


@pytest.mark.literature
def test_bearings_of_friswell_example_596_at_the_load_of_the_book():
    """Half of the weight of a symmetric rotor, 525 N, on each film at 1500 rpm."""
    mass = 2 * 525.0 / 9.80665
    at = rotor_equilibrium(rigid_shaft(mass=mass, unbalances=()), both(FILM), 1500 * RPM)
    printed = [12807959, 16393593, -25060393, 8815302]
    assert_allclose(at.coefficients["left"].stiffness.ravel(), printed, atol=1.0)


@pytest.mark.closed_form
def test_threshold_of_a_rigid_shaft_is_that_of_its_mass():
    """Equal films at equal distances, thin and long: bounce whirls first, as a mass on one film does."""
    shaft = rigid_shaft(diametral_inertia=0.3, polar_inertia=0.0, unbalances=())
    onset = rotor_threshold(shaft, both(FILM), np.linspace(50.0, 2000.0, 40))
    wanted = whirl_threshold(FILM, [0.0, -10.0 * 9.80665], 10.0)
    assert onset.speed == pytest.approx(wanted.speed, rel=1e-8)
    assert onset.whirl_ratio == pytest.approx(wanted.whirl_ratio, rel=1e-7)
    assert onset.direction > 0.9


@pytest.mark.closed_form
def test_threshold_of_internal_damping():
    """w_n (1 + c_e / c_i) on rigid bearings."""
    rotor = JeffcottRotor(
        mass=3.0, journal_mass=0.1, stiffness=2e5, speed=0.0, external_damping=30.0, internal_damping=20.0
    )
    hard = {"": LinearBearing(stiffness=1e12)}
    onset = rotor_threshold(rotor, hard, np.linspace(100.0, 1000.0, 10))
    assert onset.speed == pytest.approx(2.5 * math.sqrt(2e5 / 3.0), rel=1e-5)
    assert onset.whirl_ratio == pytest.approx(0.4, rel=1e-5)
    told = []
    assert rotor_threshold(rotor, hard, [100.0, 200.0, 400.0, 900.0], report=lambda *one: told.append(one))
    assert [fraction for fraction, _ in told] == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert told[1][1] == "what grows at 200 rad/s"
    assert rotor_threshold(rotor, hard, [100.0, 200.0]).reason == "stable at every speed given"
    assert rotor_threshold(rotor, hard, [800.0, 900.0]).reason == "unstable at the first speed given"


def light_shaft(**changes):
    """A disk that only moves, in the middle of a shaft without weight, on hard bearings: k = 48 E I / L^3."""
    light = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=1e-3)
    piece = ShaftElement(length=1.0, outer_diameter=0.03, material=light, shear_coefficient=math.inf)
    parts = {
        "elements": piece.split(2),
        "disks": (Disk(node=1, mass=20.0),),
        "stations": (
            Station(node=0, name="left"),
            Station(node=2, name="right"),
            Station(node=1, name="air"),
        ),
        "probes": (Probe(node=1, name="disk"),),
        "unbalances": (Unbalance(node=1, unbalance=1e-3),),
        "beam": ClassicalBeam(),
        "speed": 0.0,
        "gravity": (0.0, 0.0),
    }
    stiffness = 48 * 211e9 * math.pi * 0.03**4 / 64
    return ShaftRotor(**(parts | changes)), stiffness, math.sqrt(stiffness / 20.0)


def hard_with_air(damping):
    hard = LinearBearing(stiffness=1e13)
    return {"left": hard, "right": hard, "air": LinearBearing(stiffness=0.0, damping=damping)}


@pytest.mark.closed_form
@pytest.mark.parametrize("factor", [0.5, 1.5, 4.0])
def test_hysteresis_damps_below_and_drives_above_the_critical_speed(factor):
    """m u'' + c u' + k (1 +- i eta) u = 0 at any speed, with the sign of frequency - speed."""
    eta, damping = 0.02, 1.0
    rotor, stiffness, natural = light_shaft(loss_factor=eta)
    speed = factor * natural
    modes = rotor_modes(rotor, hard_with_air(damping), speed)
    first = modes.eigenvalues[:2]
    for value, direction in zip(first, modes.direction[:2], strict=True):
        sign = -1.0 if direction > 0.0 and factor > 1.0 else 1.0
        roots = np.roots([20.0, damping, stiffness * (1 + 1j * sign * eta)])
        assert value == pytest.approx(roots[np.argmax(roots.imag)], rel=1e-4)
    assert (first.real.max() > 0.0) == (factor > 1.0)


@pytest.mark.closed_form
def test_hysteresis_does_not_limit_forward_synchronous_whirl():
    """The shaft is bent once and for all: |r| = u s^2 / |1 - s^2|."""
    rotor, _, natural = light_shaft(loss_factor=0.1)
    found = unbalance_response(rotor, hard_with_air(0.0), [0.9 * natural])
    x = found.complex[found.output_labels.index("disk_x"), 0, 0]
    assert abs(x) == pytest.approx(1e-3 / 20.0 * 0.81 / 0.19, rel=1e-4)


def test_hysteresis_has_no_time_domain():
    rotor, *_ = light_shaft(loss_factor=0.1)
    with pytest.raises(InputError, match="loss_factor must be 0 over time"):
        rotor.derivative(0.0, rotor.initial_state, np.zeros(6))
    with pytest.raises(InputError, match="loss_factor must be 0 for a state space"):
        rotor_system(rotor, rotor_equilibrium(rotor, hard_with_air(0.0), 10.0))


@pytest.mark.closed_form
def test_divergence_ends_stability():
    """The spring of the bearing turns negative at 55 rad/s, the elastic shaft in series or not."""
    rotor = JeffcottRotor(
        mass=10.0, journal_mass=1.0, stiffness=1e6, speed=1.0, external_damping=10.0, gravity=(0.0, 0.0)
    )
    springs = np.array([1e5, -1e5])[:, None, None] * np.eye(2)
    film = TabulatedBearing(speeds=[10.0, 100.0], stiffness=springs, damping=[100.0 * np.eye(2)] * 2)
    onset = rotor_threshold(rotor, {"": film}, np.linspace(10.0, 100.0, 8))
    assert onset.speed == pytest.approx(55.0, rel=1e-9)
    assert (onset.whirl_frequency, onset.whirl_ratio) == (0.0, 0.0)
    assert onset.direction == pytest.approx(0.0, abs=1e-9)
    soft = {"": LinearBearing(stiffness=-1e5, damping=100.0)}
    assert rotor_threshold(rotor, soft, [10.0, 100.0]).reason == "unstable at the first speed given"


@pytest.mark.closed_form
def test_a_rotor_that_turns_the_other_way_has_the_mirrored_chart_and_threshold():
    speeds = np.linspace(0.0, 300.0, 7)
    springs = both(LinearBearing(stiffness=1e6, damping=50.0))
    forward, backward = (campbell(friswell(), springs, sense * speeds, 1000.0) for sense in (1.0, -1.0))
    assert_allclose(backward.eigenvalues, forward.eigenvalues, rtol=1e-7)
    assert_allclose(backward.direction[:, 1:], forward.direction[:, 1:], atol=1e-6)
    found = critical_speeds(friswell(), springs, -speeds)
    wanted = critical_speeds(friswell(), springs, speeds)
    assert len(found) > 2
    assert_allclose(sorted(-one.speed for one in found), [one.speed for one in wanted], rtol=1e-9)
    rotor = JeffcottRotor(
        mass=3.0, journal_mass=0.1, stiffness=2e5, speed=0.0, external_damping=30.0, internal_damping=20.0
    )
    onset = rotor_threshold(rotor, {"": LinearBearing(stiffness=1e12)}, [0.0, -400.0, -800.0])
    assert onset.speed == pytest.approx(-2.5 * math.sqrt(2e5 / 3.0), rel=1e-5)
    assert onset.whirl_ratio == pytest.approx(0.4, rel=1e-5)
    assert onset.direction > 0.9


def test_whirl_that_nothing_damps_or_drives_is_stable():
    found = rotor_threshold(friswell(), both(SPRING), np.linspace(0.0, 700.0, 8))
    assert found.reason == "stable at every speed given"


@pytest.mark.closed_form
@pytest.mark.parametrize("bearings", [{}, {"left": LinearBearing(stiffness=0.0)}])
def test_free_shaft_has_its_bending_modes_and_no_others(bearings):
    """A slender steel bar without weight: (4.730040745, 7.853204624)^2 sqrt(E I / (rho A)) / L^2."""
    piece = ShaftElement(length=1.5, outer_diameter=0.01, material=STEEL, shear_coefficient=math.inf)
    bar = friswell(elements=piece.split(6), disks=(), unbalances=(), gravity=(0.0, 0.0))
    modes = rotor_modes(bar, bearings, 0.0)
    wanted = np.array([4.730040745, 7.853204624]) ** 2 * math.sqrt(211e9 / 7810.0) * 0.01 / 4.0 / 1.5**2
    assert_allclose(modes.frequency[:4], np.repeat(wanted, 2), rtol=2e-3)
    assert rotor_threshold(bar, bearings, [0.0, 10.0]).reason == "stable at every speed given"


@pytest.mark.closed_form
def test_free_gyroscope_nutates_at_the_ratio_of_its_inertias():
    modes = rotor_modes(rigid_shaft(unbalances=(), gravity=(0.0, 0.0)), {}, 100.0)
    assert_allclose(modes.frequency, [100.0 * 0.5 / 0.8], rtol=1e-9)
    with pytest.raises(EquilibriumError, match=r"bearings must hold the rotor, got \[\]"):
        rotor_modes(rigid_shaft(), {}, 100.0)


@pytest.mark.parametrize("speeds", [[], [0.0, 0.0], [2.0, 1.0, 3.0], [[1.0]], 5.0])
def test_speeds_must_rise_or_fall(speeds):
    with pytest.raises(InputError, match="speeds must be a list of rising or of falling numbers"):
        campbell(friswell(), both(SPRING), speeds)
    with pytest.raises(InputError, match="speeds must be a list of rising or of falling numbers"):
        rotor_threshold(friswell(), both(SPRING), speeds)


@pytest.mark.parametrize("speeds", [[], [0.0, 1.0], [2.0, 1.0], [[1.0]], 5.0])
def test_speeds_of_a_response_must_be_positive_and_rising(speeds):
    with pytest.raises(InputError, match=r"speeds must (be|rise)"):
        unbalance_response(friswell(), both(SPRING), speeds)


def test_response_needs_an_unbalance():
    with pytest.raises(InputError, match="rotor must have an unbalance"):
        unbalance_response(friswell(unbalances=()), both(SPRING), [1.0])


@pytest.mark.closed_form
def test_other_analyses_know_a_mounted_rotor_by_its_signals():
    """closed_loop and python-control's own linearize give the poles of rotor_system."""
    speed = 150.0
    rotor = friswell(speed=speed, stations=(Station(node=0, name="left"), Station(node=6)))
    films = {"left": FILM, "": FILM}
    at = rotor_equilibrium(rotor, films, speed)
    rest = (*at.displacement, *(0.0 * at.displacement))
    model = mount(replace(rotor, initial=rest), {"left": FILM})
    wanted = np.sort_complex(rotor_system(rotor, at).poles())
    alone = equilibrium(FILM, at.loads[""], speed)
    assert_allclose(alone.position, at.coefficients[""].position, rtol=1e-6)
    poles = np.sort_complex(closed_loop(model, FILM, alone).poles())
    slow = np.abs(wanted) < 3000.0
    assert_allclose(np.poly(poles[np.abs(poles) < 3000.0]), np.poly(wanted[slow]), rtol=1e-5)
    linear = to_nlsys(mount(model, {"": FILM})).linearize(rest, [])
    assert_allclose(
        np.poly(linear.poles()[np.abs(linear.poles()) < 3000.0]), np.poly(wanted[slow]), rtol=1e-5
    )


def test_the_coupling_of_a_mounted_rotor_has_a_longest_stable_step():
    shaft = rigid_shaft(stations=(("left", -0.4), ("", 0.4)), speed=150.0, unbalances=())
    at = rotor_equilibrium(shaft, {"left": FILM, "": FILM}, 150.0)
    rest = (*at.displacement, *(0.0 * at.displacement))
    model = mount(replace(shaft, initial=rest), {"left": FILM})
    limit = critical_macro_step(model, FILM, state=model.initial_state).macro_step
    assert 1e-5 < limit < 1e-2


@pytest.mark.closed_form
def test_transmissibility_of_two_bearings_is_that_of_the_textbook():
    """sqrt((1 + (2 z s)^2) / ((1 - s^2)^2 + (2 z s)^2)) for a force on both journals, 1 at s = sqrt 2."""
    rotor = rigid_shaft(stations=(("left", -0.4), ("right", 0.4)), gravity=(0.0, 0.0))
    k, c = 2e6, 800.0
    natural, z = np.sqrt(2 * k / rotor.mass), c / np.sqrt(2 * k * rotor.mass)
    ratios = np.array([0.3, 0.9, np.sqrt(2.0), 3.0])
    found = rotor_transmissibility(rotor, both(LinearBearing(stiffness=k, damping=c)), ratios * natural)
    assert found.input_labels == ["left_force_x", "left_force_y", "right_force_x", "right_force_y"]
    assert found.output_labels == [f"{n}_housing_force_{a}" for n in ("left", "right") for a in "xy"]
    together = found.complex[0, 0] + found.complex[0, 2]
    wanted = np.sqrt((1 + (2 * z * ratios) ** 2) / ((1 - ratios**2) ** 2 + (2 * z * ratios) ** 2))
    assert_allclose(np.abs(together), wanted, rtol=1e-9)
    assert abs(together[2]) == pytest.approx(1.0, rel=1e-9)
    assert_allclose(found.complex[1, 0] + found.complex[1, 2], 0.0, atol=1e-12)


@pytest.mark.closed_form
def test_transmissibility_through_a_support_in_series():
    """m u'' + k (u - v) = 1, m_h v'' + k (v - u) + K v = 0: k (u - v) on the housing, K v on the ground."""
    stiff = ElasticMaterial(young_modulus=211e15, shear_modulus=81.2e15, density=7810.0)
    support = Support(mass=30.0, stiffness=4e6)
    rotor = ShaftRotor(
        elements=ShaftElement(length=0.6, outer_diameter=0.05, material=stiff).split(2),
        stations=tuple(
            Station(node=n, name=name, support=support) for n, name in ((0, "left"), (2, "right"))
        ),
        speed=0.0,
        gravity=(0.0, 0.0),
    )
    k, half = 3e6, 0.5 * rotor.mass
    speeds = np.array([50.0, 300.0, 700.0])
    for model in (rotor, reduce_rotor(rotor, frequency=1000.0, tolerance=1e-4).rotor):
        found = rotor_transmissibility(model, both(LinearBearing(stiffness=k)), speeds)
        assert {"right_ground_force_x", "right_ground_force_y"} <= set(found.output_labels)
        for column, w in enumerate(speeds):
            matrix = [[k - half * w**2, -k], [-k, k + 4e6 - 30.0 * w**2]]
            u, v = np.linalg.solve(matrix, [1.0, 0.0])
            by_both = found.complex[:, 0, column] + found.complex[:, 2, column]
            labels = found.output_labels
            assert by_both[labels.index("left_housing_force_x")] == pytest.approx(k * (u - v), rel=1e-4)
            assert by_both[labels.index("left_ground_force_x")] == pytest.approx(4e6 * v, rel=1e-4)


@pytest.mark.closed_form
def test_slow_forces_pass_to_the_housings():
    """Far below all modes the housings feel what acts on the journals; without bearings there is none."""
    films = both(FILM)
    found = rotor_transmissibility(friswell(speed=1.0), films, [1.0])
    assert_allclose(np.abs(found.complex[:, :, 0]), np.eye(4), atol=0.05)
    with pytest.raises((InputError, EquilibriumError)):
        rotor_transmissibility(friswell(), {}, [1.0])


@pytest.mark.closed_form
def test_roundoff_is_no_growth():
    """Nothing damps or drives this shaft: its growth rates are 0, and with skewed springs they are not."""
    speeds = np.linspace(10.0, 500.0, 6)
    chart = campbell(friswell(), both(SPRING), speeds)
    assert np.any(chart.eigenvalues.real > 0.0)
    assert not chart.grows.any()
    assert np.nanmax(chart.roundoff) < 1e-6
    skewed = LinearBearing(stiffness=((1e6, 10.0), (-10.0, 1e6)))
    modes = rotor_modes(friswell(), both(skewed), 100.0)
    assert np.sum(modes.grows) == len(modes.eigenvalues) / 2
    assert not modes.grows[modes.direction < 0.0].any()


@pytest.mark.closed_form
def test_roundoff_of_eigenvalues_is_bounded_by_their_condition():
    """T D T^-1 of integers is known exactly: eigenvalues 1 to 6, the worse the larger T is."""
    rng = np.random.default_rng(3)
    for size in (1, 4, 16):
        T = np.eye(6) + np.tril(rng.integers(-size, size + 1, (6, 6)), -1)
        inverse = np.round(np.linalg.inv(T))
        assert_allclose(T @ inverse, np.eye(6), atol=0.0)
        matrix = T @ np.diag(np.arange(1.0, 7.0)) @ inverse
        values, left, right = eig(matrix, left=True)
        order = np.argsort(values.real)
        wrong = np.abs(values[order] - np.arange(1.0, 7.0))
        assert np.all(wrong <= roundoff(matrix, left, right)[order])


def test_an_unbalance_response_beyond_the_threshold_is_warned_of():
    rotor, films = friswell(), both(FILM)
    threshold = rotor_threshold(rotor, films, np.linspace(50.0, 400.0, 8)).speed
    speeds = threshold * np.array([0.8, 0.9, 0.99, 1.01, 1.1])
    unbalance_response(rotor, films, speeds[:3])
    with pytest.warns(ValidityWarning, match=f"got {speeds[3]:.6g} rad/s and more") as caught:
        unbalance_response(rotor, films, speeds)
    assert len(caught) == 1


def test_a_station_without_bearing_is_named():
    with pytest.raises(EquilibriumError, match=r"free to move; the stations \['right'\] have no"):
        rotor_equilibrium(rigid_shaft(), {"left": SPRING}, 100.0)
