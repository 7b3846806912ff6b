"""Force and moment of the tilted journal's film, and mobilities: closed forms, symmetries, other solvers."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad
from scipy.linalg import cholesky, solve_triangular
from scipy.optimize import fsolve, nnls

import rotorfilm as rf
from rotorfilm import FilmContactError, FullFilm, Groove, InputError, Reaction, UndefinedDerivativeError
from rotorfilm.bearings import (
    Complementarity,
    ExtrapolatedFilm,
    FilmGeometry,
    HalfSommerfeld,
    MaximumGapOnset,
    mobility_of,
)
from rotorfilm.bearings.films.finite_volumes import RingKernel, over_whole_length, ring_grids, ring_spans
from rotorfilm.bearings.journal import ReynoldsFilm

TURN = np.kron(np.eye(2), [[0.0, 1.0], [-1.0, 0.0]])
TILTED = np.array([0.3, -0.4, 0.15, -0.1])
GROOVES = (Groove(center=0.4, width=0.3), Groove(center=3.5, width=0.3))


def journal(film=None, **given):
    """Return a journal of D 100 mm, L/D 1 unless another length is given."""
    size = {"radius": 0.05, "length": 0.1, "clearance": 1e-4, "viscosity": 0.02}
    return rf.JournalBearing(**(size | given), film=film or ReynoldsFilm())


def whole_film(slenderness, cells, *, geometry=None, cavitation=None, profile=np.ones_like, **options):
    """Return the film of a bore over the whole length."""
    geometry = geometry or FilmGeometry()
    grids = tuple(over_whole_length(grid, profile) for grid in ring_grids(geometry, *cells, slenderness))
    return RingKernel(slenderness, ring_spans(geometry), grids, cavitation or Complementarity(), **options)


def at_rest(place, speed=1.0):
    """Return the drive of a journal at rest in its place."""
    return np.append(0.5 * speed * TURN @ place, 0.5 * speed)


def coefficients(film, place):
    """Return K and C (4, 4) at rest at speed 1, in the film's units."""
    _, slopes = film.wrench(place, at_rest(place))
    return -(slopes[:, :4] + 0.5 * slopes[:, 4:8] @ TURN), -slopes[:, 4:8]


@pytest.mark.parametrize(
    ("slenderness", "place", "wrench", "stiffness", "damping"),
    [
        (0.5, (0.4, -0.3, 0.2, 0.1), (0.0104, 0.6335, -0.0390, 0.0169), (1.405, 0.615, -2.364, 1.659), None),
        (
            1.0,
            tuple(TILTED),
            (0.6354, 1.7298, -0.0392, 0.1846),
            (2.499, None, -5.624, 5.187),
            (4.383, 13.110),
        ),
    ],
)
def test_force_moment_and_coefficients_are_those_of_two_other_programs(
    slenderness, place, wrench, stiffness, damping
):
    """Of a film in numpy on 384 x 48 cells, and of another by the splitting method, made for the notes."""
    film, place = whole_film(slenderness, (192, 16)), np.array(place)
    found = film.wrench(place, at_rest(place))[0]
    assert_allclose(found, wrench, atol=4e-3 * np.abs(wrench[:2]).max())
    K, C = coefficients(film, place)
    wanted = np.array([np.nan if one is None else one for one in stiffness])
    known = np.isfinite(wanted)
    assert_allclose(K[:2, :2].ravel()[known], wanted[known], atol=0.015 * np.nanmax(np.abs(wanted)))
    if damping:
        assert_allclose(np.diag(C)[:2], damping, rtol=0.015)


@pytest.mark.convergence
@pytest.mark.parametrize("slenderness", [0.5, 1.0])
def test_a_centered_full_film_converges_to_its_closed_form(slenderness):
    ratio = slenderness
    moment = 1.0 / 3.0 - (ratio / math.tanh(ratio) - 1.0) / ratio**2
    exact = np.array([1.0 - math.tanh(ratio) / ratio, moment])
    errors = []
    for n in (32, 64, 128):
        _, by = whole_film(ratio, (n, n // 4), cavitation=FullFilm()).wrench(np.zeros(4), np.eye(5)[0])
        found = -np.diag(by[:, 4:8]) / (12.0 * math.pi)
        assert_allclose(found[::2], found[1::2], rtol=1e-12)
        errors.append(found[::2] / exact - 1.0)
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert_allclose(orders, 2.0, atol=0.05)
    assert_allclose((4.0 * np.array(errors[2]) - errors[1]) / 3.0, 0.0, atol=2e-5)


@pytest.mark.closed_form
def test_a_short_full_film_has_the_closed_form_of_its_tilt():
    """H = A + B Z along an angle: mean P and mean Z P of an axial flow, integrated along Z and around."""
    place, drive = np.array([0.3, 0.1, 0.2, -0.15]), np.array([0.2, -0.1, 0.3, 0.4, 0.0])

    def means(angle):
        n = np.array([math.cos(angle), math.sin(angle)])
        A, B, a, b = 1.0 - place[:2] @ n, -place[2:] @ n, drive[:2] @ n, drive[2:4] @ n
        of = [quad(lambda Z, k=k: Z**k / (A + B * Z) ** 3, -1.0, 1.0)[0] for k in range(5)]
        c = (a * of[1] + 0.5 * b * of[2]) / of[0]
        mean = -0.5 * (c * of[1] - a * of[2] - 0.5 * b * of[3])
        return np.outer([mean, -0.25 * (c * of[2] - a * of[3] - 0.5 * b * of[4])], n)

    angles = 2.0 * math.pi * np.arange(64) / 64
    exact = -12.0 * sum(means(angle) for angle in angles).ravel() * 2.0 * math.pi / 64
    assert_allclose(exact, [-4.168058, 1.273995, -0.746990, -0.417433], atol=1e-6)
    tiny, found = 1e-4, []
    for n in (16, 32):
        grids = tuple(over_whole_length(grid) for grid in ring_grids(FilmGeometry(), 512, n, tiny))
        film = RingKernel(tiny, ring_spans(FilmGeometry()), grids, FullFilm(), resting=True)
        found.append(film.wrench(place, drive)[0] / tiny**2)
    assert_allclose((4.0 * found[1] - found[0]) / 3.0, exact, rtol=2e-5)


@pytest.mark.parametrize("cavitation", [Complementarity(), FullFilm(), HalfSommerfeld()])
@pytest.mark.parametrize("grooves", [(), GROOVES])
def test_a_straight_shaft_feels_the_film_of_half_the_length(cavitation, grooves):
    supply = 1e4 if grooves else 0.0
    bearing = journal(ReynoldsFilm(cavitation=cavitation), grooves=grooves, supply_pressure=supply)
    held = rf.bearings.MomentCarryingJournal(bearing=bearing)
    place, rate = np.array([2e-5, -5e-5]), np.array([1e-3, 2e-3])
    straight, still = np.append(place, [0.0, 0.0]), np.append(rate, [0.0, 0.0])
    force = bearing.force(place, rate, 300.0)
    assert_allclose(held.force(straight, still, 300.0), [*force, 0.0, 0.0], atol=1e-11 * np.abs(force).max())
    slopes, planar = held.jacobian(straight, still, 300.0), bearing.jacobian(place, rate, 300.0)
    found = slopes[:, [0, 1, 4, 5, 8]]
    for k, size in enumerate(np.abs(planar).max(axis=0)):
        assert_allclose(found[:2, k], planar[:, k], atol=1e-11 * size)
        assert_allclose(found[2:, k], 0.0, atol=1e-11 * size)


@pytest.mark.parametrize("mobility", [None, "thick"])
@pytest.mark.parametrize("cavitation", [Complementarity(), FullFilm(), HalfSommerfeld()])
def test_derivatives_are_those_of_differences(cavitation, mobility):
    """On lines that rest; the edge of the film stays between its nodes over the steps."""
    film = whole_film(0.8, (32, 4), cavitation=cavitation, resting=True, mobility=mobility and THICK)
    rng = np.random.default_rng(4)
    state = np.concatenate([TILTED, rng.normal(size=4), [0.7]])
    slopes, step = film.wrench(state[:4], state[4:])[1], 2e-5
    for k in range(9):
        moved = [state + way * step * np.eye(9)[k] for way in (-2.0, -1.0, 1.0, 2.0)]
        wrenches = [film.wrench(one[:4], one[4:])[0] for one in moved]
        found = np.array([1.0, -8.0, 8.0, -1.0]) @ wrenches / (12.0 * step)
        assert_allclose(found, slopes[:, k], atol=1e-9 * np.abs(slopes).max())
    if not cavitation.clipped:
        assert_allclose(slopes[:, 4:8], slopes[:, 4:8].T, atol=1e-12 * np.abs(slopes).max())


def test_force_is_even_and_moment_odd_in_the_tilt():
    film = whole_film(0.6, (48, 4), geometry=FilmGeometry(grooves=GROOVES))
    drive = np.array([0.3, -0.5, 0.4, 0.2, 0.0])
    one = film.wrench(TILTED, drive)[0]
    other = film.wrench(TILTED * [1, 1, -1, -1], drive * [1, 1, -1, -1, 1])[0]
    assert_allclose(other, one * [1, 1, -1, -1], rtol=1e-11)


@pytest.mark.parametrize(
    ("crown", "tilt", "least"),
    [(0.0, 0.0, 0.305), (0.0, 0.2, 0.169), (0.0, 0.35, 0.081), (0.1, 0.0, 0.260), (0.1, 0.2, 0.216)],
)
def test_a_crown_buys_tolerance_of_tilt(crown, tilt, least):
    """The load 4 in the film's units finds its place under a tilt in its plane; by a coarser grid."""
    film = whole_film(1.0, (96, 8), profile=lambda Z: 1.0 + crown * Z**2, extrapolated=True)

    def left(e):
        place = np.array([*e, 0.0, -tilt])
        return film.wrench(place, at_rest(place), differentiated=False)[0][:2] - [0.0, 4.0]

    e = fsolve(left, [0.4, -0.4], xtol=1e-9)
    assert film.least(np.array([*e, 0.0, -tilt])) == pytest.approx(least, abs=3e-3)


def test_it_is_a_reaction_of_four_freedoms():
    held = rf.bearings.MomentCarryingJournal(bearing=journal(ReynoldsFilm(cells=(48, 4))))
    assert isinstance(held, Reaction)
    place, rate = np.array([2e-5, -3e-5, 2e-4, -1e-4]), np.array([1e-3, -2e-3, 1e-2, 2e-2])
    force, slopes = held.force(place, rate, 200.0), held.jacobian(place, rate, 200.0)
    u = [*place, *rate, 200.0]
    assert_allclose(held.output(0.0, (), u), force)
    assert_allclose(held.linearization(0.0, (), u).D, slopes)
    # power: moments act on the tilts of the places in which forces act
    there = np.array([0.2, -0.3, -0.05, -0.1])
    wrench = held.bearing.force_scale * held.kernel.wrench(there, at_rest(there, 200.0))[0]
    still = held.force(place, np.zeros(4), 200.0)
    assert_allclose(still, wrench[[0, 1, 3, 2]] * [1.0, 1.0, -0.05, 0.05], rtol=1e-12)
    batch = held.force(np.stack([place, 0.5 * place], axis=1), rate[:, None], 200.0)
    assert_allclose(batch[:, 0], force)


def test_a_load_with_a_moment_finds_its_rest():
    held = rf.bearings.MomentCarryingJournal(
        bearing=journal(ExtrapolatedFilm(film=ReynoldsFilm(cells=(64, 8))))
    )
    load = [0.0, -8e3, 30.0, 0.0]
    rest = rf.equilibrium(held, load, 300.0)
    assert_allclose(held.force(rest.position, np.zeros(4), 300.0), np.negative(load), atol=1e-6)
    assert rest.position[2] > 0.0
    assert rest.minimum_film == pytest.approx(float(held.minimum_film(rest.position)))
    assert rest.minimum_film < 1e-4 - math.hypot(*rest.position[:2])


def test_contact_is_that_of_the_ends():
    held = rf.bearings.MomentCarryingJournal(bearing=journal())
    assert held.minimum_film([5e-5, 0.0, 0.0, 4e-4]) == pytest.approx(3e-5)
    with pytest.raises(FilmContactError, match="over the whole length"):
        held.force([5e-5, 0.0, 0.0, 1.01e-3], np.zeros(4), 100.0)
    assert np.all(held.force([5e-5, 0.0, 0.0, 4e-4], np.zeros(4), 0.0) == 0.0)
    with pytest.raises(UndefinedDerivativeError):
        held.jacobian([5e-5, 0.0, 0.0, 4e-4], np.zeros(4), 0.0)


@pytest.mark.parametrize(
    "bearing",
    [
        journal(rf.MapFilm()),
        journal(ReynoldsFilm(film_start=MaximumGapOnset())),
        journal(circumferential_groove=0.01),
        3.0,
    ],
)
def test_films_without_a_grid_for_tilts_are_refused(bearing):
    with pytest.raises(InputError, match="bearing must"):
        rf.bearings.MomentCarryingJournal(bearing=bearing)


def thick(thickness):
    """Return the factors of a test: thick films are less mobile, and are sheared more."""
    return 1.0 / (1.0 + thickness**2), 1.0 / (1.0 + thickness), 0.8 + 0.1 * thickness, 1.0 + thickness**2


def laminar_law(thickness):
    """Return the factors of a laminar film."""
    return 1.0, 1.0, 1.0, 1.0


THICK = mobility_of(thick)


def independent_film(slenderness, lines, half, place, drive, law):
    """Return force and moment of the film with P >= 0 by non-negative least squares on dense matrices."""
    step, z = 2.0 * math.pi / lines, np.linspace(-1.0, 1.0, 2 * half + 1)
    nodes, dz = len(z), 1.0 / half
    A = np.zeros((lines * nodes, lines * nodes))
    b = np.zeros(lines * nodes)
    index = np.arange(lines * nodes).reshape(lines, nodes)

    def gap(angle, Z):
        return 1.0 - (place[:2] + Z * place[2:]) @ [math.cos(angle), math.sin(angle)]

    def couple(p, q, conductance):
        A[p, p] += conductance
        A[q, q] += conductance
        A[p, q] -= conductance
        A[q, p] -= conductance

    for i in range(lines):
        at, face, before = step * i, step * (i + 0.5), step * (i - 0.5)
        normal = np.array([math.sin(face) - math.sin(before), math.cos(before) - math.cos(face)])
        for j in range(nodes):
            H = gap(face, z[j])
            factors = law(H)
            couple(index[i, j], index[(i + 1) % lines, j], factors[0] * H**3 / step * dz / 2.0)
            smooth = (drive[:2] + z[j] * drive[2:4]) @ normal
            more = drive[4] * (factors[2] - 1.0) * H * dz / 2.0
            b[index[i, j]] += smooth * dz / 2.0 - more
            b[index[(i + 1) % lines, j]] += more
            if j + 1 < nodes:
                H = gap(at, 0.5 * (z[j] + z[j + 1]))
                through = law(H)[1] * H**3 * step / slenderness**2 / (2.0 * dz)
                couple(index[i, j], index[i, j + 1], through)
    inside = index[:, 1:-1].ravel()
    A, b = A[np.ix_(inside, inside)], b[inside]
    root = cholesky(A, lower=True)
    P = nnls(root.T, solve_triangular(root, b, lower=True))[0].reshape(lines, nodes - 2)
    angle = step * np.arange(lines)
    normal = 2.0 * math.sin(0.5 * step) * np.stack([np.cos(angle), np.sin(angle)])
    means = P.sum(axis=1) * dz / 2.0, (P * z[1:-1]).sum(axis=1) * dz / 2.0
    return -12.0 * np.concatenate([normal @ mean for mean in means])


def test_a_mobility_reaches_force_and_moment():
    """The same cells, without a shared line of code: another search, another matrix."""
    film = whole_film(0.9, (16, 4), resting=True, mobility=THICK)
    even = [
        grid._replace(
            width=np.full(2 * n - 1, 0.5 / n),
            conductance=np.full(2 * n - 1, 0.5 * n),
            place=np.linspace(-1.0, 1.0, 4 * n + 1),
            wall=np.ones(4 * n + 1),
        )
        for n, grid in zip((4, 2, 1), film.grids, strict=True)
    ]
    spans, options = ring_spans(FilmGeometry()), {"mobility": THICK, "resting": True}
    film = RingKernel(0.9, spans, tuple(even), Complementarity(), **options)
    drive = np.array([0.4, -0.3, 0.2, 0.1, 0.6])
    found = film.wrench(TILTED, drive)[0]
    assert_allclose(found, independent_film(0.9, 16, 4, TILTED, drive, thick), rtol=1e-9)
    laminar = independent_film(0.9, 16, 4, TILTED, drive, laminar_law)
    assert np.abs(found - laminar).max() > 0.2 * np.abs(laminar).max()


def test_a_mobility_reaches_the_losses_of_a_journal():
    """Power is what shear and pressure dissipate: 12 P.b of the film, and the integral of the shear."""
    eased = journal(ReynoldsFilm(cells=(96, 8), mobility=THICK, cavitation=FullFilm()))
    place, speed, e = np.array([2e-5, -4e-5]), 200.0, np.array([0.2, -0.4])
    force = eased.force(place, np.zeros(2), speed)
    wanted = whole_film(1.0, (96, 8), cavitation=FullFilm(), mobility=THICK)
    drive = at_rest(np.array([*e, 0.0, 0.0]), speed)
    assert_allclose(
        force, eased.force_scale * wanted.wrench(np.array([*e, 0.0, 0.0]), drive)[0][:2], rtol=1e-11
    )

    def sheared(angle):
        H = 1.0 - e @ [math.cos(angle), math.sin(angle)]
        return thick(H)[3] / H

    sigma = quad(sheared, 0.0, 2.0 * math.pi)[0]
    scale = eased.force_scale * eased.clearance
    torque = 0.5 * (place[0] * force[1] - place[1] * force[0]) + scale * sigma * speed
    assert eased.losses(place, np.zeros(2), speed).power_loss == pytest.approx(speed * abs(torque), rel=2e-3)
    ruptured = replace(eased, film=replace(eased.film, cavitation=Complementarity()))
    full = ruptured.losses(place, np.zeros(2), speed, full_gap=True)
    force = ruptured.force(place, np.zeros(2), speed)
    torque = 0.5 * (place[0] * force[1] - place[1] * force[0]) + scale * sigma * speed
    assert full.power_loss == pytest.approx(speed * abs(torque), rel=2e-3)
    plain = replace(ruptured, film=ReynoldsFilm()).losses(place, np.zeros(2), speed)
    assert ruptured.losses(place, np.zeros(2), speed).power_loss > 1.3 * plain.power_loss


def test_a_mobility_must_be_a_function():
    with pytest.raises(InputError, match="mobility must be"):
        ReynoldsFilm(mobility=0.5)


STEEL = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)


def two_disks(feels_tilt):
    """Return the rotor of Friswell et al. (2010), section 5.9."""
    stations = (
        rf.Station(node=n, name=name, feels_tilt=feels_tilt) for n, name in ((0, "left"), (6, "right"))
    )
    disks = []
    for node, outer in ((2, 0.28), (4, 0.35)):
        mass = 7810.0 * 0.25 * math.pi * (outer**2 - 0.05**2) * 0.07
        polar = mass / 8.0 * (outer**2 + 0.05**2)
        inertias = {"polar_inertia": polar, "diametral_inertia": 0.5 * polar + mass * 0.07**2 / 12.0}
        disks.append(rf.Disk(node=node, mass=mass, **inertias))
    shaft = rf.ShaftElement(length=1.5, outer_diameter=0.05, material=STEEL).split(6)
    return rf.ShaftRotor(elements=shaft, speed=200.0, stations=tuple(stations), disks=tuple(disks))


@pytest.mark.long
@pytest.mark.parametrize(
    ("length", "viscosity", "feels_tilt", "threshold"),
    [(0.06, 0.05, False, 218.2), (0.06, 0.05, True, 232.1), (0.03, 0.1, True, 219.1)],
)
def test_a_sagging_shaft_is_stable_to_higher_speeds(length, viscosity, feels_tilt, threshold):
    """L/D 0.6 and 0.3: thresholds of the notes, with and without moments about the equilibrium."""
    film = ReynoldsFilm(cells=(48, 4))
    bearing = journal(film, length=length, viscosity=viscosity)
    held = rf.bearings.MomentCarryingJournal(bearing=bearing) if feels_tilt else bearing
    found = rf.rotor_threshold(two_disks(feels_tilt), dict.fromkeys(("left", "right"), held), [200.0, 245.0])
    assert found.speed == pytest.approx(threshold, rel=0.02)
