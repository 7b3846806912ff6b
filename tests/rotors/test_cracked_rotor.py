"""Cracked shafts: own integrations, the asymmetric shaft, Mathieu's small depth, compliances, harmonics."""

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import rotorfilm as rf

MASS, STIFF = 10.0, 1e6
CRITICAL = np.sqrt(STIFF / MASS)
JEFFCOTT = rf.JeffcottRotor(
    mass=MASS, journal_mass=0.1, stiffness=STIFF, speed=150.0, external_damping=100.0, unbalance=1e-4
)
BEARING = rf.LinearBearing(stiffness=1e9, damping=0.0)
HELD = STIFF * 1e9 / (STIFF + 1e9)


def cracked(reduction=0.1, rotor=JEFFCOTT, breathing=None, **crack):
    crack = rf.rotors.JeffcottCrack(reduction=reduction, **crack)
    return rf.CrackedRotor(rotor=rotor, crack=crack, breathing=breathing or rf.rotors.MayesDaviesBreathing())


def response(rotor, steps=64, **options):
    return rf.cracked_response(rf.mount(rotor, {"": BEARING}), steps=steps, **options)


def undamped(speed):
    return dataclasses.replace(JEFFCOTT, speed=speed, external_damping=0.0)


@pytest.mark.closed_form
def test_without_depth_nothing_changes():
    x, u = np.linspace(-1e-4, 1e-4, 8), np.array([3.0, -5.0])
    whole = cracked(0.0)
    assert_allclose(whole.derivative(0.1, x, u), JEFFCOTT.derivative(0.1, x, u), rtol=0.0, atol=0.0)
    A, bare = (rotor.linearization(0.1, x, u).A for rotor in (whole, JEFFCOTT))
    assert_allclose(A, bare, rtol=0.0, atol=0.0)


@pytest.mark.parametrize(
    "breathing", [rf.rotors.MayesDaviesBreathing(), rf.rotors.GaschHinge(edge=0.2)], ids=type
)
def test_a_run_up_against_an_own_integration(breathing):
    profile = rf.SpeedProfile(times=(0.0, 0.02), speeds=(80.0, 140.0))
    rotor = dataclasses.replace(JEFFCOTT, speed=profile, journal_mass=1.0)
    whole = cracked(0.3, rotor, breathing, cross_reduction=0.1, crack_angle=0.4)
    bearing = rf.LinearBearing(stiffness=1e7, damping=2e3)
    run = rf.simulate(whole, bearing, duration=0.02, samples=5, rtol=1e-9)

    def share(angle):  # from the direction of gravity
        if isinstance(breathing, rf.rotors.MayesDaviesBreathing):
            return 0.5 * (1.0 + np.cos(angle))
        s = np.clip(0.5 + (np.pi / 2 - np.arccos(np.cos(angle))) / 0.4, 0.0, 1.0)
        return 3.0 * s**2 - 2.0 * s**3

    def rates(t, state):
        z, j, dz, dj = state
        angle = 80.0 * t + 1500.0 * t**2
        speed, p = 80.0 + 3000.0 * t, angle + 0.4
        bent = (z - j) * np.exp(-1j * p)
        opened = share(p + np.pi / 2) * STIFF * (0.3 * bent.real + 0.1j * bent.imag)
        spring = STIFF * (z - j) - opened * np.exp(1j * p)
        pull = 1e-4 * (speed**2 - 3000.0j) * np.exp(1j * angle) - 100.0 * dz
        weight = -9.80665j
        return [dz, dj, (pull - spring) / MASS + weight, spring - 1e7 * j - 2e3 * dj + weight]

    start = np.zeros(4, dtype=complex)
    own = solve_ivp(rates, (0, 0.02), start, method="DOP853", rtol=1e-11, atol=1e-15, t_eval=run.time)
    assert_allclose(run["disk_x"] + 1j * run["disk_y"], own.y[0], atol=1e-10)
    assert_allclose(run["x"] + 1j * run["y"], own.y[1], atol=1e-11)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [280.0, 302.0, 313.0, 330.0])
def test_an_open_crack_is_an_asymmetric_shaft(speed):
    # (p^2 + weak - w^2)(p^2 + strong - w^2) + 4 w^2 p^2 = 0 in turning axes.
    strong = HELD / MASS
    weak = 0.9 * STIFF * 1e9 / (0.9 * STIFF + 1e9) / MASS
    w2 = speed**2
    roots = np.roots([1.0, 0.0, weak + strong + 2.0 * w2, 0.0, (weak - w2) * (strong - w2)])
    found = response(cracked(0.1, undamped(speed), rf.rotors.OpenCrack()), steps=128)
    assert_allclose(found.growth_rate, roots.real.max(), atol=1e-5)
    assert found.stable is (found.growth_rate < 0.0)
    if weak < w2 < strong:
        assert found.growth_rate > 1.0


@pytest.mark.closed_form
@pytest.mark.parametrize(("order", "coupling"), [(2, 1.0 / 4.0), (3, 1.0 / 8.0)])
def test_small_cracks_are_those_of_mathieu(order, coupling):
    # m z'' + k z - (d/2) f z - (d/2) f exp(2 i p) z* = 0, f = (1 + cos p)/2: order * speed = 2 w_n grows at
    # d coupling/(2 m w_n), and within that distance of frequencies.
    natural, errors = np.sqrt(HELD / MASS), []
    for reduction in (0.02, 0.04):
        mean = natural * np.sqrt(1.0 - reduction / 4.0)
        expected = reduction * STIFF * coupling / (2.0 * MASS * natural)
        grown = response(cracked(reduction, undamped(2.0 * mean / order))).growth_rate
        errors.append(abs(grown / expected - 1.0))
    assert errors[1] < 0.05
    for share, grows in ((0.9, True), (-0.9, True), (1.1, False), (-1.1, False)):
        # expected and mean are those of the last crack.
        own = response(cracked(reduction, undamped(2.0 * (mean + share * expected) / order)))
        assert (own.growth_rate > 1e-6) is grows


@pytest.mark.convergence
def test_harmonics_of_a_shallow_crack():
    # First order: the lost stiffness times the static deflection shakes the uncracked rotor.
    speed = 0.5 * CRITICAL
    rotor = dataclasses.replace(JEFFCOTT, speed=speed, unbalance=0.0)
    still = -1j * MASS * 9.80665 / HELD
    errors = {}
    for reduction in (0.005, 0.01):
        whole = cracked(reduction, rotor)
        angle = np.arange(64) * 2.0 * np.pi / 64
        forced = np.array([(whole.lost(p / speed) @ [still.real, still.imag]) @ [1.0, 1.0j] for p in angle])
        push = np.fft.fft(forced) / 64
        found = response(whole, harmonics=3).series
        forward = 0.5 * (found["disk_x"][2] + 1j * found["disk_y"][2])
        receptance = 1.0 / (HELD - MASS * (2 * speed) ** 2 + 1j * 2 * speed * 100.0)
        errors[reduction] = abs(forward / (push[2] * receptance) - 1.0)
    assert errors[0.01] < 0.1
    assert 1.7 < errors[0.01] / errors[0.005] < 2.3


def test_twice_the_speed_resounds_at_half_of_the_critical():
    def size(speed, harmonic):
        rotor = dataclasses.replace(JEFFCOTT, speed=speed)
        return abs(response(cracked(0.1, rotor)).series["disk_y"][harmonic])

    lowered = np.sqrt(1.0 - 0.1 / 4.0) * CRITICAL
    for harmonic in (2, 3):
        at, below, above = (size(share * lowered / harmonic, harmonic) for share in (1.0, 0.9, 1.1))
        assert at > 2.5 * max(below, above)


def test_the_periodic_response_is_what_a_run_settles_to():
    rotor = dataclasses.replace(JEFFCOTT, journal_mass=1.0, external_damping=4000.0)
    whole, soft = (
        cracked(0.2, rotor, rf.rotors.GaschHinge(edge=0.5)),
        rf.LinearBearing(stiffness=1e7, damping=3e3),
    )
    found = rf.cracked_response(rf.mount(whole, {"": soft}), harmonics=12, steps=256)
    turn = 2.0 * np.pi / 150.0
    run = rf.simulate(whole, soft, duration=3 * turn, times=np.linspace(2.5, 3, 5) * turn, rtol=1e-6)
    angle = np.outer(150.0 * run.time, np.arange(13))
    periodic = (np.exp(1j * angle) @ found.series["disk_y"]).real
    assert_allclose(run["disk_y"], periodic, atol=2e-8)
    backward = response(cracked(0.2, dataclasses.replace(JEFFCOTT, speed=-150.0)))
    forward = response(cracked(0.2))
    assert_allclose(abs(backward.series["disk_y"]), abs(forward.series["disk_y"]), rtol=1e-9)


@pytest.mark.convergence
def test_steps_of_fourth_order():
    exact, coarse, fine = (response(cracked(0.3), steps=n).series["disk_y"][2] for n in (256, 16, 32))
    assert 13.0 < abs(coarse - exact) / abs(fine - exact) < 20.0


@pytest.mark.closed_form
def test_the_compliance_of_a_shallow_crack():
    # Strips as of a half plane, F = 1.122: the depth over the edge is a parabola.
    radius, modulus, nu = 0.05, 2.1e11, 0.3
    for part in (1e-3, 1e-4):
        a = part * radius
        weak, strong = rf.rotors.crack_compliance(
            depth=a, radius=radius, young_modulus=modulus, poisson_ratio=nu
        )
        scale = 32.0 * (1.0 - nu**2) / (np.pi * modulus * radius**8)
        shallow = scale * radius**2 * 1.122**2 * 8.0 / 15.0 * a**2 * np.sqrt(2.0 * radius * a)
        assert_allclose(weak, shallow, rtol=6.0 * part)
        assert strong < 0.5 * part * weak


def shaft(beam, elements=4, depth=0.015, **change):
    steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8e10, density=7800.0)
    piece = rf.ShaftElement(length=1.0, outer_diameter=0.05, material=steel)
    given = {
        "elements": piece.split(elements),
        "speed": 100.0,
        "stations": (rf.Station(node=0, name="left"), rf.Station(node=elements)),
        "disks": (rf.Disk(node=elements // 2, mass=40.0),),
        "probes": (rf.Probe(node=elements // 2, name="middle"),),
        "beam": beam,
    }
    rotor = rf.ShaftRotor(**{**given, **change})
    crack = rf.rotors.ShaftCrack(element=1, depth=depth, crack_angle=-np.pi / 2)
    return rf.CrackedRotor(rotor=rotor, crack=crack, breathing=rf.rotors.OpenCrack())


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "beam", [rf.ClassicalBeam(), rf.rotors.FourthOrderBeam()], ids=["classical", "fourth"]
)
def test_the_deflection_of_a_cracked_shaft(beam):
    # By virtual work the crack adds h M m: M of the load, m of the unit load, where the crack is.
    whole = shaft(beam)
    s, n = whole.rotor.structure, len(whole.rotor.structure.coordinates)
    held = s.stiffness + 1e12 * s.journals.T @ s.journals
    load = np.zeros(2 * n)
    load[n + 4] = -1000.0
    rows, _ = whole.weakness
    sound, weak = (np.linalg.solve(K, load)[n + 4] for K in (held, held - rows.T @ whole.lost(0.0) @ rows))
    h, _ = rf.rotors.crack_compliance(
        depth=0.015, radius=0.025, young_modulus=2.1e11, poisson_ratio=2.1 / 1.6 - 1.0
    )
    moment = 0.5 * 0.375
    assert_allclose(sound - weak, 1000.0 * h * moment**2, rtol=1e-7)


def test_a_cracked_shaft_in_its_bearings():
    whole = shaft(rf.ClassicalBeam())
    spring = rf.LinearBearing(stiffness=1e8, damping=1e4)
    mounted = rf.mount(whole, {"left": spring, "": spring})
    x = np.random.default_rng(2).normal(size=len(mounted.states)) * 1e-5
    A = mounted.linearization(0.01, x, []).A
    moved = mounted.derivative(0.01, 2.0 * x, []) - mounted.derivative(0.01, x, [])
    assert_allclose(A @ x, moved, rtol=1e-9, atol=1e-9 * np.abs(moved).max())
    found = rf.cracked_response(mounted)
    assert found.stable
    # A notch in a shaft that its weight bends: twice the speed, and nothing at the others.
    size = np.abs(found.series["middle_y"])
    assert size[2] > 1e3 * max(size[1], size[3])
    assert_allclose(size[0], 3.2e-4, rtol=0.5)


def test_what_cracks_refuse():
    still = dataclasses.replace(JEFFCOTT, gravity=(0.0, 0.0))
    with pytest.raises(rf.InputError, match="opening_angle must be given for a rotor without gravity"):
        cracked(0.1, still)
    with pytest.raises(rf.InputError, match="reduction must be from cross_reduction"):
        rf.rotors.JeffcottCrack(reduction=0.1, cross_reduction=0.2)
    with pytest.raises(rf.InputError, match="a ShaftRotor for a ShaftCrack"):
        rf.CrackedRotor(rotor=JEFFCOTT, crack=rf.rotors.ShaftCrack(element=0, depth=1e-3))
    with pytest.raises(rf.InputError, match=r"depth must not exceed the radius 0.025, got 0.03"):
        shaft(rf.ClassicalBeam(), depth=0.03)
    with pytest.raises(rf.InputError, match=r"poisson_ratio must be above -1 and at most 0.5, got 2.0"):
        rf.rotors.crack_compliance(depth=0.01, radius=0.025, young_modulus=2.1e11, poisson_ratio=2.0)
    with pytest.raises(rf.InputError, match="element must be from 0 to 0"):
        shaft(rf.ClassicalBeam(), elements=1)
    with pytest.raises(rf.InputError, match="edge must not exceed a quarter"):
        rf.rotors.GaschHinge(edge=2.0)
    film = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
    own = type("Own", (rf.LinearBearing,), {})(stiffness=1e7)  # may have another force
    for bearing in (film, own):
        with pytest.raises(rf.InputError, match="must be a LinearBearing"):
            rf.cracked_response(rf.mount(cracked(), {"": bearing}))
