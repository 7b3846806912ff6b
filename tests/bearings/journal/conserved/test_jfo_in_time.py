"""The journal film that conserves its oil as a Stepped model: order, balance of oil, its state, failures."""

import contextlib
import dataclasses
import itertools

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from rotorfilm import ConvergenceError, FilmContactError, Groove, InputError, JFOFilm, JournalBearing, Stepped
from rotorfilm.bearings.films.mass_conserving_steps import ConservedFilmState

R, c, omega = 0.05, 1e-4, 314.0
TOP = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
BEARING = JournalBearing(
    radius=R, length=0.05, clearance=c, viscosity=0.02, grooves=(TOP,), supply_pressure=2e5
)
FILM = JFOFilm(bearing=BEARING, cells=(36, 4))
TURN = 2.0 * np.pi / omega


def motion(t, speed=omega):
    """Return the input of a large orbit that begins smoothly."""
    a, b, nu = 0.3 * c, 0.2 * c, 0.5 * omega
    place = [3e-5 + a * np.sin(nu * t) ** 2, -4e-5 + b * np.sin(nu * t) ** 3]
    rate = [
        2.0 * a * nu * np.sin(nu * t) * np.cos(nu * t),
        3.0 * b * nu * np.sin(nu * t) ** 2 * np.cos(nu * t),
    ]
    return np.array([*place, *rate, speed])


def followed(film, steps, turns=1.0):
    """Return the outputs along the orbit in equal steps, the start included."""
    state, dt = film.start(motion(0.0)), turns * TURN / steps
    outputs = [film.answer(state)]
    for k in range(steps):
        state, output, work = film.step(state, k * dt, motion((k + 1) * dt), dt)
        assert work["steps"] == 1
        outputs.append(output)
    return np.array(outputs).T


def test_is_a_stepped_model():
    assert isinstance(FILM, Stepped)
    assert [s.name for s in FILM.inputs] == ["x", "y", "vx", "vy", "speed"]
    assert [s.name for s in FILM.outputs] == [
        "force_x", "force_y", "side_flow", "drawn_in", "inflow", "oil_volume",
        "mean_side_flow", "mean_drawn_in", "mean_inflow",
    ]  # fmt: skip


@pytest.mark.parametrize("speed", [omega, -omega, 0.0])
def test_starts_with_the_steady_film_and_stays(speed):
    u = np.array([3e-5, -4e-5, 0.0, 0.0, speed])
    state, steady = FILM.start(u), FILM.solve(u[:2], speed)
    found = FILM.answer(state)
    # Transport of second order moves the oil of the cavity within its cells, and the force by little.
    np.testing.assert_allclose(found[:2], steady.force, rtol=2e-3)
    assert found[2] == pytest.approx(steady.side_flow, rel=2e-3)
    for dt in (TURN / 100.0, TURN / 3.0):
        state, output, _ = FILM.step(state, 0.0, u, dt)
        np.testing.assert_allclose(output, found, rtol=1e-8, atol=1e-12 * np.abs(found).max())


@pytest.mark.convergence
def test_steps_are_of_second_order():
    # The impulse of the force, which does not mind at which moment a cell fills.
    impulses = []
    for steps in (96, 192, 384):
        force = followed(FILM, steps, 0.5)[:2]
        impulses.append(0.5 * TURN / steps * (force[:, 1:] + force[:, :-1]).sum(axis=1) / 2.0)
    change = [np.hypot(*(b - a)) for a, b in itertools.pairwise(impulses)]
    assert 1.6 < np.log2(change[0] / change[1]) < 2.6
    assert change[1] < 2e-4 * np.hypot(*impulses[2])


@pytest.mark.closed_form
def test_no_oil_is_made_or_lost():
    steps = 192
    _, _, out, drawn, fed, volume = followed(FILM, steps)[:6]
    stored = (1.5 * volume[2:] - 2.0 * volume[1:-1] + 0.5 * volume[:-2]) * steps / TURN
    assert np.abs(stored).max() > 0.1 * out.max()
    np.testing.assert_allclose(stored, (fed + drawn - out)[2:], atol=1e-10 * out.max())


@pytest.mark.closed_form
@pytest.mark.parametrize("name", ["pressed", "starved", "bathed"])
def test_mean_flows_balance_the_oil_over_steps_of_any_length(name):
    plain = dataclasses.replace(BEARING, grooves=(), supply_pressure=0.0)
    film = {
        "pressed": FILM,
        "starved": JFOFilm(
            bearing=dataclasses.replace(BEARING, supply_pressure=0.0), cells=(36, 4), supply_flow=1.5e-5
        ),
        "bathed": JFOFilm(bearing=plain, cells=(36, 4), cavitation_pressure=-1e5, submerged=True),
    }[name]
    state, t = film.start(motion(0.0)), 0.0
    before = film.answer(state)
    np.testing.assert_array_equal(before[6:], before[2:5])
    pieces = 0
    for share in (1 / 24, 1 / 500, 1 / 7, 1 / 192, 1 / 11, 1 / 150):
        dt = share * TURN
        state, output, work = film.step(state, t, motion(t + dt), dt)
        t, pieces = t + dt, max(pieces, work["steps"])
        out, drawn, fed = output[6:]
        stored = output[5] - before[5]
        assert dt * (fed + drawn - out) == pytest.approx(stored, abs=1e-14 * output[5] + 1e-11 * dt * out)
        trial = film.attempt(state, motion(t + 1e-4), 1e-4)
        out, drawn, fed = trial.output[6:]
        stored = trial.output[5] - output[5]
        assert 1e-4 * (fed + drawn - out) == pytest.approx(stored, abs=1e-14 * output[5] + 1e-15 * out)
        before = output
    assert pieces > 10


@pytest.mark.convergence
def test_mean_flows_are_of_second_order():
    # What leaves in half a turn, in steps that are not those of the shaft.
    passed = [
        [TURN / 2 / steps * followed(FILM, steps, 0.5)[k, 1:].sum() for k in (6, 8)]
        for steps in (96, 192, 384)
    ]
    change = [np.hypot(*np.subtract(b, a)) for a, b in itertools.pairwise(passed)]
    assert 1.6 < np.log2(change[0] / change[1]) < 2.6
    assert change[1] < 1e-3 * np.hypot(*passed[2])


@pytest.mark.closed_form
def test_a_starved_film_in_steps_has_its_dynamic_stiffness():
    # A quarter of the oil that a header at 2 bar gives: the film starts late, and moves with the journal.
    starved = dataclasses.replace(BEARING, supply_pressure=0.0)
    film = JFOFilm(bearing=starved, cells=(60, 4), supply_flow=1.5e-5)
    at, small, nu, steps = np.array([4e-5, -4.5e-5]), 1e-4 * c, 0.5 * omega, 360
    dt, forces = 2.0 * np.pi / nu / steps, []
    state = film.start([*at, 0.0, 0.0, omega])
    for t in dt * np.arange(1, 3 * steps + 1):
        u = [at[0] + small * np.sin(nu * t), at[1], small * nu * np.cos(nu * t), 0.0, omega]
        state, output, _ = film.step(state, t - dt, u, dt)
        forces.append(output[:2])
    phase = np.exp(-1j * nu * dt * np.arange(1, steps + 1))
    seen = -2j / steps / small * (phase @ (np.array(forces[-steps:]) - forces[-1]))
    expected = film.complex_stiffness(at, omega, 1j * nu)
    np.testing.assert_allclose(seen, expected[:, 0], atol=4e-3 * np.abs(expected).max())


@pytest.mark.closed_form
def test_the_slope_is_that_of_the_step():
    state, dt = FILM.start(motion(0.0)), TURN / 96.0
    for k in range(6):
        state = FILM.attempt(state, motion(k * dt), dt).state
    u = motion(6.0 * dt)
    trial = FILM.attempt(state, u, dt, near=state)
    columns = []
    for unit in np.eye(5)[:2]:
        sides = [FILM.attempt(state, u + side * 1e-10 * unit, dt, near=state).output[:2] for side in (1, -1)]
        columns.append((sides[0] - sides[1]) / 2e-10)
    # But for how the limited transport takes the gap, of which the slope knows nothing.
    np.testing.assert_allclose(
        -np.array(columns).T, trial.stiffness, atol=1e-4 * np.abs(trial.stiffness).max()
    )


def changed(state, **parts):
    """Return a state with other rows of its cells, or another motion or length."""
    state = state._replace(numbers=state.numbers.copy())
    if "length" in parts:
        state.numbers[0] = parts.pop("length")
    if "motion" in parts:
        state.motion[:] = parts.pop("motion")
    for name, row in parts.items():
        state.rows[name][:] = row
    return state


def suddenly(film, state, u, velocity, dt):
    """Return the force after an Euler step from the same oil, full cells filled, at u with a velocity."""
    gap = film.film.gap((u[:2] - dt * velocity) / c).line
    full = state.rows["full"] != 0.0
    content = np.where(full, gap, state.rows["content"])
    theta = np.where(full, 1.0, state.rows["theta"])
    # A state near the step, whose theta says nothing of limited transport.
    near = changed(state, theta=1.0)
    return film.attempt(changed(state, content=content, length=0.0, theta=theta), u, dt, near).output[:2]


@pytest.mark.closed_form
@pytest.mark.parametrize("flow", [None, 1.5e-5])
def test_sudden_slopes_are_those_of_moves_with_the_same_oil(flow):
    # In a step of next to no length cavity cells keep their oil; a given flow starves its opening. The slopes
    # know nothing of limited transport.
    fed = dataclasses.replace(BEARING, supply_pressure=0.0 if flow else 2e5)
    film, u, dt = JFOFilm(bearing=fed, cells=(36, 4), supply_flow=flow), motion(0.0), 1e-6 * TURN
    found, none = film.film.solve(film.film.gap(u[:2] / c), 0.5 * omega), np.zeros(2)
    rows = found.content, found.content, *found.solution[:3]
    numbers = np.concatenate([[0.0], u, np.zeros(12), *(row.ravel() for row in rows)])
    state = ConservedFilmState(numbers, found.content.shape)
    moves = [(np.eye(5)[k] * 1e-9, none) for k in (0, 1)]
    moves += [(np.zeros(5), 1e-6 * unit) for unit in np.eye(2)]
    moves += [(np.eye(5)[4] * 1e-3 * omega, none)]
    for column, (by, velocity) in enumerate(moves):
        sides = [suddenly(film, state, u + s * by, s * velocity, dt) for s in (1.0, -1.0)]
        size = by[column] if by.any() else velocity.max()
        found = (sides[0] - sides[1]) / (2.0 * size)
        expected = film.slopes(state)[:, column]
        np.testing.assert_allclose(found, expected, atol=1e-4 * np.abs(expected).max())


@pytest.mark.closed_form
def test_a_full_film_feels_the_velocity_as_damping():
    # Full all round, the film is linear in velocity, with the exact damping dK/ds.
    plain = JournalBearing(radius=R, length=0.05, clearance=c, viscosity=0.02)
    film = JFOFilm(bearing=plain, cells=(36, 4), cavitation_pressure=-1e9, submerged=True)
    outputs = followed(film, 384)
    for k in (50, 125, 300):
        u = motion(k * TURN / 384)
        C = film.slow_coefficients(u[:2], omega).damping
        expected = film.force(u[:2], [0.0, 0.0], omega) - C @ u[2:4]
        np.testing.assert_allclose(outputs[:2, k], expected, atol=1e-3 * np.hypot(*outputs[:2]).max())


def between(begin, end, dt, share):
    """Return the motion on the cubic between two, by scipy."""
    way = CubicHermiteSpline([0.0, dt], [begin[:2], end[:2]], [begin[2:4], end[2:4]])
    speed = begin[4] + share * (end[4] - begin[4])
    return np.concatenate([way(share * dt), way(share * dt, 1), [speed]])


def test_long_steps_are_divided_along_the_cubic():
    state, dt = FILM.start(motion(0.0)), TURN / 16.0
    whole, output, work = FILM.step(state, 0.0, motion(dt), dt)
    assert work["steps"] == 12
    means = np.zeros(3)
    for k in range(1, 13):
        state, piece, _ = FILM.step(state, 0.0, between(motion(0.0), motion(dt), dt, k / 12.0), dt / 12.0)
        means += piece[6:] / 12.0
    np.testing.assert_allclose([*FILM.answer(state)[:6], *means], output, rtol=1e-12)
    np.testing.assert_array_equal(whole.motion, motion(dt))


def test_a_state_goes_through_bytes_to_the_last_bit():
    state = FILM.start(motion(0.0))
    for k in range(1, 4):
        state, _, _ = FILM.step(state, 0.0, motion(k * TURN / 200.0), TURN / 200.0)
    again = FILM.unpack(FILM.pack(state))
    ends = [FILM.step(each, 0.0, motion(4.0 * TURN / 200.0), TURN / 200.0)[0] for each in (state, again)]
    assert FILM.pack(ends[0]) == FILM.pack(ends[1])
    other = JFOFilm(bearing=BEARING, cells=(40, 4))
    with pytest.raises(InputError, match=r"content must be of \(40, 6\) cells, got \(36, 6\)"):
        other.unpack(FILM.pack(state))


def test_a_step_that_fails_leaves_the_state():
    state, near_wall = FILM.start(motion(0.0)), np.array([1.2 * c, 0.0, 0.0, 0.0, omega])
    before = FILM.pack(state)
    with pytest.raises(FilmContactError, match=r"at t = 0.001 s"):
        FILM.step(state, 0.0, near_wall, 1e-3)
    # On the cubic between two places inside the clearance the journal may be at the wall.
    wild = np.array([3e-5, -4e-5, 0.5, 0.0, omega])
    with pytest.raises(
        FilmContactError, match=r"inside the clearance 0.0001 m, got an eccentricity of .* at t ="
    ):
        FILM.step(state, 0.0, wild, 2e-3)
    assert FILM.pack(state) == before


def test_steps_whose_film_is_not_found_are_halved():
    # In a step longer than any age a cell without flow holds back so little that it has no pivot.
    film = JFOFilm(bearing=dataclasses.replace(BEARING, supply_pressure=0.0), cells=(36, 4))
    u = np.array([3e-5, -4e-5, 0.0, 0.0, 0.0])
    state = changed(film.start([*u[:4], omega]), motion=u)
    assert film.step(state, 0.0, u, 1e150)[2]["steps"] == 1
    with pytest.raises(ConvergenceError, match="the ruptured zone of a mass-conserving film did not end"):
        film.step(state, 0.0, u, 1e170)
    halved = []
    for dt in 10.0 ** np.arange(152.0, 161.0, 0.1):  # where pivots are at the edge of what numbers hold
        with contextlib.suppress(ConvergenceError):
            end, _, work = film.step(state, 0.0, u, dt)
            halved += [(dt, work["steps"], end)] if work["steps"] > 1 else []
    dt, pieces, end = halved[0]
    assert pieces in (2, 4, 8, 16)
    for _ in range(pieces):
        state = film.step(state, 0.0, u, dt / pieces)[0]
    state.output[6:] = end.output[6:]  # mean flows, over all pieces
    assert film.pack(state) == film.pack(end)


def test_arguments_break_a_rule():
    state = FILM.start(motion(0.0))
    for u, match in (([0.0] * 4, r"u must have shape \(5,\)"), ([np.nan] * 5, "u must be finite")):
        with pytest.raises(InputError, match=match):
            FILM.start(u)
        with pytest.raises(InputError, match=match):
            FILM.step(state, 0.0, u, 1e-4)
    with pytest.raises(InputError, match=r"dt must be finite and positive, got -1\.0"):
        FILM.step(state, 0.0, motion(0.0), -1.0)
    with pytest.raises(FilmContactError):
        FILM.start([c, 0.0, 0.0, 0.0, omega])
    assert FILM.step(state, 0.0, motion(0.0), 0.0)[0] is state
