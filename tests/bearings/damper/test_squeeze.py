"""Squeeze films against quadrature, textbook limits, and Darcy's layer by finite differences."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import quad, solve_ivp
from scipy.sparse import diags_array, kron
from scipy.sparse.linalg import spsolve

from rotorfilm import UndefinedDerivativeError, ValidityWarning
from rotorfilm.bearings import layer_modes
from rotorfilm.bearings.damper.squeeze_films import (
    FiniteSqueezeFilm,
    LayerModes,
    PorousLayer,
    axial_numbers,
    axial_shapes,
    leakage,
    short_squeeze_film,
)
from rotorfilm.bearings.damper.squeeze_laws import parabola_mean

SEALED = PorousLayer(
    permeability_number=0.01, grading=0.5, thickness_ratio=0.1, anisotropy=1.0, vented=False, thin=False
)
VENTED = SEALED._replace(vented=True)


def fed(layer, velocity=0.3):
    modes = layer_modes(layer)
    return modes, velocity * modes.weight * modes.passage


FILMS = {
    "solid": short_squeeze_film(layer_modes(None)),
    "Darcy": short_squeeze_film(layer_modes(SEALED)),
    "vented": short_squeeze_film(layer_modes(VENTED)),
    "fed": short_squeeze_film(*fed(SEALED)),
    "finite": FiniteSqueezeFilm(0.5, SEALED, *fed(SEALED)),
    "finite solid": FiniteSqueezeFilm(1.0, None, layer_modes(None), np.zeros(1)),
    "cavitated solid": short_squeeze_film(layer_modes(None), cavitated=True),
    "cavitated": short_squeeze_film(layer_modes(SEALED), cavitated=True),
    "clipped": short_squeeze_film(*fed(SEALED), cavitated=True),
    "clipped between pressures": short_squeeze_film(*fed(VENTED, 0.1), cavitated=True, ends=(0.2, -0.05)),
}
UNFED = {name: FILMS[name] for name in ("solid", "Darcy", "vented", "cavitated solid", "cavitated")} | {
    "finite solid": FILMS["finite solid"],
    "finite": FiniteSqueezeFilm(0.5, SEALED, *fed(SEALED, 0.0)),
}
films = pytest.mark.parametrize("film", FILMS.values(), ids=FILMS.keys())
angle = st.floats(-3.1, 3.1)


def random_states(count, largest=0.85):
    rng = np.random.default_rng(5)
    chi, phi = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


@films
def test_jacobian_equals_differences_of_fourth_order(film):
    e, w = random_states(8)
    jacobian, h = film.jacobian(e, w), 1e-4
    for column in range(4):
        d = np.zeros((4, 1))
        d[column] = h

        def at(steps, d=d):
            return film.force(e + steps * d[:2], w + steps * d[2:])

        difference = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h)
        scale = np.abs(jacobian).max(axis=(0, 1))
        assert_allclose(jacobian[:, column] / scale, difference / scale, atol=1e-8)


@films
@settings(deadline=None, max_examples=10)
@given(chi=st.floats(0.0, 0.95), phi=angle, direction=angle, turn=angle)
def test_rotation_invariance(film, chi, phi, direction, turn):
    e = chi * np.array([np.cos(phi), np.sin(phi)])
    w = np.array([np.cos(direction), np.sin(direction)])
    R = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    force = film.force(e, w)
    assert_allclose(film.force(R @ e, R @ w), R @ force, atol=1e-7 * (1.0 + np.linalg.norm(force)))


@pytest.mark.parametrize("film", UNFED.values(), ids=UNFED.keys())
@settings(deadline=None, max_examples=25)
@given(chi=st.floats(0.0, 0.99), phi=angle, vx=st.floats(-5, 5), vy=st.floats(-5, 5))
def test_film_without_feed_dissipates(film, chi, phi, vx, vy):
    w = np.array([vx, vy])
    force = film.force(chi * np.array([np.cos(phi), np.sin(phi)]), w)
    assert force @ w <= 1e-12 * np.linalg.norm(force) * np.linalg.norm(w)


@films
def test_batch_equals_single_states_and_may_be_empty(film):
    e, w = random_states(4)
    force = film.force(e.reshape(2, 2, 2), w.reshape(2, 2, 2))
    jacobian = film.jacobian(e.reshape(2, 2, 2), w.reshape(2, 2, 2)).reshape(2, 4, 4)
    for k in range(4):
        assert_allclose(force.reshape(2, 4)[:, k], film.force(e[:, k], w[:, k]), atol=1e-12)
        assert_allclose(jacobian[..., k], film.jacobian(e[:, k], w[:, k]), atol=1e-10)
    assert film.force(np.zeros((2, 0)), np.zeros((2, 0))).shape == (2, 0)
    assert film.jacobian(np.zeros((2, 0)), np.zeros((2, 0))).shape == (2, 4, 0)


@films
def test_center_is_no_exception(film):
    w = np.array([0.3, -0.5])
    near = film.jacobian(np.array([1e-7, 0.0]), w)
    assert_allclose(film.jacobian(np.zeros(2), w), near, atol=2e-6 * np.abs(near).max())


@pytest.mark.closed_form
@pytest.mark.parametrize("leak", [0.0, 1e-12, 1e-4, 0.03, 8.0, 100.0])
@pytest.mark.parametrize("chi", [0.0, 1e-3, 0.3, 0.9, 0.99])
def test_full_film_of_one_leak_is_that_of_quadrature(chi, leak):
    points = [np.pi + side * near for near in (0.03, 0.3) for side in (-1, 1)]

    def integral(trig):
        def integrand(theta):
            return trig(theta) / ((1.0 + chi * np.cos(theta)) ** 3 + leak)

        return quad(integrand, 0.0, 2.0 * np.pi, points=points, epsabs=1e-12, epsrel=1e-12, limit=400)[0]

    modes, e = LayerModes(np.ones(1), np.array([leak]), np.ones(1)), np.array([chi, 0.0])
    (along, none), (_, across) = -short_squeeze_film(modes).force(np.array([e, e]).T, np.eye(2)).T
    lift = short_squeeze_film(modes, np.ones(1)).force(e, np.zeros(2))
    assert none == 0.0
    assert across == pytest.approx(integral(lambda t: np.sin(t) ** 2), rel=1e-11)
    assert along == pytest.approx(integral(lambda t: np.cos(t) ** 2), rel=1e-11)
    assert lift[0] == pytest.approx(integral(np.cos), rel=1e-10, abs=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [1e-6, 0.2, 0.7, 0.99, 0.9999])
def test_solid_full_film_is_the_textbook_squeeze_film(chi):
    # San Andres' short open-ended damper, full film: c_tt = pi/(1-e^2)^1.5, c_rr = pi (1+2e^2)/(1-e^2)^2.5.
    s2 = (1.0 - chi) * (1.0 + chi)
    radial, tangential = -FILMS["solid"].force(chi * np.array([[1.0, 1.0], [0, 0]]), np.eye(2))
    assert_allclose(radial, [np.pi * (1.0 + 2.0 * chi**2) / s2**2.5, 0.0], rtol=1e-11)
    assert_allclose(tangential, [0.0, np.pi / s2**1.5], rtol=1e-11)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [1e-6, 0.2, 0.7, 0.99, 0.9999])
def test_solid_cavitated_film_on_a_circular_orbit_is_the_textbook_one(chi):
    # F_r = -2 e^2/(1-e^2)^2, F_t = -(pi/2) e/(1-e^2)^1.5 at phidot = 1; radial motion: half of the full film.
    s2 = (1.0 - chi) * (1.0 + chi)
    force = FILMS["cavitated solid"].force(np.array([chi, 0.0]), np.array([0.0, chi]))
    assert_allclose(force, [-2.0 * chi**2 / s2**2, -0.5 * np.pi * chi / s2**1.5], rtol=1e-9)
    # Outwards and inwards: the convergent and the divergent half add up to the full film.
    both = [FILMS["cavitated solid"].force(np.array([chi, 0.0]), np.array([v, 0.0]))[0] for v in (1.0, -1.0)]
    assert both[1] - both[0] == pytest.approx(np.pi * (1.0 + 2.0 * chi**2) / s2**2.5, rel=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.1, 0.6, 0.95])
def test_porous_cavitated_orbit_equals_its_logarithms(chi):
    # int sin cos/(h^3 + c) = -eps^-2 sum co_k (h_k - 1) ln((1+eps-h_k)/(1-eps-h_k)) over the half circle.
    modes = layer_modes(SEALED)
    k = np.cbrt(modes.leak)[:, None] * np.array([-1.0, np.exp(1j * np.pi / 3), np.exp(-1j * np.pi / 3)])
    logs = np.log((1.0 + chi - k) / (1.0 - chi - k))
    each = (-k / (3.0 * modes.leak[:, None]) * (k - 1.0) * logs).sum(axis=1).real / chi**2
    force = FILMS["cavitated"].force(np.array([chi, 0.0]), np.array([0.0, chi]))
    full = FILMS["Darcy"].force(np.array([chi, 0.0]), np.array([0.0, chi]))
    assert force[0] == pytest.approx(chi * (modes.weight @ each), rel=1e-8)
    assert force[1] == pytest.approx(0.5 * full[1], rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize(("vr", "vt"), [(0.4, 0.1), (-0.3, 0.2), (0.0, -1.0), (-1.0, 1e-3)])
def test_cavitated_force_is_the_integral_of_the_clipped_pressure(vr, vt):
    chi, modes = 0.8, layer_modes(SEALED)

    def component(trig):
        def integrand(theta):
            h3 = (1.0 + chi * np.cos(theta)) ** 3
            q = vr * np.cos(theta) + vt * np.sin(theta)
            return max(-q, 0.0) * (modes.weight / (h3 + modes.leak)).sum() * trig(theta)

        turn = math.atan2(vt, vr)
        ends = sorted(
            {
                turn + 0.5 * np.pi,
                turn + 1.5 * np.pi,
                *(n * np.pi for n in (1, 3) if 0 < n * np.pi - turn - 0.5 * np.pi < np.pi),
            }
        )
        pieces = itertools.pairwise(ends)
        return sum(quad(integrand, *piece, epsabs=1e-11, epsrel=1e-10, limit=200)[0] for piece in pieces)

    force = FILMS["cavitated"].force(np.array([chi, 0.0]), np.array([vr, vt]))
    assert_allclose(force, [component(np.cos), component(np.sin)], rtol=1e-8, atol=1e-9)


def mean_by_differences(layer, h3, cells):
    """Return G: axial mean of the pressure over the layer and the film, 5-point differences, h^3 uniform.

    (k P_Y)_Y + k kappa (2 H/L)^2 P_ZZ = 0 in the layer; h^3 P_ZZ = -1 + 3 Phi/(H/L)^2 P_Y at its face.
    """
    dy = dz = 1.0 / cells
    Y = np.linspace(-1.0, 0.0, cells + 1)
    k_node, k_half = np.exp(layer.grading * Y), np.exp(layer.grading * 0.5 * (Y[1:] + Y[:-1]))
    coupling = 3.0 * layer.permeability_number / layer.thickness_ratio**2
    # Half cells at the face, at the back and in the middle of the axis; the face carries the film's flow too.
    height, width = np.full(cells + 1, dy), np.full(cells, dz)
    height[[0, -1]] *= 0.5
    width[0] *= 0.5
    flow = layer.anisotropy * (2.0 * layer.thickness_ratio) ** 2 * k_node * height
    flow[-1] += h3 / coupling
    through = (
        diags_array([np.append(k_half, 0) + np.append(0, k_half), -k_half, -k_half], offsets=[0, 1, -1]) / dy
    )
    ends = np.full(cells, 2.0)
    ends[0] = 1.0
    second = diags_array([ends, -np.ones(cells - 1), -np.ones(cells - 1)], offsets=[0, 1, -1]) / dz
    matrix = kron(through, diags_array(width)) + kron(diags_array(flow), second)
    source = np.zeros((cells + 1, cells))
    source[-1] = width / coupling
    free = slice(cells if layer.vented else 0, None)
    P = spsolve(matrix.tocsc()[free, free], source.ravel()[free])[-cells:]
    return 3.0 * float(width @ P)


@pytest.mark.closed_form
@pytest.mark.parametrize("vented", [False, True])
@pytest.mark.parametrize("anisotropy", [1.0, 4.0])
def test_series_equals_darcy_by_finite_differences(vented, anisotropy):
    layer = SEALED._replace(vented=vented, anisotropy=anisotropy, grading=0.8, permeability_number=0.02)
    modes = layer_modes(layer)
    for h3 in (1.0, 0.2):
        # second order: two extrapolations leave the fourth and then the sixth
        g = [mean_by_differences(layer, h3, cells) for cells in (32, 64, 128)]
        once = [(4.0 * b - a) / 3.0 for a, b in itertools.pairwise(g)]
        reference = (16.0 * once[1] - once[0]) / 15.0
        # the extrapolated differences err by up to 2.6e-8, sixteen times less with twice the cells
        assert (modes.weight / (h3 + modes.leak)).sum() == pytest.approx(reference, rel=4e-8)


@pytest.mark.closed_form
@pytest.mark.parametrize("vented", [False, True])
@pytest.mark.parametrize("grading", [-10.0, 0.0, 10.0])
def test_groups_of_modes_stand_for_the_whole_series(vented, grading):
    a2 = axial_numbers() ** 2
    weight = 6.0 / a2**2
    h = np.array([0.0, 0.01, 0.1, 0.5, 1.0, 2.0])[:, None]
    cases = itertools.product((1e-4, 1e-2, 1.0, 100.0), (0.02, 0.1, 0.4), (1.0, 9.0))
    for permeability, ratio, anisotropy in cases:
        layer = PorousLayer(permeability, grading, ratio, anisotropy, vented, thin=False)
        whole = (weight / (h**3 + leakage(layer, a2) / a2)).sum(axis=1) / weight.sum()
        modes = layer_modes(layer)
        assert_allclose((modes.weight / (h**3 + modes.leak)).sum(axis=1), whole, rtol=3e-9)


@pytest.mark.closed_form
def test_thin_layers_have_their_closed_forms():
    thin = SEALED._replace(thin=True)
    s = -math.expm1(-thin.grading) / thin.grading
    assert_allclose(layer_modes(thin).leak, 12.0 * thin.permeability_number * s, rtol=1e-14)
    limit = layer_modes(SEALED._replace(thickness_ratio=1e-6))
    assert_allclose(limit.leak[:3], 12.0 * thin.permeability_number * s, rtol=1e-8)
    vented = layer_modes(thin._replace(vented=True, permeability_number=1e-3))
    flux = thin.grading / math.expm1(thin.grading)
    for h in (1.0, 0.4):
        x = math.sqrt(3e-3 * flux / h**3) / thin.thickness_ratio
        G = (vented.weight / (h**3 + vented.leak)).sum()
        assert h**3 * G == pytest.approx(parabola_mean(x), rel=1e-8)


@pytest.mark.closed_form
def test_ungraded_layer_is_the_limit_of_a_graded_one_from_both_sides():
    for layer in (SEALED, VENTED, VENTED._replace(thin=True)):
        flat = layer_modes(layer._replace(grading=0.0))
        for grading in (1e-9, -1e-9):
            graded = layer_modes(layer._replace(grading=grading))
            assert_allclose(graded.leak, flat.leak, rtol=1e-8)
            assert_allclose(graded.passage, flat.passage, rtol=1e-8)


@pytest.mark.closed_form
def test_sealed_layer_passes_the_hyperbolic_part_of_what_enters_its_back():
    modes = layer_modes(SEALED._replace(grading=0.0))
    q = 2.0 * 0.1 * 0.5 * np.pi * np.array([1.0, 3.0, 5.0])
    assert_allclose(modes.passage[:3], 1.0 / np.cosh(q), rtol=1e-13)


def test_axial_shapes_add_up_to_a_parabola_and_their_means_are_the_weights():
    modes = layer_modes(SEALED)
    Z, weights = np.polynomial.legendre.leggauss(400)
    shapes = axial_shapes(modes, Z)
    assert_allclose(shapes.sum(axis=0), 0.5 * (1.0 - Z**2), atol=1e-14)
    assert_allclose(1.5 * (shapes @ weights)[:12], modes.weight[:12], rtol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("slenderness", [0.25, 0.5, 1.0])
def test_finite_film_in_small_motion(slenderness):
    ratio = slenderness
    film = FiniteSqueezeFilm(slenderness, None, layer_modes(None), np.zeros(1))
    damping = -film.jacobian(np.zeros(2), np.ones(2))[0, 2] / np.pi
    assert damping == pytest.approx(3.0 * (1.0 - math.tanh(ratio) / ratio) / ratio**2, rel=1e-6)
    assert damping == pytest.approx({0.25: 0.976, 0.5: 0.909, 1.0: 0.715}[ratio], abs=5e-4)


@pytest.mark.parametrize("layer", [None, SEALED, VENTED, SEALED._replace(thin=True)], ids=str)
def test_finite_film_becomes_short(layer):
    e, w = random_states(4)
    modes, feed = fed(layer)
    short = short_squeeze_film(modes, feed).jacobian(e, w)
    if layer is None:
        feed = feed / 1.0
    errors = [
        np.abs(FiniteSqueezeFilm(ratio, layer, modes, feed).jacobian(e, w) - short).max()
        for ratio in (0.02, 0.01)
    ]
    assert errors[1] < 1e-3 * np.abs(short).max()
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)


def test_finite_film_equals_the_two_dimensional_reynolds_film():
    from rotorfilm import FullFilm
    from rotorfilm.bearings.journal import ReynoldsFilm

    # A film is fed by w = v/c: the same source, in units of viscosity length radius^3 / clearance^2.
    slenderness, e, w = 0.5, np.array([0.5, 0.2]), np.array([0.3, -0.7])
    reynolds, _ = ReynoldsFilm(cells=(192, 32), cavitation=FullFilm()).extrapolated(e, w, slenderness)
    finite = FiniteSqueezeFilm(slenderness, None, layer_modes(None), np.zeros(1)).force(e, w)
    assert_allclose(4.0 * slenderness**2 * finite, reynolds, rtol=2e-4)


def test_clipping_with_hardly_any_feed_is_the_half_circle():
    e, w = random_states(10)
    clipped = short_squeeze_film(*fed(SEALED, 1e-9), cavitated=True).force(e, w)
    assert_allclose(clipped, FILMS["cavitated"].force(e, w), atol=2e-5 * np.abs(clipped).max())


@pytest.mark.parametrize("layer", [SEALED, VENTED])
def test_strong_feed_fills_the_film(layer):
    # Enough inflow keeps every pressure positive: then clipping does nothing.
    e, w = random_states(5, largest=0.5)
    modes, feed = fed(layer, 60.0)
    clipped = short_squeeze_film(modes, feed, cavitated=True, ends=(1.0, 0.5))
    assert_allclose(clipped.force(e, w), short_squeeze_film(modes, feed).force(e, w), rtol=1e-5)


def test_strong_suction_empties_the_film():
    modes, feed = fed(SEALED._replace(thin=True), -50.0)
    e, w = random_states(5)
    assert_allclose(short_squeeze_film(modes, feed, cavitated=True).force(e, w), 0.0, atol=1e-14)


@pytest.mark.parametrize(("layer", "ends"), [(SEALED, (0.0, 0.0)), (None, (0.3, 0.3))], ids=["back", "ends"])
def test_clipped_force_is_that_of_the_pressures_on_a_fine_grid(layer, ends):
    # p = ends + sum shape (w.u + feed/weight)/(h^3 + leak), F = -(3/2) int int max(p, 0) u, in plain sums.
    modes, feed = fed(layer, 0.3 if layer else 0.0)
    Z = (np.arange(400) + 0.5) / 200.0 - 1.0
    theta = 2.0 * np.pi * (np.arange(800) + 0.5) / 800
    u, shapes = np.stack([np.cos(theta), np.sin(theta)]), axial_shapes(modes, Z)
    film = short_squeeze_film(modes, feed, cavitated=True, ends=ends)
    for e, w in zip(*(part.T for part in random_states(3, 0.7)), strict=True):
        inverse = 1.0 / ((1.0 - e @ u) ** 3 + modes.leak[:, None])
        p = shapes.T @ (inverse * (w @ u + (feed / modes.weight)[:, None])) + ends[0]
        force = -1.5 * u @ np.maximum(p, 0.0).sum(axis=0) * (2.0 / 400) * (2.0 * np.pi / 800)
        assert_allclose(film.force(e, w), force, atol=1e-3 * np.linalg.norm(force))


@pytest.mark.parametrize("name", ["cavitated solid", "cavitated"])
def test_cavitated_film_has_no_damping_matrix_at_rest(name):
    assert_allclose(FILMS[name].force(np.array([0.3, 0.0]), np.zeros(2)), 0.0)
    with pytest.raises(UndefinedDerivativeError, match=r"no damping matrix at rest.*equivalent coefficients"):
        FILMS[name].jacobian(np.array([0.3, 0.0]), np.zeros(2))


def test_fed_film_at_rest_has_a_derivative():
    assert np.all(np.isfinite(FILMS["clipped"].jacobian(np.array([0.3, 0.0]), np.zeros(2))))


@pytest.mark.parametrize("film", UNFED.values(), ids=UNFED.keys())
@pytest.mark.filterwarnings("ignore:eccentricity ratio must not exceed 0.99")
def test_force_is_finite_up_to_the_wall(film):
    for chi in (0.999, 1.0 - 1e-9):
        assert np.all(np.isfinite(film.force(np.array([chi, 0.0]), np.array([0.3, -0.5]))))


@pytest.mark.closed_form
@pytest.mark.parametrize("grading", [0.7, -1.3])
def test_exchange_of_a_graded_layer_is_that_of_its_differential_equation(grading):
    # P'' + grading P' = q^2 P, two solutions from the back by an initial-value solver.
    q2 = 4.0 * (0.1 * 0.5 * np.pi) ** 2 * 9.0  # second mode

    def from_back(value, slope):
        run = solve_ivp(
            lambda y, P: [P[1], q2 * P[0] - grading * P[1]],
            (-1.0, 0.0),
            [value, slope],
            rtol=1e-11,
            atol=1e-13,
        )
        return run.y[:, -1]

    sealed, driven = from_back(1.0, 0.0), from_back(0.0, 1.0)
    closed = layer_modes(SEALED._replace(grading=grading))
    unit = 12.0 * SEALED.permeability_number / q2
    assert closed.leak[1] == pytest.approx(unit * sealed[1] / sealed[0], rel=1e-9)
    # Slope at the face with P(0) = 0 for slope 1 at the back; flux = k times slope, k(-1) = exp(-grading).
    reached = driven[1] - driven[0] * sealed[1] / sealed[0]
    assert closed.passage[1] == pytest.approx(reached * math.exp(grading), rel=1e-9)
    vented = layer_modes(VENTED._replace(grading=grading))
    assert vented.leak[1] == pytest.approx(unit * driven[1] / driven[0], rel=1e-9)
    supplied = sealed[1] - sealed[0] * driven[1] / driven[0]  # P = 1 at the back, 0 at the face
    assert vented.passage[1] == pytest.approx(-supplied, rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("thin", [False, True])
def test_finite_porous_film_in_small_motion(thin):
    # At the center each mode (cos a_n Z)(cos theta) is alone: k^2 = a_n^2 + (L/D)^2, a layer takes q tanh q.
    slenderness, ratio, phi = 0.8, 0.1, 0.05
    layer = SEALED._replace(grading=0.0, permeability_number=phi, thin=thin)
    a2 = (0.5 * np.pi * (2.0 * np.arange(1, 20001) - 1.0)) ** 2
    k2 = a2 + slenderness**2
    q = 2.0 * ratio * np.sqrt(k2)
    leak = 12.0 * phi * k2 if thin else 3.0 * phi / ratio**2 * q * np.tanh(q)
    expected = np.pi * np.sum(6.0 / a2 / (k2 + leak))
    film = FiniteSqueezeFilm(slenderness, layer, *fed(layer, 0.0))
    assert -film.jacobian(np.zeros(2), np.ones(2))[0, 2] == pytest.approx(expected, rel=1e-6)


def test_finite_film_beyond_its_range_warns():
    with pytest.warns(ValidityWarning, match="must not exceed 0.99 for a film of finite length, got 0.995"):
        FILMS["finite solid"].force(np.array([0.995, 0.0]), np.ones(2))


@pytest.mark.closed_form
@pytest.mark.parametrize("tiny", [5e-324, 1e-310, 1e-200])
def test_a_direction_of_denormal_numbers_is_one(tiny):
    # At the center the damping is isotropic: the direction of a vanishing eccentricity must not matter.
    film = FiniteSqueezeFilm(0.5, None, layer_modes(None), np.zeros(1))
    rate = np.array([3.0, -2.0])
    for e in ([tiny, tiny], [tiny, 0.0], [-tiny, tiny], [0.0, 0.0]):
        np.testing.assert_allclose(film.force(np.array(e), rate), film.force(np.zeros(2), rate), rtol=1e-12)
