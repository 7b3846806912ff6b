"""Inertia of squeeze films: quadrature, exact Navier-Stokes equations, published ratios, finite length."""

import runpy
from pathlib import Path

import numpy as np
import pytest
from families.built_truth import Place
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import FilmContactError, InputError, ValidityWarning
from rotorfilm.bearings.damper.squeeze_laws import FilmInertia, squeeze_motions

ROOT = Path(__file__).parents[3]
SIZE = {"radius": 63.5e-3, "length": 25.4e-3, "clearance": 0.127e-3, "viscosity": 2.5e-3}
OIL = 800.0
FULL = rf.FullFilm()


def circle(count=4000):
    theta = 2.0 * np.pi * (np.arange(count) + 0.5) / count
    return np.stack([np.cos(theta), np.sin(theta)]), 2.0 * np.pi / count


def orbit_mass(eps):
    """Return F_r/(e w^2) of the inertia on a circular orbit, per pi/10."""
    film, e, w = FilmInertia(closed=1.0), np.array([eps, 0.0]), np.array([0.0, eps])
    return float((film.mass(e, w) @ e + film.force(e, w))[0] / eps / (0.1 * np.pi))


def test_short_film_is_its_integrals():
    # San Andres' and Vance's form: M = (1/10) of m m/h, convection (17/70) of (w.m)^2 m/h^2.
    m, step = circle()
    film = FilmInertia(closed=1.0)
    rng = np.random.default_rng(4)
    for _ in range(5):
        e, w = rng.uniform(-0.6, 0.6, 2), rng.normal(size=2)
        h = 1.0 + e @ m
        assert_allclose(film.mass(e, w), 0.1 * step * np.einsum("ik,jk,k->ij", m, m, 1.0 / h), atol=1e-13)
        push = 17.0 / 70.0 * step * m @ ((w @ m) ** 2 / h**2)
        assert_allclose(film.force(e, w), push, atol=1e-12)


def test_ruptured_film_is_the_integral_over_its_half_circle():
    m, step = circle(200_000)
    e, w = np.array([0.3, -0.5]), np.array([-0.4, 1.1])
    h, inside = 1.0 + e @ m, (w @ m) < 0.0
    film = FilmInertia(zone=1.0)
    mass = 0.1 * step * np.einsum("ik,jk,k->ij", m, m, inside / h)
    assert_allclose(film.mass(e, w), mass, rtol=2e-5)
    push = 17.0 / 70.0 * step * m @ (inside * (w @ m) ** 2 / h**2)
    assert_allclose(film.force(e, w), push, rtol=2e-5)


@pytest.mark.literature
def test_convection_turns_the_added_mass_into_a_push_inward():
    # San Andres & Vance (1986): radial inertia is reversed on large orbits, by the convective terms only.
    assert_allclose(
        [orbit_mass(eps) for eps in (0.2, 0.5, 0.7, 0.9)], [0.980, 0.835, 0.500, -1.18], atol=5e-3
    )
    assert abs(orbit_mass(0.8087)) < 1e-3
    film = FilmInertia(closed=1.0)
    assert film.mass(np.array([0.9, 0.0]), np.zeros(2))[0, 0] > 0.1 * np.pi


@pytest.mark.parametrize(
    ("eps", "reynolds", "error"), [(0.1, 5.0, 3e-3), (0.5, 10.0, 0.018), (0.8, 10.0, 0.025)]
)
def test_inertia_against_navier_stokes(eps, reynolds, error):
    exact = runpy.run_path(str(ROOT / "benchmarks" / "squeeze_inertia.py"))
    right = exact["exact_orbit"](eps, reynolds, nodes=21, steps=300)
    with_inertia, without = exact["film_orbit"](eps, reynolds)
    assert exact["off"](with_inertia, right) < error
    assert exact["off"](without, right) > exact["off"](with_inertia, right)


def test_ruptured_inertia_against_the_cut_off_of_both_pressures():
    exact = runpy.run_path(str(ROOT / "benchmarks" / "squeeze_inertia.py"))
    found = [
        exact["off"](exact["film_orbit"](eps, re, ruptured=True)[0], exact["cut_off"](eps, re))
        for eps, re in ((0.2, 2.0), (0.2, 5.0), (0.5, 5.0))
    ]
    assert_allclose(found, [0.005, 0.026, 0.046], atol=1.5e-3)


def test_finite_length_becomes_short():
    errors = []
    film, e = FilmInertia(closed=1.0), np.array([0.6, 0.0])
    short = np.diag(film.mass(e, e))
    for slenderness in (0.08, 0.04):
        errors.append(np.abs(squeeze_motions(0.6, slenderness, np.inf).mass - short).max())
    assert 3.6 < errors[0] / errors[1] < 4.4
    found = squeeze_motions(0.6, 0.01, np.inf).convection
    pushes = [film.force(e, np.array(w))[k] for w, k in (((1, 0), 0), ((0, 1), 0), ((1, 1), 1))]
    assert_allclose(found, pushes, rtol=1e-3)


@pytest.mark.parametrize(
    ("slenderness", "end_leak", "expected"),
    [
        # C_tt, M_rr, M_tt, M_orbit of an independent code by differences
        (0.05, np.inf, (1.536, 1.237, 1.072, 0.836)),
        (1.0, np.inf, (0.905, 0.882, 0.887, 0.674)),
        (0.2, 0.0, (76.98, 80.4, 107.9, 45.7)),
    ],
)
def test_finite_length_by_reciprocity(slenderness, end_leak, expected):
    found = squeeze_motions(0.5, slenderness, end_leak)
    mass = np.array(found.mass) / (0.1 * np.pi)
    orbit = mass[0] + 0.5 * found.convection[1] / (0.1 * np.pi)
    assert_allclose([found.damping[1] / np.pi, *mass, orbit], expected, rtol=1e-3)


@pytest.mark.parametrize("seals", [None, rf.EndSeal(leakage=1e-10)])
def test_small_motion_is_that_of_the_film(seals):
    # M/C = density c^2/(10 viscosity), open or tight; of a leaking seal the table of the film has both.
    damper = rf.SqueezeFilmDamper(**SIZE, density=OIL, extent=FULL, film=rf.FiniteSqueeze(), seals=seals)
    small = damper.small_motion(0.0)
    if seals is None:
        ratio = OIL * SIZE["clearance"] ** 2 / (10.0 * SIZE["viscosity"])
        assert_allclose(small.added_mass / small.damping, ratio, rtol=1e-6)
    found = rf.coefficients(damper, [0.0, 0.0], 0.0)
    assert_allclose(found.damping, small.damping * np.eye(2), rtol=2e-6, atol=1e-6)
    assert_allclose(found.mass, small.added_mass * np.eye(2), rtol=2e-6, atol=1e-9)


def dampers():
    sealed = {"film": rf.FiniteSqueeze(), "seals": rf.EndSeal(leakage=1e-10)}
    for change in ({"extent": FULL}, {}, {"extent": FULL, **sealed}, {"film": rf.bearings.MapSqueeze()}):
        yield rf.SqueezeFilmDamper(**SIZE, density=OIL, **change)


@pytest.mark.parametrize("damper", list(dampers()), ids=["short", "ruptured", "sealed", "map"])
def test_derivatives_and_symmetries(damper):
    rng, c = np.random.default_rng(1), damper.clearance
    q, v = rng.uniform(-0.6, 0.6, (2, 4)) * c, rng.uniform(-1, 1, (2, 4)) * 300.0 * c
    jacobian, slopes = damper.jacobian(q, v), damper.mass_slopes(q, v)
    for k, step in enumerate((c, c, 300.0 * c, 300.0 * c)):
        shift = np.zeros((4, 1))
        shift[k] = 1e-6 * step
        up, down = (q + shift[:2], v + shift[2:]), (q - shift[:2], v - shift[2:])
        by_force = (damper.force(*up) - damper.force(*down)) / (2e-6 * step)
        assert_allclose(by_force, jacobian[:, k], atol=1e-7 * np.abs(jacobian[:, k]).max())
        by_mass = (damper.mass(*up) - damper.mass(*down)) / (2e-6 * step)
        assert_allclose(by_mass, slopes[:, :, k], atol=1e-7 * np.abs(slopes).max() + 1e-12)
    turn = np.array([[np.cos(1.0), -np.sin(1.0)], [np.sin(1.0), np.cos(1.0)]])
    assert_allclose(damper.force(turn @ q, turn @ v), turn @ damper.force(q, v), rtol=1e-6)
    turned = np.einsum("ij,jkb,lk->ilb", turn, damper.mass(q, v), turn)
    assert_allclose(damper.mass(turn @ q, turn @ v), turned, rtol=1e-7, atol=1e-9)


def test_without_density_nothing_changes():
    damper = rf.SqueezeFilmDamper(**SIZE)
    q, v = np.array([3e-5, 0.0]), np.array([0.0, 0.02])
    assert_allclose(damper.force(q, v), rf.PorousDamper(**SIZE).force(q, v), rtol=0.0)
    assert not damper.mass(q, v).any()
    assert [signal.name for signal in damper.outputs] == ["force_x", "force_y"]
    assert rf.SqueezeFilmDamper(**SIZE, film=rf.bearings.MapSqueeze()).native() is not None


def test_the_range_of_the_inertia_is_told():
    damper = rf.SqueezeFilmDamper(**SIZE, density=OIL, extent=FULL)
    per_reynolds = 1.0 / damper.reynolds_number(1.0)
    damper.require_range(9.9 * per_reynolds)
    with pytest.warns(ValidityWarning, match="must not exceed 10 for the inertia of a full film, got 11"):
        damper.require_range(11.0 * per_reynolds)
    with pytest.raises(InputError, match=r"must not exceed 20 .* got 21"):
        damper.require_range(-21.0 * per_reynolds)
    with pytest.warns(ValidityWarning, match="must not exceed 5 for the inertia of a ruptured film"):
        rf.SqueezeFilmDamper(**SIZE, density=OIL).require_range(7.0 * per_reynolds)


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"density": -1.0}, "density must be"),
        ({"density": np.nan}, "density must be"),
        (
            {"density": OIL, "cage": rf.PorousCage(thickness=2e-3, permeability=1e-14)},
            "density must not be given with a porous cage",
        ),
        (
            {"density": OIL, "extent": FULL, "film": rf.bearings.PublishedSqueeze()},
            "density must be 0 for Published",
        ),
    ],
)
def test_what_has_no_inertia_is_refused(change, text):
    with pytest.raises(InputError, match=text):
        rf.SqueezeFilmDamper(**SIZE, **change)


def test_bad_states_of_the_mass_are_named():
    ruptured = rf.SqueezeFilmDamper(**SIZE, density=OIL)
    with pytest.raises(InputError, match="velocity must be given for the mass of a ruptured film"):
        ruptured.mass([0.0, 0.0])
    full = rf.SqueezeFilmDamper(**SIZE, density=OIL, extent=FULL)
    with pytest.raises(FilmContactError):
        full.mass([2e-4, 0.0])
    with pytest.raises(InputError, match="position"):
        full.mass([np.nan, 0.0])
    with pytest.raises(InputError, match="small_motion needs a FullFilm"):
        ruptured.small_motion(100.0)


@pytest.mark.parametrize(("slimness", "leakage"), [(0.1, None), (0.5, None), (0.3, 2e-9), (0.3, 2e-10)])
def test_finite_film_on_orbits_is_that_of_another_code(slimness, leakage):
    # Collocation, and the pressure of the inertia solved for: benchmarks/families/built_truth.py
    R, c, mu, w = 0.05, 1e-4, 5e-3, 2000.0
    damper = rf.SqueezeFilmDamper(
        radius=R,
        length=2.0 * R * slimness,
        clearance=c,
        viscosity=mu,
        density=850.0,
        extent=FULL,
        film=rf.FiniteSqueeze(),
        seals=None if leakage is None else rf.EndSeal(leakage=leakage),
    )
    leak = np.inf if leakage is None else 12.0 * mu * R * leakage / c**3
    for eps in (0.2, 0.7):
        q, v = np.array([eps * c, 0.0]), np.array([0.0, w * eps * c])
        found = damper.force(q, v) + w**2 * damper.mass(q, v) @ q
        right = Place(slimness, leak, eps, damper.reynolds_number(w)).full() * 12.0 * mu * w * R**4 / c**2
        assert_allclose(found, [right.real, right.imag], atol=1e-6 * abs(right))
