"""The damper that conserves its oil: closed forms, other codes, orbits, steps in time, what it refuses."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar

from rotorfilm import (
    ConvergenceError,
    DamperSupply,
    FeedHole,
    FilmContactError,
    FiniteMapSqueeze,
    FiniteSqueeze,
    FullFilm,
    InputError,
    JFODamper,
    PorousDamper,
    RigidRotor,
    ValidityWarning,
    coefficients,
    orbit_coefficients,
    simulate,
    synchronous_orbits,
)
from rotorfilm.bearings import damper_turn

R, c, mu, OMEGA = 0.05, 1e-4, 0.01, 300.0
UNIT = 12.0 * mu * (R / c) ** 2 * OMEGA
"""Pressure [Pa] of 1 in P/Omega."""
BATH = DamperSupply(cavitation_pressure=-0.0033 * UNIT, submerged=True)


def grooved(pressure=0.0067, ambient=0.0033):
    return DamperSupply(
        supply_pressure=pressure * UNIT,
        circumferential_groove=0.0,
        cavitation_pressure=-ambient * UNIT,
        submerged=True,
    )


def damper(supply=BATH, length=0.05, cells=(72, 8), **given):
    return JFODamper(radius=R, length=length, clearance=c, viscosity=mu, supply=supply, cells=cells, **given)


def on_orbit(eps, speed=OMEGA):
    return [eps * c, 0.0], [0.0, eps * c * speed]


def scaled(one, force, length=0.05):
    """Return a force in the unit mu L R^3/c^2 Omega."""
    return np.asarray(force) / (one.viscosity * length * R**3 / c**2 * OMEGA)


def circle(eps, steps, offset=0.0):
    angle = 2.0 * np.pi * np.arange(1, steps + 1) / steps
    return c * np.array([offset + eps * np.cos(angle), eps * np.sin(angle)])


class ShortDamper:
    """Short dampers with open ends in a bath: at each angle plates that open and shut, H = 1 - eps cos(tau).

    (H^3 P_z)_z = k d(theta H)/dtau over 0 < z < 1, P(1) = p, k = (L/D)^2: P and p count in Omega. The cavity
    opens from mid-length to S = 1 - sqrt(2 p H^3/(k H')) with P = P' = 0 there, and shuts by what flows in.
    """

    def __init__(self, eps, p, k):
        self.eps, self.p, self.k = eps, p, k
        most = minimize_scalar(lambda tau: -self.opening(tau), (0.2, np.pi / 2), options={"xtol": 1e-12})
        self.turn, self.deepest = float(most.x), -float(most.fun)
        self.first = brentq(self.opening, 1e-3, self.turn)
        end = solve_ivp(
            self.filling,
            (self.turn + 1e-3, 3.0 * np.pi),
            [self.deepest - 1e-7],
            events=self.shut,
            rtol=1e-7,
            atol=1e-9,
            dense_output=True,
        )
        self.path, self.last = end.sol, float(end.t_events[0][0])

    def gap(self, tau):
        return 1.0 - self.eps * np.cos(tau)

    def source(self, tau):
        return self.k * self.eps * np.sin(tau) / self.gap(tau) ** 3

    def opening(self, tau):
        return 1.0 - np.sqrt(2.0 * self.p / max(self.source(tau), 1e-30))

    @staticmethod
    def shut(tau, S):
        return S[0] - 1e-6

    shut.terminal = True

    def filling(self, tau, S):
        place = float(np.clip(S[0], 0.0, self.deepest - 1e-9))
        left = brentq(lambda at: self.opening(at) - place, self.first - 1e-9, self.turn)
        width = 1.0 - place
        slope = self.p / width - 0.5 * self.source(tau) * width
        return [-slope * self.gap(tau) ** 3 / (self.k * (self.gap(tau) - self.gap(left)))]

    def mean_pressure(self, tau):
        if self.first < tau < self.turn:
            S = self.opening(tau)
        elif self.turn <= tau < self.last:
            S = float(self.path(max(tau, self.turn + 1e-3))[0])
        else:
            return self.p - self.source(tau) / 3.0
        width = 1.0 - S
        return 0.5 * self.p * width - self.source(tau) * width**3 / 12.0

    def force(self):
        """Return the radial and the tangential force over mu L R^3/c^2 Omega."""
        tau = np.linspace(0.0, 2.0 * np.pi, 1001)[:-1]
        # A cavity that is not shut within the turn begins the next one.
        assert self.last < self.first + 2.0 * np.pi
        later = np.where(tau < self.last - 2.0 * np.pi, tau + 2.0 * np.pi, tau)
        net = np.array([self.mean_pressure(at) for at in later]) - self.p
        return -12.0 * 2.0 * np.pi * np.mean(net * np.array([np.cos(tau), -np.sin(tau)]), axis=1)


@pytest.mark.closed_form
@pytest.mark.parametrize(("eps", "share"), [(0.4, 0.35), (0.7, 0.1)])
def test_short_damper_whose_cavity_opens_and_shuts(eps, share):
    length = 0.02 * 2.0 * R
    p = share * 0.02**2 * eps
    expected = ShortDamper(eps, p, 0.02**2)
    supply = DamperSupply(cavitation_pressure=-p * UNIT, submerged=True)
    force, errors = expected.force(), []
    for cells in ((144, 8), (288, 16)):
        one = damper(supply, length, cells)
        orbit = one.orbit(eps, OMEGA)
        found = scaled(one, [orbit.radial_force, orbit.tangential_force], length)
        errors.append(np.hypot(*(found - force)) / np.hypot(*force))
    assert errors[1] < 2.5e-3
    assert errors[1] < 0.4 * errors[0]
    empty = np.sort(-orbit.angle[orbit.oil_content[:, 0] < 1.0 - 1e-9] % (2.0 * np.pi))
    assert_allclose([empty.min(), empty.max()], [expected.first, expected.last], atol=0.06)


@pytest.mark.closed_form
@pytest.mark.parametrize("eps", [0.2, 0.6])
def test_long_damper_that_stays_full(eps):
    # Sealed by its length: F_t = -12 pi eps 2/((2 + eps^2) sqrt(1 - eps^2)), no radial force.
    bath = DamperSupply(cavitation_pressure=-10.0 * UNIT, submerged=True)
    one = JFODamper(radius=0.005, length=10.0, clearance=1e-5, viscosity=mu, supply=bath, cells=(144, 4))
    orbit = one.orbit(eps, OMEGA)
    unit = mu * 10.0 * 0.005**3 / 1e-5**2 * OMEGA
    expected = 24.0 * np.pi * eps / ((2.0 + eps**2) * np.sqrt(1.0 - eps**2))
    assert orbit.tangential_force / unit == pytest.approx(-expected, rel=2e-3)
    assert abs(orbit.radial_force) < 1e-9 * abs(orbit.tangential_force)
    assert orbit.oil_content.min() == 1.0


@pytest.mark.closed_form
@pytest.mark.parametrize(("length", "eps"), [(0.05, 0.4), (0.05, 0.8), (0.025, 0.4)])
def test_full_damper_is_that_of_harmonics(length, eps):
    sizes = {"radius": R, "length": length, "clearance": c, "viscosity": mu}
    other = PorousDamper(**sizes, extent=FullFilm(), film=FiniteSqueeze())
    expected = other.force(*on_orbit(eps), 0.0)[1]
    full = DamperSupply(cavitation_pressure=-5.0 * UNIT, submerged=True)
    found = [
        damper(full, length, cells).orbit(eps, OMEGA).tangential_force for cells in ((144, 8), (288, 16))
    ]
    assert found[1] + (found[1] - found[0]) / 3.0 == pytest.approx(expected, rel=1e-3)


TABLE = [
    (grooved(ambient=0.0), 0.4, (-0.133, -0.228), (-0.095, -0.256)),
    (grooved(), 0.4, (-0.098, -0.314), (-0.075, -0.303)),
    (BATH, 0.4, (-0.441, -0.393), (-0.369, -0.787)),
    (BATH, 0.8, (-5.72, -2.99), (-5.83, -3.86)),
]
"""Radial and tangential force by conserved oil, and by Reynolds' rupture: another code at 144 x 12 cells."""


@pytest.mark.literature
@pytest.mark.parametrize(("supply", "eps", "conserved", "reynolds"), TABLE)
def test_forces_of_another_code(supply, eps, conserved, reynolds):
    one = damper(supply, cells=(144, 12))
    orbit, rounding = one.orbit(eps, OMEGA), 6e-4 if eps < 0.5 else 6e-3
    assert_allclose(scaled(one, [orbit.radial_force, orbit.tangential_force]), conserved, atol=rounding)
    assert_allclose(scaled(one, one.reynolds_force(*on_orbit(eps))), reynolds, atol=rounding)
    assert orbit.mass_defect < 1e-12
    assert orbit.inflow + orbit.drawn_in == pytest.approx(orbit.side_flow, rel=1e-10)
    assert orbit.power_loss == pytest.approx(-orbit.tangential_force * eps * c * OMEGA)


@pytest.mark.long
@pytest.mark.closed_form
def test_reynolds_rupture_is_that_of_the_damper_on_a_map():
    sizes = {"radius": R, "length": 0.05, "clearance": c, "viscosity": mu}
    other = PorousDamper(**sizes, film=FiniteMapSqueeze(cells=(10, 20)))
    motion = [0.5 * c, -0.2 * c], [0.1 * c * OMEGA, 0.6 * c * OMEGA]
    nothing = replace(BATH, cavitation_pressure=-1e-9 * UNIT)
    coarse, fine = (damper(nothing, cells=cells).reynolds_force(*motion) for cells in ((144, 8), (288, 16)))
    expected = other.force(*motion, 0.0)
    assert_allclose(fine + (fine - coarse) / 3.0, expected, atol=2e-3 * np.hypot(*expected))


@pytest.mark.convergence
def test_order_of_the_force():
    forces = []
    for k in (1, 2, 4, 8):
        orbit = damper(grooved(), cells=(36 * k, 4 * k)).orbit(0.5, OMEGA)
        forces.append([orbit.radial_force, orbit.tangential_force])
    steps = np.hypot(*np.diff(forces, axis=0).T)
    assert 1.6 < np.log2(steps[0] / steps[2]) / 2.0 < 2.4


@pytest.mark.closed_form
def test_a_groove_at_one_end_is_half_of_one_in_the_middle():
    middle = damper(grooved(), length=0.06)
    end = damper(replace(grooved(), circumferential_groove=None, end_groove=True), length=0.03)
    whole, half = middle.orbit(0.5, OMEGA), end.orbit(0.5, OMEGA)
    assert half.tangential_force == pytest.approx(0.5 * whole.tangential_force, rel=1e-12)
    assert half.side_flow == pytest.approx(0.5 * whole.side_flow, rel=1e-12)
    assert_allclose(half.axial, whole.axial)
    wide = damper(replace(grooved(), circumferential_groove=0.01), length=0.07).orbit(0.5, OMEGA)
    assert wide.radial_force == pytest.approx(whole.radial_force, rel=1e-12)
    assert wide.axial[0] == pytest.approx(whole.axial[0] + 0.005)


@pytest.mark.closed_form
def test_force_turns_with_the_orbit_and_slopes_are_its_own():
    one = damper(grooved(), stiffness=2e5)
    angle = 0.7
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    q, v = (np.array(part) for part in on_orbit(0.5))
    force = one.force(turn @ q, turn @ v, 0.0)
    film = one.orbit(0.5, OMEGA)
    expected = [film.radial_force - 2e5 * 0.5 * c, film.tangential_force]
    assert_allclose(turn.T @ force, expected, rtol=1e-9)
    backward = one.force(q, -v, 0.0)
    assert_allclose(backward, [expected[0], -expected[1]], rtol=1e-9)
    slopes = one.jacobian(q, v, 0.0)
    wider = np.array([*q, *v, 0.0]) / 0.5
    sides = [one.force((1.0 + s) * q, (1.0 + s) * v, 0.0) for s in (1e-5, -1e-5)]
    assert_allclose(slopes @ wider, (sides[0] - sides[1]) / 1e-5, rtol=1e-6)
    # K(0) is the slope of the steady film: turned a little, the force turns along.
    across = turn @ np.array([[0.0, -1.0], [1.0, 0.0]]) @ turn.T
    by_turning = one.complex_stiffness(0.5, OMEGA, 0.0)[:, 1].real * 0.5 * c
    assert_allclose(by_turning, -across @ [film.radial_force, film.tangential_force], rtol=0.03, atol=0.5)


@pytest.mark.closed_form
def test_at_rest_the_film_is_full_and_linear():
    one = damper(grooved())
    sizes = {"radius": R, "length": 0.025, "clearance": c, "viscosity": mu}
    land = PorousDamper(**sizes, extent=FullFilm(), film=FiniteSqueeze())
    found = coefficients(one, [0.3 * c, 0.0], 0.0)
    expected = coefficients(land, [0.3 * c, 0.0], 0.0)
    assert_allclose(found.damping, 2.0 * expected.damping, rtol=0.04, atol=1e-6 * expected.damping.max())
    assert_allclose(found.stiffness, 0.0, atol=1e-9 * found.damping[0, 0] * OMEGA)
    small = orbit_coefficients(one, 0.02, OMEGA)
    assert small.damping == pytest.approx(coefficients(one, [0.0, 0.0], 0.0).damping[0, 0], rel=2e-3)


@pytest.mark.convergence
def test_steps_in_time_come_to_the_steady_orbit():
    one = damper(BATH, cells=(72, 6))
    steady = one.orbit(0.6, OMEGA)
    errors = []
    for steps in (72, 144):
        turn = damper_turn(one, circle(0.6, steps), OMEGA)
        angle = OMEGA * turn.time
        radial = np.mean(turn.force[0] * np.cos(angle) + turn.force[1] * np.sin(angle))
        tangential = np.mean(turn.force[1] * np.cos(angle) - turn.force[0] * np.sin(angle))
        errors.append(radial - steady.radial_force + 1j * (tangential - steady.tangential_force))
        work = -tangential * 0.6 * c * 2.0 * np.pi
        assert turn.work == pytest.approx(work, rel=3e-3)
    size = np.hypot(steady.radial_force, steady.tangential_force)
    assert abs(errors[1]) < 2.5e-3 * size
    assert abs(errors[1]) < 0.4 * abs(errors[0])
    assert turn.change < 1e-6
    assert turn.drawn_in == pytest.approx(turn.side_flow, rel=1e-5)


@pytest.mark.literature
def test_large_orbit_off_the_center():
    # Of another code: what the mass is worth is 4 % of the peak, .4 % of the work.
    one = damper(grooved())
    q = circle(0.55, 192, offset=0.25)
    turn = damper_turn(one, q, OMEGA)
    v = OMEGA * np.array([-q[1], q[0] - 0.25 * c])
    reynolds = np.array([one.reynolds_force(at, speed) for at, speed in zip(q.T, v.T, strict=True)]).T
    peak = np.hypot(*reynolds).max()
    assert np.hypot(*(turn.force - reynolds)).max() / peak == pytest.approx(0.04, abs=0.01)
    work = -np.sum(reynolds * v) * turn.time[0]
    assert turn.work / work - 1.0 == pytest.approx(0.004, abs=1e-3)
    empty = turn.oil_content[:, :, -1] < 1.0 - 1e-9
    comes_and_goes = empty.any(axis=0) & ~empty.all(axis=0)  # within a turn
    assert comes_and_goes.mean() > 0.5
    assert turn.inflow + turn.drawn_in == pytest.approx(turn.side_flow, rel=1e-9)
    assert turn.peak_force == np.hypot(*turn.force).max()


@pytest.mark.closed_form
def test_holes_feed_a_film_that_repeats_itself_but_does_not_turn():
    holes = tuple(FeedHole(center=2.0 * np.pi * k / 3.0, diameter=8e-3) for k in range(3))
    one = damper(DamperSupply(supply_pressure=0.02 * UNIT, feed_holes=holes), cells=(48, 6))
    with pytest.raises(InputError, match=r"feed_holes must be \(\) for a steady orbit, .*damper_turn"):
        one.orbit(0.5, OMEGA)
    turn = damper_turn(one, circle(0.5, 96), OMEGA)
    assert turn.inflow == pytest.approx(turn.side_flow, rel=1e-6)
    assert turn.drawn_in == 0.0
    # Three holes and a circle: the force repeats itself in axes that turn with it after a third of a turn.
    angle = OMEGA * turn.time
    turning = (turn.force[0] + 1j * turn.force[1]) * np.exp(-1j * angle)
    assert_allclose(turning[32:], turning[:-32], rtol=1e-6)
    with pytest.raises(ConvergenceError, match="must repeat itself within most_turns 2") as caught:
        damper_turn(one, circle(0.5, 96), OMEGA, most_turns=2)
    assert caught.value.partial.force.shape == (2, 96)


def test_a_rotor_finds_its_orbits():
    one = damper(BATH, cells=(36, 4), stiffness=2e5)
    rotor = RigidRotor(mass=5.0, speed=OMEGA, unbalance=1e-4, gravity=(0.0, 0.0))
    found = synchronous_orbits(rotor, one).at(1e-4)[0]
    force = one.force(*on_orbit(found.eccentricity_ratio), 0.0)
    inertia = 5.0 * OMEGA**2 * found.eccentricity_ratio * c
    assert np.hypot(inertia + force[0], force[1]) == pytest.approx(1e-4 * OMEGA**2, rel=1e-6)


def test_a_film_without_oil_is_refused():
    for empty in ({}, {"submerged": True}, {"circumferential_groove": 0.0}, {"cavitation_pressure": -1e5}):
        with pytest.raises(
            InputError, match=r"supply_pressure above cavitation_pressure, .* dry: give supply"
        ):
            DamperSupply(**empty)
    with pytest.raises(
        InputError, match="fed by one of circumferential_groove, end_groove and feed_holes, got"
    ):
        DamperSupply(supply_pressure=1e5, circumferential_groove=0.0, end_groove=True)
    with pytest.raises(InputError, match=r"supply_pressure must be 0 without a groove or feed_holes, got 1"):
        DamperSupply(supply_pressure=1e5)
    with pytest.raises(InputError, match="cavitation_pressure must not be above 0, got 5"):
        DamperSupply(cavitation_pressure=5.0, submerged=True)
    with pytest.raises(InputError, match=r"circumferential_groove must be below the length 0.05, got 0.05"):
        damper(replace(grooved(), circumferential_groove=0.05))
    with pytest.raises(InputError, match=r"diameter of a feed hole must be below .* got 0.06"):
        damper(DamperSupply(supply_pressure=1e5, feed_holes=(FeedHole(center=0.0, diameter=0.06),)))


def test_other_motions_and_contact_are_said():
    one = damper()
    for motion in (([0.5 * c, 0.0], [1e-3, 1e-3]), ([0.0, 0.0], [1e-3, 0.0])):
        with pytest.raises(
            InputError, match=r"velocity must be 0 or perpendicular to the position.*damper_turn"
        ):
            one.force(*motion, 0.0)
    with pytest.raises(FilmContactError, match="inside the clearance"):
        one.orbit(1.0, OMEGA)
    with pytest.raises(FilmContactError, match="inside the clearance"):
        damper_turn(one, circle(0.8, 96, offset=0.3), OMEGA)
    with pytest.raises(InputError, match=r"position must have shape \(2, n\), n at least 24, got shape"):
        damper_turn(one, circle(0.8, 12), OMEGA)
    with pytest.warns(ValidityWarning, match="submerged must be True for ends that draw in oil"):
        damper(replace(grooved(), submerged=False)).orbit(0.5, OMEGA)


@pytest.mark.closed_form
def test_a_rotor_in_time_stays_on_its_orbit():
    one = damper(BATH, cells=(24, 4), stiffness=2e5)
    eps = 0.5
    q, v = on_orbit(eps)
    force = one.force(q, v, 0.0)
    pull = complex(-(2.0 * OMEGA**2 * q[0] + force[0]), -force[1])  # of the unbalance, over the position
    rotor = RigidRotor(
        mass=2.0,
        speed=OMEGA,
        unbalance=abs(pull) / OMEGA**2,
        unbalance_angle=float(np.angle(pull)),
        gravity=(0.0, 0.0),
        position=tuple(q),
        velocity=tuple(v),
    )
    turn = 2.0 * np.pi / OMEGA
    run = simulate(rotor, one, duration=5.0 * turn, samples=321, max_step=turn / 48)
    last = np.hypot(*run.position)[-64:] / c  # after what the start from a film at rest has shaken
    assert last.mean() == pytest.approx(eps, rel=0.01)
    assert np.ptp(last) < 0.02 * eps


def test_a_stepped_damper_goes_on_from_its_bytes_and_feels_its_springs():
    film, sprung = damper(grooved(), cells=(16, 4)), damper(grooved(), cells=(16, 4), stiffness=1e6)
    ways = [np.array([0.3 * c * np.cos(a), 0.3 * c * np.sin(a), 0.0, 0.0, OMEGA]) for a in (0.0, 0.2, 0.4)]
    states = [one.start(ways[0]) for one in (film, sprung)]
    for u in ways[1:]:
        ends = [one.step(state, 0.0, u, 1e-3) for one, state in zip((film, sprung), states, strict=True)]
        assert_allclose(ends[1][1][:2], ends[0][1][:2] - 1e6 * u[:2], rtol=1e-12)
        states = [end[0] for end in ends]
    at_rest = coefficients(sprung, ways[0][:2], 0.0)
    slopes = sprung.slopes(sprung.start(ways[0]))
    assert_allclose(-slopes[:, 2:4], at_rest.damping, rtol=1e-9, atol=1e-9 * at_rest.damping.max())
    assert_allclose(-slopes[:, :2], 1e6 * np.eye(2), atol=1e-3)
    assert_allclose(slopes[:, 4], 0.0)
    again = sprung.unpack(sprung.pack(states[1]))
    _, expected, _ = sprung.step(states[1], 0.0, ways[0], 1e-3)
    assert_allclose(sprung.step(again, 0.0, ways[0], 1e-3)[1], expected, rtol=0.0)
    with pytest.raises(FilmContactError, match=r"inside the clearance .* at t = 0.001 s"):
        sprung.step(again, 0.0, [c, 0.0, 0.0, 0.0, OMEGA], 1e-3)
    # The race does not spin: the speed of the rotor changes nothing.
    still = ways[0] * [1.0, 1.0, 1.0, 1.0, 0.0]
    assert_allclose(sprung.step(again, 0.0, still, 1e-3)[1], expected, rtol=1e-2)
