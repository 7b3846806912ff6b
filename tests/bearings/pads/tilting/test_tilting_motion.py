"""Tilting pads in motion: derivatives, orbits and their coefficients, pads that lift and return, inertia."""

import math
import warnings
from dataclasses import replace

import numpy as np
import pytest

from rotorfilm import (
    Dynamic,
    FilmContactError,
    OperatingPoint,
    Reaction,
    RigidRotor,
    ValidityWarning,
    coefficients,
    equilibrium,
    export_fmu,
    linearize,
    simulate,
    whirl_threshold,
)
from rotorfilm.bearings.pads.pads_at_rest import directions
from rotorfilm.core import UndefinedDerivativeError

SPEED = 300.0
KINDS = {
    "massless": {},
    "inertia": {"pad_inertia": 3e-4},
    "springs": {"pivot_stiffness": 6e8},
    "springs and inertia": {"pivot_stiffness": 6e8, "pad_inertia": 3e-4, "pad_mass": 0.2},
}


def turning(bearing, load, mass, unbalance=0.0, moved=(0.0, 0.0), start=None):
    """Return rest, rotor and bearing that start there, or moved by so many clearances of a pad."""
    unit = bearing.force_scale * SPEED
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        at = equilibrium(bearing, [0.0, -load * unit], SPEED)
    c = bearing.clearance
    mass *= unit / (c * SPEED**2)
    rotor = RigidRotor(
        mass=mass,
        speed=SPEED,
        unbalance=unbalance * mass * c,
        gravity=(0.0, 0.0),
        static_force=(0.0, -load * unit),
        position=tuple(at.position + c * np.array(moved)),
    )
    return at, rotor, replace(bearing, start=tuple(at.pads.tilts if start is None else start))


def state_of(bearing, rng):
    """Return an input and a state with every pad in its film and moving."""
    x = bearing.at_rest().state([2e-6, -3e-6], SPEED)
    x = x + 0.01 * rng.normal(size=len(x)) * np.array([signal.nominal for signal in bearing.states])
    return np.array([2e-6, -3e-6, 2e-4, -1e-4, 1.1 * SPEED]), x


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_are_exact(smooth, kind):
    bearing = smooth(**KINDS[kind])
    assert isinstance(bearing, Dynamic)
    assert isinstance(bearing, Reaction)
    u, x = state_of(bearing, np.random.default_rng(4))
    found = bearing.linearization(0.0, x, u)
    split, point = len(x), np.concatenate([x, u])
    sizes = np.array([signal.nominal for signal in (*bearing.states, *bearing.inputs)])
    whole = np.block([[found.A, found.B], [found.C, found.D]])

    def answer(at):
        return np.concatenate([f(0.0, at[:split], at[split:]) for f in (bearing.derivative, bearing.output)])

    for column, size in enumerate(sizes):
        step = np.zeros_like(point)
        step[column] = 1e-6 * size
        slope = (answer(point + step) - answer(point - step)) / 2e-6
        scale = np.abs(whole * sizes).max(axis=1)
        np.testing.assert_allclose(whole[:, column] * size / scale, slope / scale, atol=2e-8)


@pytest.mark.parametrize("kind", KINDS)
def test_rest_is_at_rest_and_modes_are_those_of_the_linearization(smooth, kind):
    bearing, place, mass = smooth(**KINDS[kind]), np.array([2e-6, -3e-6]), 40.0
    rest = bearing.at_rest()
    x, u = rest.state(place, SPEED), np.array([*place, 0.0, 0.0, SPEED])
    scale = np.abs(bearing.linearization(0.0, x, u).A).max() * 1e-4
    assert np.abs(bearing.derivative(0.0, x, u)).max() < 1e-9 * scale
    np.testing.assert_allclose(bearing.output(0.0, x, u)[:2], rest.force(place, [0.0, 0.0], SPEED), rtol=1e-9)
    A, B, C, D = bearing.linearization(0.0, x, u)
    joined = np.block(
        [
            [np.zeros((2, 2)), np.eye(2), np.zeros((2, len(x)))],
            [D[:2, :4] / mass, C[:2] / mass],
            [B[:, :4], A],
        ]
    )
    expected, found = np.linalg.eigvals(joined), rest.modes(place, SPEED, mass)
    np.testing.assert_allclose(
        np.sort_complex(found), np.sort_complex(expected), atol=1e-9 * abs(expected).max()
    )


@pytest.mark.filterwarnings("ignore:pads .* are unloaded")
@pytest.mark.parametrize("speed", [SPEED, -SPEED])
@pytest.mark.parametrize("kind", KINDS)
def test_linearization_at_rest_is_that_of_assembled_matrices_without_unloaded_pads(tilting, kind, speed):
    bearing, place = tilting(4, 0.5, 75.0, 0.0, first=45.0, **KINDS[kind]), np.array([2e-6, -5e-5])
    matrices = bearing.at_rest().matrices(place, speed)
    assert matrices.unloaded.sum() == 2
    found, expected = bearing.rest_linearization(place, speed), matrices.linearization()
    for one, other, felt in zip(found, expected, (0.0, 0.0, 1.0, 1.0), strict=True):
        size = max(felt * np.abs(matrices.stiffness).max(), np.abs(other).max())
        np.testing.assert_allclose(one, other, atol=1e-11 * size, rtol=0.0)
    with pytest.raises(UndefinedDerivativeError, match="speed must not be 0"):
        bearing.rest_linearization(place, 0.0)


def test_held_pads_have_exact_derivatives_and_no_own_motion(smooth):
    bearing = replace(smooth(), start=(1e-6, 2e-6, -1e-6))
    q, v = np.array([[2e-6, 1e-6], [-3e-6, 2e-6]]), np.array([[1e-4, 0.0], [0.0, 2e-4]])
    slopes = bearing.jacobian(q, v, SPEED)
    sizes = [1e-4, 1e-4, 0.01, 0.01, 100.0]
    for k, size in enumerate(sizes):
        step = np.zeros(5)
        step[k] = 1e-6 * size
        a, b = (
            bearing.force(q + s * step[:2, None], v + s * step[2:4, None], SPEED + s * step[4])
            for s in (1.0, -1.0)
        )
        np.testing.assert_allclose(
            slopes[:, k] * size, (a - b) / 2e-6, atol=1e-7 * np.abs(slopes[:, k] * size).max()
        )
    np.testing.assert_array_equal(slopes[:, :, 1], bearing.jacobian(q[:, 1], v[:, 1], SPEED))


@pytest.mark.parametrize("kind", ["massless", "inertia"])
def test_small_orbit_is_that_of_the_synchronous_coefficients(smooth, kind):
    bearing, load, mass, unbalance = smooth(**KINDS[kind]), 0.3, 2.0, 1e-4
    at, rotor, started = turning(bearing, load, mass, unbalance)
    felt = coefficients(bearing, at.position, SPEED)
    Z = felt.stiffness + 1j * SPEED * felt.damping - rotor.mass * SPEED**2 * np.eye(2)
    expected = np.linalg.solve(Z, rotor.unbalance * SPEED**2 * np.array([1.0, -1.0j]))
    turn, turns, per = 2.0 * math.pi / SPEED, 16, 64
    times = turn * (turns - 1 + np.arange(per) / per)
    run = simulate(rotor, started, duration=turns * turn, times=times, rtol=1e-9)
    found = 2.0 * (run.position @ np.exp(-1j * SPEED * times)) / per
    np.testing.assert_allclose(found, expected, atol=1e-4 * np.abs(expected).max())


def test_journal_in_time_is_where_another_program_has_it(tilting):
    """Four pads, M 2, unbalance force .05 M: r/c = (-.0067, -.1161) at 3 rad by a prototype."""
    bearing = tilting(4, 0.7, 75.0, 0.5, first=45.0, cells=(32, 4))
    at = equilibrium(bearing, [0.0, -bearing.force_scale * SPEED], SPEED)
    # It starts with the tilts that the pads had, seen by the journal at rest.
    seen = at.pads.tilts + directions(bearing.pivots)[:, :, 1] @ at.position
    _, rotor, started = turning(bearing, 1.0, 2.0, 0.05, (0.05, 0.05), seen)
    run = simulate(rotor, started, duration=3.0 / SPEED, samples=2, rtol=1e-7)
    np.testing.assert_allclose(run.position[:, -1] / 1e-4, [-0.0067, -0.1161], atol=1e-4)


@pytest.mark.long
def test_pads_lift_and_return_and_idle_tilts_do_not_matter(tilting):
    """Under unbalance, from two sets of tilts one orbit, though idle pads differ."""
    bearing = tilting(5, 0.5, 60.0, 0.0, first=270.0, cells=(16, 4))
    runs = []
    for shift in (0.0, -0.3):
        at, rotor, started = turning(bearing, 0.6, 2.0, 0.2)
        tilts = np.array(started.start) + shift * 1e-4 * at.pads.unloaded
        started = replace(started, start=tuple(tilts))
        runs.append(simulate(rotor, started, duration=40.0 / SPEED, samples=401, rtol=1e-6))
    last = slice(-63, None)
    np.testing.assert_allclose(runs[0].position[:, last], runs[1].position[:, last], atol=1e-4 * 1e-4)
    idle = [abs(runs[0][f"tilt_{k}"] - runs[1][f"tilt_{k}"])[last].min() for k in (3, 4)]
    assert min(idle) > 1e-2 * 1e-4
    loads = np.array([runs[0][f"load_{k}"] for k in range(1, 6)])[:, 100:]
    returning = (loads.min(axis=1) == 0.0) & (loads.max(axis=1) > 0.0)
    assert returning.any()
    assert (loads >= 0.0).all()


def test_inertia_tends_to_none_linearly(smooth):
    ends = []
    for inertia in (None, 4e-5, 2e-5, 1e-5):
        _, rotor, started = turning(smooth(pad_inertia=inertia), 0.3, 2.0, 0.02)
        run = simulate(rotor, started, duration=6.0 / SPEED, samples=2, rtol=1e-9)
        ends.append(run.position[:, -1])
    apart = [np.linalg.norm(end - ends[0]) for end in ends[1:]]
    assert apart[0] / apart[1] == pytest.approx(2.0, rel=0.1)
    assert apart[1] / apart[2] == pytest.approx(2.0, rel=0.1)


def test_pivot_behind_the_film_counts_by_the_inertia_alone(smooth):
    near = smooth(pad_inertia=3e-4, pivot_distance=0.02)
    far = smooth(pad_inertia=3e-4 * (0.06 / 0.07) ** 2, pivot_distance=0.01)
    u, x = state_of(near, np.random.default_rng(5))
    np.testing.assert_allclose(far.derivative(0.0, x, u), near.derivative(0.0, x, u), rtol=1e-12)


def test_idle_pad_keeps_its_tilt_until_a_film_pushes_it(tilting):
    """w_n <= 0 leaves the tilts without film to choose from: the nearest to rest."""
    one = tilting(1, 0.5, 60.0, -0.3, first=0.0)
    rest = one.at_rest().state([0.0, 0.0], SPEED)
    b = math.pi / 6.0
    assert rest[0] == pytest.approx(-0.3 * math.tan(b) * 1e-4, rel=1e-12)
    u = np.array([0.0, 0.0, 0.0, 0.0, SPEED])
    # Between both ends nothing moves it; above the end it is pushed back to it, never beyond.
    assert one.derivative(0.0, rest - 5e-6, u)[0] == 0.0
    above = one.derivative(0.0, rest + 5e-6, u)[0]
    xi, eta = -0.3, (rest[0] + 5e-6) / 1e-4
    idle = -0.5 * SPEED * eta / math.tan(b)
    assert above == pytest.approx(1e-4 * (idle + 0.5 * SPEED * xi), rel=1e-12)
    assert above < 0.0
    assert one.output(0.0, rest + 5e-6, u)[2] == 0.0


def test_touched_pad_is_named_in_motion(tilting):
    one = tilting(4, 0.7, 75.0, 0.5, first=45.0)
    x = one.initial_state + np.array([0.0, 2e-4, 0.0, 0.0])
    with pytest.raises(FilmContactError, match=r"pad 2 \(pivot at 135 deg\)"):
        one.derivative(0.0, x, [0.0, 0.0, 0.0, 0.0, SPEED])


@pytest.mark.long
def test_thresholds_of_light_pads_and_none_of_preloaded_ones(tilting):
    light = tilting(5, 0.5, 60.0, 0.0, first=270.0, cells=(16, 4))
    unit = light.force_scale * SPEED
    mass, load = unit / (1e-4 * SPEED**2), np.array([0.0, -0.05 * unit])
    onset = whirl_threshold(light, load, mass, (200.0, 600.0))
    # A light pad has no damping below about half the frequency of the shaft.
    assert 0.3 < onset.whirl_ratio < 0.5
    least = light.at_rest().modes(onset.equilibrium.position, onset.speed, mass)[0]
    assert abs(least.real) < 1e-8 * abs(least)
    firm = tilting(4, 0.7, 75.0, 0.5, first=45.0, cells=(16, 4))
    none = whirl_threshold(firm, [0.0, -firm.force_scale * SPEED], mass, (100.0, 1000.0))
    assert not none.exists
    assert none.reason.startswith("stable at every speed")


def test_it_is_linearized_and_exported(tilting, tmp_path):
    fmpy = pytest.importorskip("fmpy")
    bearing = tilting(5, 0.5, 60.0, 0.3, first=270.0, cells=(16, 4))
    at, _, started = turning(bearing, 0.6, 2.0)
    u = np.array([*at.position, 0.0, 0.0, SPEED])
    system = linearize(started, OperatingPoint(x=started.initial_state, u=u))
    assert system.state_labels == [f"tilt_{k}" for k in range(1, 6)]
    path = export_fmu(started, tmp_path / "pads.fmu")
    description = fmpy.read_model_description(str(path))
    names = {one.name for one in description.modelVariables}
    assert any(name.endswith("tilt_5") for name in names)
    assert any(name.endswith("load_1") for name in names)
