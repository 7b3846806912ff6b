"""Rotors on a film that conserves its oil, in time: order, orbits, balances, what goes wrong."""

import dataclasses
import itertools
from typing import ClassVar

import numpy as np
import pytest

from rotorfilm import (
    ContactError,
    ConvergenceError,
    Disk,
    ElasticMaterial,
    Groove,
    InputError,
    JeffcottRotor,
    JFOFilm,
    JournalBearing,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Unbalance,
    as_reaction,
    equilibrium,
    simulate,
)
from rotorfilm.analysis.stepped_run import StepError, _stepped, stations_of

R, c, mu, omega, mass = 0.05, 1e-4, 0.02, 314.0, 250.0
TOP = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
BEARING = JournalBearing(
    radius=R, length=0.05, clearance=c, viscosity=mu, grooves=(TOP,), supply_pressure=2e5
)
FILM = JFOFilm(bearing=BEARING, cells=(36, 4))
TURN = 2.0 * np.pi / omega


@pytest.fixture(scope="module")
def rest():
    return equilibrium(FILM, [0.0, -9.80665 * mass], omega).position


def rotor(rest, unbalance=0.2, **given):
    size = {"mass": mass, "speed": omega, "unbalance": unbalance * c * mass, "position": tuple(rest)}
    return RigidRotor(**{**size, **given})


@pytest.mark.convergence
def test_a_coupled_run_is_of_second_order(rest):
    end = 0.5 * TURN
    times = np.linspace(0.0, end, 13)
    runs = [simulate(rotor(rest), FILM, duration=end, times=times, max_step=end / n) for n in (24, 48, 96)]
    change = [np.abs(b.position - a.position).max() / c for a, b in itertools.pairwise(runs)]
    assert 1.7 < np.log2(change[0] / change[1]) < 2.3
    assert change[1] < 4e-4
    work = runs[2].work
    assert work["steps"] == 96
    assert work["restarts"] == 0
    assert work["newton_steps"] < 4.5 * 96


@pytest.mark.closed_form
def test_a_small_orbit_is_that_of_the_dynamic_stiffness(rest):
    small, start = 1e-4, np.concatenate([rest, [0.0, 0.0]])
    held = -FILM.start([*start, omega]).output[:2]
    K = FILM.complex_stiffness(rest, omega, 1j * omega)
    pull = small * c * mass * omega**2 * np.array([1.0, -1j])
    amplitude = np.linalg.solve(K - mass * omega**2 * np.eye(2), pull)
    moving = start + np.concatenate([amplitude.real, -omega * amplitude.imag])
    turning = rotor(rest, small, gravity=(0.0, 0.0), static_force=tuple(held))
    turns, n = 2, 216
    found = simulate(
        turning, FILM, duration=turns * TURN, initial_state=moving, max_step=TURN / n,
        times=TURN * (turns - 1 + np.arange(n) / n),
    )  # fmt: skip
    seen = 2.0 * (found.position @ np.exp(-1j * omega * found.time)) / n
    assert np.abs(seen - amplitude).max() < 1e-3 * np.abs(amplitude).max()


def full_film():
    """Return a film full all round, and the same as a reaction: its force is linear in the velocity."""
    plain = JournalBearing(radius=R, length=0.05, clearance=c, viscosity=mu)
    film = JFOFilm(bearing=plain, cells=(36, 4), cavitation_pressure=-1e9, submerged=True)

    def force(x, y, vx, vy, speed):
        C = film.slow_coefficients((x, y), speed).damping
        return film.force((x, y), (0.0, 0.0), speed) - C @ np.array([vx, vy])

    return film, as_reaction(force, clearance=c)


@pytest.mark.convergence
def test_a_run_up_on_a_full_film_is_that_of_ordinary_differential_equations():
    film, same = full_film()
    end = 0.5 * TURN
    profile = SpeedProfile(times=(0.0, end), speeds=(0.6 * omega, omega))
    turning = RigidRotor(
        mass=20.0, speed=profile, unbalance=0.3 * c * 20.0, gravity=(0.0, 0.0), position=(1e-5, -2e-5)
    )
    times = np.linspace(0.0, end, 9)
    exact = simulate(turning, same, duration=end, times=times, rtol=1e-6)
    errors = []
    for n in (30, 60):
        found = simulate(turning, film, duration=end, times=times, max_step=end / n)
        errors.append(np.abs(found.position - exact.position).max() / c)
    assert errors[1] < 1e-3
    assert 1.6 < np.log2(errors[0] / errors[1]) < 2.6


@pytest.mark.convergence
def test_impulse_and_work_are_in_balance(rest):
    n = 120
    turning = rotor(rest)
    found = simulate(turning, FILM, duration=TURN, samples=n + 1, max_step=TURN / n)
    pull = np.array([turning.unbalance_force(t) + turning.static_load for t in found.time]).T
    force = np.stack([found["force_x"], found["force_y"]]) + pull
    v, dt = found.velocity, TURN / n
    gained = dt * (force.sum(axis=1) - 0.5 * (force[:, 0] + force[:, -1]))
    scale = dt * np.abs(force).sum()
    np.testing.assert_allclose(mass * (v[:, -1] - v[:, 0]), gained, atol=2e-3 * scale)
    power = np.sum(force * v, axis=0)
    work = dt * (power.sum() - 0.5 * (power[0] + power[-1]))
    energy = 0.5 * mass * np.sum(v**2, axis=0)
    assert energy[-1] - energy[0] == pytest.approx(work, abs=2e-3 * dt * np.abs(power).sum())


def test_flexible_rotors_that_are_stiff_are_rigid(rest):
    # Half the mass in the journal and a stiff shaft to the disk; and a shaft on two films, by symmetry.
    times = np.linspace(0.0, 0.25 * TURN, 5)
    given = {"duration": 0.25 * TURN, "times": times, "max_step": TURN / 48}
    rigid = simulate(rotor(rest), FILM, **given)
    still = [rest[0], rest[0], rest[1], rest[1], 0.0, 0.0, 0.0, 0.0]
    jeffcott = JeffcottRotor(
        mass=0.5 * mass, journal_mass=0.5 * mass, stiffness=1e13, speed=omega,
        unbalance=0.2 * c * mass, initial=tuple(still),
    )  # fmt: skip
    found = simulate(jeffcott, FILM, **given)
    assert np.abs(found.position - rigid.position).max() < 1e-3 * c


def test_a_shaft_takes_a_film_in_each_station():
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    pieces = ShaftElement(length=0.5, outer_diameter=0.1, material=steel).split(4)
    ends = (Station(node=0, name="left"), Station(node=4, name="right"))
    shaft = ShaftRotor(elements=pieces, stations=ends, speed=omega)
    given = {"duration": 0.1 * TURN, "samples": 3, "max_step": TURN / 96}
    found = simulate(shaft, {"left": FILM, "right": FILM}, **given)
    np.testing.assert_allclose(found["left_y"], found["right_y"], rtol=1e-6)
    np.testing.assert_allclose(found["left_force_y"], found["right_force_y"], rtol=1e-6)
    assert found["left_y"][-1] < 0.0
    assert found.units["right_oil_volume"] == "m3"
    with pytest.raises(InputError, match="reaction must be films in all stations of the rotor"):
        simulate(shaft, {"left": FILM}, **given)
    with pytest.raises(InputError, match="rotor must have the outputs"):
        simulate(shaft, FILM, **given)
    with pytest.raises(InputError, match=r"reaction\['right'\] must be a film with a time step of its own"):
        simulate(shaft, {"left": FILM, "right": BEARING}, **given)


@pytest.mark.parametrize("fails", [False, True], ids=["to its end", "to the wall"])
def test_a_long_shaft_steps_in_few_of_its_shapes(fails):
    """Within 1e-5 of the clearance of the steps of all of it, also where it reaches the wall."""
    steel = ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7850.0)
    shaft = ShaftRotor(
        elements=ShaftElement(length=1.2, outer_diameter=0.08, material=steel).split(24),
        disks=(Disk(node=12, mass=80.0, diametral_inertia=0.8, polar_inertia=1.5),),
        stations=(Station(name="left", node=0), Station(name="right", node=24)),
        unbalances=(Unbalance(node=12, unbalance=50.0 if fails else 2e-3),),
        speed=omega,
    )
    film = JFOFilm(bearing=dataclasses.replace(BEARING, viscosity=0.05), cells=(36, 4))
    films, times = {"left": film, "right": film}, np.linspace(0.0, (1.0 if fails else 0.25) * TURN, 9)
    step = TURN / 96
    try:
        few = simulate(shaft, films, duration=times[-1], times=times, max_step=step)
        assert not fails
    except ContactError as wall:
        assert fails
        few = wall.partial
    stations = stations_of(shaft, films)
    whole, _, failure = _stepped(shaft, stations, times, times[-1], shaft.initial_state, step)
    assert (failure is not None) is fails
    assert list(few.signals) == list(whole.signals)
    assert len(few.time) == len(whole.time)
    for name in ("left_x", "left_y", "right_x", "right_y"):
        assert np.abs(few[name] - whole[name]).max() < 1e-5 * c
    if not fails:
        assert few.step_error == pytest.approx(whole.step_error, rel=1e-2)


def test_the_wall_ends_a_run_with_what_there_is(rest):
    thrown = rotor(rest, static_force=(0.0, -1e9))
    with pytest.raises(ContactError, match="journal reached the wall") as caught:
        simulate(thrown, FILM, duration=TURN, samples=2000, max_step=TURN / 96)
    assert 2 < caught.value.partial.time.size < 200
    assert np.all(np.isfinite(caught.value.partial["force_y"]))


class Shy(JFOFilm):
    """A film that is not found in a long step after some time."""

    def attempt(self, state, u, dt, near=None):
        if u[0] > 3.3e-5 and dt > TURN / 150.0:
            raise ConvergenceError("too long")
        return super().attempt(state, u, dt, near)


class Watched(Shy):
    """A film that keeps the lengths of its steps."""

    lengths: ClassVar[set[float]] = set()

    def attempt(self, state, u, dt, near=None):
        self.lengths.add(dt)
        return super().attempt(state, u, dt, near)


def test_halved_steps_leave_no_step_of_round_off(rest):
    film = Watched(bearing=BEARING, cells=(24, 4))
    simulate(rotor(rest), film, duration=0.5 * TURN, times=[0.0, 0.5 * TURN], max_step=TURN / 97)
    assert 2 <= len({round(97 * length / TURN, 6) for length in film.lengths}) <= 3
    assert min(film.lengths) > TURN / 97 / 10


def test_steps_that_fail_are_halved_and_said(rest):
    times = np.linspace(0.0, 0.5 * TURN, 7)
    shy = Shy(bearing=BEARING, cells=(36, 4))
    given = {"duration": 0.5 * TURN, "times": times, "max_step": TURN / 96}
    found, plain = (simulate(rotor(rest), each, **given) for each in (shy, FILM))
    assert found.work["restarts"] > 0
    assert found.work["steps"] > 48
    assert np.abs(found.position - plain.position).max() < 1e-3 * c


def test_a_film_that_is_lost_ends_a_run_with_what_there_is(rest):
    class Lost(JFOFilm):
        def attempt(self, state, u, dt, near=None):
            if u[1] < rest[1] - 2e-6:
                raise ConvergenceError("lost")
            return super().attempt(state, u, dt, near)

    with pytest.raises(ConvergenceError, match="lost") as caught:
        simulate(rotor(rest), Lost(bearing=BEARING, cells=(36, 4)), duration=TURN, max_step=TURN / 48)
    partial = caught.value.partial
    assert 2 < partial.time.size < 1001
    assert partial["y"].min() > rest[1] - 2.1e-6


def test_arguments_break_a_rule(rest):
    from scipy.integrate import Radau

    with pytest.raises(InputError, match="method must be None for films that step"):
        simulate(rotor(rest), FILM, duration=TURN, method=Radau)
    with pytest.raises(InputError, match=r"initial_state must have shape \(4,\), got \(3,\)"):
        simulate(rotor(rest), FILM, duration=TURN, initial_state=np.zeros(3))
    with pytest.raises(InputError, match="max_step must be positive"):
        simulate(rotor(rest), FILM, duration=TURN, max_step=0.0)
    still = dataclasses.replace(rotor(rest, 0.0), speed=0.0)
    with pytest.raises(InputError, match="max_step must be given"):
        simulate(still, FILM, duration=1e-4, samples=2)
    assert simulate(still, FILM, duration=1e-4, samples=2, max_step=2e-5).work["steps"] == 5


def on_circle(nu, times):
    """Return the motion of a journal on a circle, shape (n, 1, 5)."""
    z, a = 0.3 * c * np.exp(1j * nu * times), 1j * nu
    return np.stack([z.real, z.imag, (a * z).real, (a * z).imag, 0.0 * times], axis=-1)[:, None]


@pytest.mark.closed_form
@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_the_error_of_steps_is_that_of_their_differences(ratio):
    # Steps h after k of second order leave (h + k)^2 h^2/(6 (2 h + k)) of the third derivative.
    nu, h = 3.0 * omega, 1e-3 / omega
    error, k = StepError(np.array([c])), h / ratio
    times = np.cumsum([0.0, k, h])
    error.add(times, on_circle(nu, times))
    expected = (h + k) ** 2 * h**2 / (6.0 * (2.0 * h + k)) * 0.3 * nu**3
    assert error.largest == pytest.approx(expected, rel=5e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize("pieces", [1, 7])
def test_the_error_of_a_round_orbit_of_the_steps_is_twice_what_it_is_off(pieces):
    # BDF2 of x' = i x: (3 - 2 i h) g^2 - 4 g + 1 = 0 from step to step.
    count, h = 200, 2.0 * np.pi / 200
    g = (2.0 + np.sqrt(1.0 + 2j * h)) / (3.0 - 2j * h)
    places, times = 0.3 * c * g ** np.arange(-1, count + 1), h * np.arange(count + 2)
    motions = np.stack([places.real, places.imag, -places.imag, places.real, 0.0 * times], axis=-1)[:, None]
    error = StepError(np.array([c]))
    for rows in np.array_split(np.arange(count + 2), pieces):
        rows = np.arange(max(rows[0] - 1, 0), rows[-1] + 1)
        error.add(times[rows], motions[rows])
    assert error.largest == pytest.approx(0.3 * 4.0 * np.pi / 3.0 * h**2, rel=5e-3)
    assert error.largest == pytest.approx(2.0 * abs(places[-1] - places[1]) / c, rel=5e-3)


class InPython(JFOFilm):
    """A film whose steps the compiled loop does not take."""

    def attempt(self, state, u, dt, near=None):
        return super().attempt(state, u, dt, near)


@pytest.mark.parametrize("kind", ["compiled", "in python"])
def test_the_wall_names_the_station_of_a_shaft(kind):
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    pieces = ShaftElement(length=0.5, outer_diameter=0.1, material=steel).split(2)
    ends = (Station(node=0, name="left"), Station(node=2, name="right"))
    heavy = Disk(node=2, mass=1e5)
    shaft = ShaftRotor(elements=pieces, disks=(heavy,), stations=ends, speed=omega)
    film = (JFOFilm if kind == "compiled" else InPython)(bearing=BEARING, cells=(24, 4))
    with pytest.raises(ContactError, match="journal of 'right' reached the wall"):
        simulate(shaft, {"left": film, "right": film}, duration=TURN, samples=9, max_step=TURN / 32)


def test_the_compiled_loop_makes_the_steps_of_the_loop_in_python(rest):
    steel = ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    pieces = ShaftElement(length=0.5, outer_diameter=0.1, material=steel).split(2)
    ends = (Station(node=0, name="left"), Station(node=2, name="right"))
    rise = SpeedProfile(times=(0.0, 1.0), speeds=(omega, 1.5 * omega))
    shaft = ShaftRotor(elements=pieces, stations=ends, speed=omega)
    given = {"duration": 0.1 * TURN, "samples": 9, "max_step": TURN / 96}
    for one in (rotor(rest, static_force=(0.0, -3e3)), shaft, dataclasses.replace(shaft, speed=rise)):
        runs = []
        for kind in (JFOFilm, InPython):
            film = kind(bearing=BEARING, cells=(24, 4))
            films = film if isinstance(one, RigidRotor) else {"left": film, "right": film}
            runs.append(simulate(one, films, **given))
        for name in ("steps", "restarts"):
            assert runs[0].work[name] == runs[1].work[name]
        assert runs[0].work["newton_steps"] <= 4 * runs[0].work["steps"]
        for name, row in runs[0].signals.items():
            size = np.abs(row).max() or 1.0
            np.testing.assert_allclose(row, runs[1][name], rtol=0.0, atol=1e-7 * size, err_msg=name)


def test_transport_does_not_jump_between_the_trials_of_a_step():
    # The limiter jumps as a cell fills: a force that follows it leaves Newton no end in any step.
    size = {"radius": R, "length": 0.03, "clearance": c, "viscosity": 0.05}
    bearing = JournalBearing(**size, grooves=(Groove(center=np.pi / 2, width=0.3),))
    light, end = RigidRotor(mass=30.0, speed=200.0, unbalance=1e-4), 0.0314
    films = [kind(bearing=bearing, cells=(24, 4)) for kind in (JFOFilm, JFOFilm, InPython, JFOFilm)]
    steps = (192, 96, 48, 48)
    given = {"duration": end, "samples": 9}
    runs = [simulate(light, film, max_step=end / n, **given) for film, n in zip(films, steps, strict=True)]
    fine, coarse, alike = (np.abs(b.position - a.position).max() / c for a, b in itertools.pairwise(runs))
    assert fine < 0.5 * coarse < 1e-3
    assert alike < 1e-9
    for run, count in zip(runs, steps, strict=True):
        assert run.work["restarts"] == 0
        assert run.work["newton_steps"] < 3.5 * count


def test_steps_of_the_compiled_loop_that_fail_are_halved(rest):
    fallen = []
    for kind in (JFOFilm, InPython):
        thrown, film = rotor(rest, static_force=(0.0, -4e5)), kind(bearing=BEARING, cells=(24, 4))
        with pytest.raises(ContactError, match="journal reached the wall") as caught:
            simulate(thrown, film, duration=TURN, samples=99, max_step=TURN / 32)
        fallen.append(caught.value.partial)
    assert min(run.work["restarts"] for run in fallen) > 0
    # The third step is halved. What comes closer to the wall is left to chance.
    same = fallen[0].time < 6 * TURN / 32
    np.testing.assert_allclose(*(run["y"][: same.sum()] for run in fallen), rtol=1e-9)


def test_a_rotor_that_is_not_linear_is_solved_about_its_own_place(rest):
    # A spring that hardens enough to matter, beside the film.
    class Hard(RigidRotor):
        def derivative(self, t, x, u):
            rate = super().derivative(t, x, u)
            rate[2:] -= 1e18 * np.asarray(x)[:2] ** 3 / self.mass
            return rate

        def linearization(self, t, x, u):
            found = super().linearization(t, x, u)
            found.A[2:, :2] -= np.diag(3e18 * np.asarray(x)[:2] ** 2 / self.mass)
            return found

    soft = rotor(rest)
    hard = Hard(**{field.name: getattr(soft, field.name) for field in dataclasses.fields(soft)})
    given = {"duration": 0.1 * TURN, "samples": 9, "max_step": TURN / 96}
    runs = [simulate(hard, kind(bearing=BEARING, cells=(24, 4)), **given) for kind in (JFOFilm, InPython)]
    np.testing.assert_allclose(runs[0]["y"], runs[1]["y"], rtol=1e-9)
    assert np.abs(runs[0]["y"] - simulate(soft, FILM, **given)["y"]).max() > 1e-3 * c


def test_a_run_tells_the_error_of_its_steps(rest):
    times = np.linspace(0.0, TURN, 13)
    runs = [simulate(rotor(rest), FILM, duration=TURN, times=times, max_step=TURN / n) for n in (48, 96, 192)]
    off = [np.abs(run.position - runs[-1].position).max() / c for run in runs[:-1]]
    # What it adds up is more than the orbit is off, and falls as that does.
    assert [run.step_error / one > 1.0 for run, one in zip(runs, off, strict=False)] == [True, True]
    assert runs[1].step_error < 10.0 * off[1]
    assert 1.7 < np.log2(runs[1].step_error / runs[2].step_error) < 2.3
