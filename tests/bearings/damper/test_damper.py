"""The porous squeeze-film damper: SI, its groups, its Reaction, its refusals, and the historical option."""

import warnings
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.testing import assert_allclose

from rotorfilm import (
    FilmContactError,
    FiniteSqueeze,
    FullFilm,
    InputError,
    Model,
    PorousCage,
    PorousDamper,
    RadialFeed,
    Reaction,
    ValidityWarning,
    with_springs,
)
from rotorfilm.bearings import AxialFeed, Complementarity, PublishedSqueeze, damper_groups
from rotorfilm.bearings.damper.squeeze_films import mean_permeability

DIMENSIONS = {"radius": 0.05, "length": 0.025, "clearance": 1e-4, "viscosity": 0.01}
CAGE = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
SOLID = PorousDamper(**DIMENSIONS, extent=FullFilm())
POROUS = replace(SOLID, cage=CAGE)
PI = PorousDamper(**DIMENSIONS, cage=CAGE)
unit = st.floats(-1.0, 1.0)


def damping_at_rest(damper):
    return -damper.jacobian([0.0, 0.0], [0.0, 0.0], 0.0)[0, 2]


def test_it_is_a_reaction_whose_speed_does_not_matter():
    assert isinstance(PI, Reaction)
    assert isinstance(PI, Model)
    q, v = [3e-5, -4e-5], [0.01, 0.02]
    assert_allclose(PI.force(q, v, 700.0), PI.force(q, v, -3.0), rtol=1e-15)
    assert_allclose(PI.force(q, v), PI.output(0.0, [], [*q, *v, 50.0]), rtol=1e-15)
    jacobian = PI.jacobian(q, v, 700.0)
    assert jacobian.shape == (2, 5)
    assert_allclose(jacobian[:, 4], 0.0)
    assert_allclose(PI.linearization(0.0, [], [*q, *v, 50.0]).D, jacobian, rtol=1e-15)
    assert_allclose(PI.prepare()(*q, *v, 0.0), PI.force(q, v), rtol=1e-15)


@pytest.mark.closed_form
def test_damping_of_the_centered_solid_damper_in_si_units():
    # C = pi mu R (L/c)^3, full film; half the circle carries half of it.
    C = np.pi * 0.01 * 0.05 * (0.025 / 1e-4) ** 3
    assert damping_at_rest(SOLID) == pytest.approx(C, rel=1e-13)
    force = PorousDamper(**DIMENSIONS).force([0.0, 0.0], [0.0, 0.3])
    assert_allclose(force, [0.0, -0.5 * C * 0.3], rtol=1e-13, atol=1e-12 * C)


@pytest.mark.parametrize("clearance", [1e-5, 1e-3])
def test_clearance_and_thickness_only_scale(clearance):
    # Same Phi, same H/L: F ~ c^-2 at the same eccentricity ratio and rate.
    scale = clearance / 1e-4
    other = replace(PI, clearance=clearance, cage=replace(CAGE, permeability=4e-13 * scale**3))
    force = PI.force([5e-5, 0.0], [1e-3, 2e-3])
    assert_allclose(
        other.force([5e-5 * scale, 0.0], [1e-3 * scale, 2e-3 * scale]), force / scale**2, rtol=1e-12
    )


@pytest.mark.closed_form
def test_groups_of_the_paper():
    groups = damper_groups(
        PI, mass=10.0, speed=400.0, stiffness=2.56e5, unbalance=4e-4, reference_speed=400.0
    )
    assert groups.permeability_number == pytest.approx(4e-13 * 2.5e-3 / 1e-12, rel=1e-14)  # A H/C^3
    assert groups.thickness_ratio == pytest.approx(0.1)
    assert groups.squeeze_number == pytest.approx(0.01 * 0.05 * 0.025**3 / (10.0 * 400.0 * 1e-12), rel=1e-14)
    assert groups.damper_number == pytest.approx(
        0.01 * 0.05**3 * 0.025 / (2 * 10.0 * 400.0 * 1e-12), rel=1e-14
    )
    assert (groups.speed_ratio, groups.unbalance_ratio) == pytest.approx((1.0, 0.4))
    assert groups.spring_ratio == pytest.approx(0.4)
    # (C centered)/(m w_r) = pi Bs
    assert damping_at_rest(SOLID) / (10.0 * 400.0) == pytest.approx(np.pi * groups.squeeze_number)
    assert damper_groups(SOLID, mass=1.0, speed=1.0).permeability_number == 0.0


@pytest.mark.closed_form
def test_thin_layer_leaks_as_morgan_and_cameron_have_it():
    thin = replace(POROUS, cage=replace(CAGE, thin=True, permeability=2e-10, anisotropy=3.0))
    phi = 2e-10 * 2.5e-3 / 1e-12
    expected = 1.0 / (1.0 + 12.0 * phi * 3.0 * mean_permeability(0.1))
    assert damping_at_rest(thin) / damping_at_rest(SOLID) == pytest.approx(expected, rel=1e-12)


def test_a_tighter_or_thinner_layer_damps_more():
    values = [
        damping_at_rest(replace(POROUS, cage=replace(CAGE, **{"permeability": 1e-10} | change)))
        for change in ({"vented": True}, {"anisotropy": 4.0}, {}, {"grading": 2.0}, {"permeability": 1e-12})
    ]
    assert values == sorted(values)
    assert values[-1] < damping_at_rest(SOLID)


@pytest.mark.closed_form
def test_feed_through_a_thin_layer_centers_the_rotor():
    # K = 3 pi Bs v m w_r^2/(1 + c)^2 with v = inflow/(C w_r), uniform; 24/pi^3 of it for a cosine.
    cage = replace(CAGE, thin=True)
    leak = 12.0 * 1e-3 * mean_permeability(0.1)
    scale = POROUS.force_scale / 1e-4
    for cosine, share in ((False, 1.0), (True, 24.0 / np.pi**3)):
        fed = replace(POROUS, cage=cage, feed=RadialFeed(inflow=0.02, cosine=cosine))
        stiffness = -fed.jacobian([0.0, 0.0], [0.0, 0.0])[:, :2]
        expected = 3.0 * np.pi * share * scale * 0.02 / 1e-4 / (1.0 + leak) ** 2
        assert_allclose(stiffness, expected * np.eye(2), rtol=1e-11, atol=1e-11 * expected)
        sucked = replace(fed, feed=RadialFeed(inflow=-0.02, cosine=cosine))
        assert_allclose(sucked.jacobian([0.0, 0.0], [0.0, 0.0])[:, :2], stiffness, rtol=1e-12)


@pytest.mark.closed_form
def test_cosine_feed_through_darcys_layer_is_its_first_mode():
    fed = replace(POROUS, feed=RadialFeed(inflow=0.02, cosine=True), cage=replace(CAGE, grading=0.0))
    q = 2.0 * 0.1 * 0.5 * np.pi
    leak = 12.0 * 1e-3 * np.tanh(q) / q
    v = 0.02 / 1e-4 / np.cosh(q)  # what the layer passes
    expected = 3.0 * np.pi * 24.0 / np.pi**3 * v / (1.0 + leak) ** 2 * fed.force_scale / 1e-4
    assert -fed.jacobian([0.0, 0.0], [0.0, 0.0])[0, 0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("grading", [0.0, 0.8])
def test_feed_stiffness_by_where_the_velocity_is_given(grading):
    # Into the film: 3 pi Bs v sum of w_n/(1 + c_n)^2, modes by hand. At the back each mode has less: 1/cosh
    # of its wave number without grading, from the two exponentials of Darcy's equation with it.
    cage, count = replace(CAGE, grading=grading), 400
    a = 0.5 * np.pi * (2.0 * np.arange(1, count + 1) - 1.0)
    q = 2.0 * 0.1 * a
    d = np.sqrt(grading**2 + 4.0 * q**2)
    up, down = 0.5 * (d - grading), 0.5 * (d + grading)  # P = exp(up Y), exp(-down Y)
    sealed = (np.exp(-d) * up * down - up * down) / (
        -down - up * np.exp(-d)
    )  # P'/P at the film, P' = 0 behind
    weight, leak = 6.0 / a**4, 12.0 * 1e-3 * sealed / q**2
    passed = np.exp(-up) * d / (down + up * np.exp(-d))
    unit = 3.0 * np.pi * 0.02 / 1e-4 * POROUS.force_scale / 1e-4
    for at_film, share in ((True, np.ones(count)), (False, passed)):
        fed = replace(POROUS, cage=cage, feed=RadialFeed(inflow=0.02, at_film=at_film))
        stiffness = -fed.jacobian([0.0, 0.0], [0.0, 0.0])[0, 0]
        assert stiffness == pytest.approx(unit * np.sum(weight * share / (1.0 + leak) ** 2), rel=1e-7)
    if not grading:
        assert passed == pytest.approx(1.0 / np.cosh(q), rel=1e-12)
        assert passed[0] == pytest.approx(0.9526, abs=5e-5)


def test_axial_feed_leaves_a_full_film_alone_and_fills_a_cavitated_one():
    feed = AxialFeed(start_pressure=2e5, end_pressure=1.5e5)
    q, v = [4e-5, 1e-5], [0.01, -0.03]
    assert_allclose(replace(POROUS, feed=feed).force(q, v), POROUS.force(q, v), rtol=1e-14)
    little, much = (
        replace(PI, feed=AxialFeed(start_pressure=p, end_pressure=p)).force(q, v) for p in (1.0, 1e9)
    )
    assert_allclose(little, PI.force(q, v), rtol=1e-3)
    assert_allclose(much, POROUS.force(q, v), rtol=1e-5)


def test_supply_behind_a_vented_back_is_a_feed():
    vented = replace(POROUS, cage=replace(CAGE, vented=True, supply_pressure=1e5))
    jacobian = vented.jacobian([0.0, 0.0], [0.0, 0.0])
    assert -jacobian[0, 0] > 0.0
    none = replace(vented, cage=replace(vented.cage, supply_pressure=0.0))
    assert_allclose(jacobian[:, 2:4], none.jacobian([0.0, 0.0], [0.0, 0.0])[:, 2:4], rtol=1e-14)


@settings(deadline=None, max_examples=40)
@given(
    x=unit,
    y=unit,
    vx=unit,
    vy=unit,
    grading=st.floats(-3.0, 3.0),
    anisotropy=st.floats(0.01, 100.0),
    permeability=st.floats(1e-14, 1e-8),
    vented=st.booleans(),
    thin=st.booleans(),
)
def test_every_cage_without_feed_dissipates(x, y, vx, vy, grading, anisotropy, permeability, vented, thin):
    cage = PorousCage(
        thickness=2.5e-3,
        permeability=permeability,
        grading=grading,
        anisotropy=anisotropy,
        vented=vented,
        thin=thin,
    )
    q, v = 0.69e-4 * np.array([x, y]), np.array([vx, vy])
    for damper in (replace(PI, cage=cage), replace(POROUS, cage=cage)):
        force = damper.force(q, v)
        assert force @ v <= 1e-12 * np.linalg.norm(force) * np.linalg.norm(v)


@settings(deadline=None, max_examples=40)
@given(x=unit, y=unit, vx=unit, vy=unit, grading=st.floats(0.0, 3.0))
def test_the_historical_option_dissipates_with_its_signs_corrected(x, y, vx, vy, grading):
    film = replace(POROUS, cage=replace(CAGE, grading=grading), film=PublishedSqueeze())
    v = np.array([vx, vy])
    assert film.force(0.69e-4 * np.array([x, y]), v) @ v <= 0.0


@pytest.mark.literature
def test_as_printed_the_film_drives_the_rotor():
    # Akhverdiev et al., (37) and (38) without feed: F_e = +8 pi mu R^3 w L^3 epsdot/(C^2 D^2), and with
    # phidot - 1/2 in F_phi, rates per w.
    def printed_power(eps_rate, eps_phi_rate, eps):
        return eps_rate * eps_rate + (eps_phi_rate - 0.5 * eps) * eps_phi_rate

    assert printed_power(0.3, 0.0, 0.2) > 0.0  # negative damping
    assert printed_power(0.0, 0.4, 0.2) > 0.0


@pytest.mark.literature
def test_historical_trend_is_opposite_to_the_layer():
    # Delta1 grows with the grading, which makes the cage tighter; without grading it has no effect at all.
    def ratio(film, grading):
        cage = replace(CAGE, permeability=1e-10, grading=grading, vented=False)
        return damping_at_rest(replace(POROUS, cage=cage, film=film)) / damping_at_rest(SOLID)

    assert ratio(PublishedSqueeze(), 0.0) == pytest.approx(1.0, abs=1e-12)
    assert ratio(PublishedSqueeze(), 1.0) < ratio(PublishedSqueeze(), 0.1) < 1.0
    assert ratio(POROUS.film, 0.0) < ratio(POROUS.film, 0.1) < ratio(POROUS.film, 1.0)


def test_short_film_beyond_its_range_warns_with_its_error():
    with pytest.warns(ValidityWarning, match=r"must not exceed 0.25 .* got 0.5: .* too large by 10 %"):
        PorousDamper(**DIMENSIONS | {"length": 0.05})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        long = PorousDamper(**DIMENSIONS | {"length": 0.05}, extent=FullFilm(), film=FiniteSqueeze())
    C = np.pi * 0.01 * 0.05 * 500.0**3
    assert C / damping_at_rest(long) == pytest.approx(1.0 + 0.10, abs=2e-3)
    with pytest.warns(ValidityWarning, match="thickness must not exceed 0.5 of the radius"):
        replace(PI, cage=replace(CAGE, thickness=0.03))


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"clearance": 0.0}, "clearance must be finite and positive, got 0.0"),
        ({"clearance": 0.06}, "clearance must be below the radius 0.05, got 0.06"),
        ({"viscosity": np.nan}, "viscosity must be finite and positive, got nan"),
        ({"cage": 3}, "cage must be a PorousCage or None, got 3"),
        ({"extent": Complementarity()}, "extent must be FullFilm.. or HalfSommerfeld"),
        ({"feed": 1.0}, "feed must be a RadialFeed, an AxialFeed or None, got 1.0"),
        ({"film": FiniteSqueeze}, "film must be a squeeze film such as ShortSqueeze"),
        ({"film": FiniteSqueeze()}, "extent must be FullFilm.. for FiniteSqueeze.., got a cavitated film"),
        ({"film": PublishedSqueeze()}, "extent must be FullFilm.. for PublishedSqueeze"),
        (
            {"cage": replace(CAGE, vented=True), "feed": RadialFeed(inflow=1.0)},
            "feed must not be a RadialFeed where the back of the cage is vented",
        ),
    ],
)
def test_bad_dampers_are_named(change, match):
    with pytest.raises(InputError, match=match):
        replace(PI, **change)


@pytest.mark.parametrize(
    ("build", "match"),
    [
        (lambda: replace(CAGE, permeability=0.0), "permeability must be finite and positive, got 0.0"),
        (lambda: replace(CAGE, grading=np.inf), "grading must be a single finite number, got inf"),
        (
            lambda: replace(CAGE, supply_pressure=1.0),
            "supply_pressure must be 0 behind a sealed back, got 1.0",
        ),
        (lambda: RadialFeed(inflow=np.nan), "inflow must be a single finite number"),
        (
            lambda: AxialFeed(start_pressure="a", end_pressure=0.0),
            "start_pressure: quantity must be a number",
        ),
        (lambda: with_springs(PI, 0.0), "stiffness must be finite and positive, got 0.0"),
        (
            lambda: with_springs(4, 1.0),
            "reaction must be a Reaction such as a PorousDamper, got 4",
        ),
        (lambda: damper_groups(PI, mass=0.0, speed=1.0), "mass must be finite and positive"),
        (lambda: damper_groups(PI, mass=1.0, speed=0.0), "reference_speed must be finite and positive"),
        (lambda: PI.force([0.0, np.nan], [0.0, 0.0]), "position must be finite"),
        (lambda: PI.force([0.0, 0.0, 0.0], [0.0, 0.0]), "position must have shape"),
    ],
)
def test_bad_values_are_named(build, match):
    with pytest.raises(InputError, match=match):
        build()


def test_contact_is_named():
    with pytest.raises(FilmContactError, match="inside the clearance"):
        PI.force([1e-4, 0.0], [0.0, 0.0])


def test_springs_act_beside_the_film():
    sprung = with_springs(PI, 2e5)
    assert isinstance(sprung, Reaction)
    q, v = np.array([3e-5, -4e-5]), np.array([0.01, 0.02])
    assert_allclose(sprung.force(q, v), PI.force(q, v) - 2e5 * q, rtol=1e-14)
    spring = np.zeros((2, 5))
    spring[[0, 1], [0, 1]] = -2e5
    assert_allclose(sprung.jacobian(q, v), PI.jacobian(q, v) + spring, rtol=1e-14)
    assert sprung.force(np.zeros((2, 3)), np.ones((2, 3))).shape == (2, 3)


@pytest.mark.closed_form
@pytest.mark.parametrize("share", [0.3, 0.9])
def test_end_pressures_fill_a_centered_film_as_its_closed_pressure_does(share):
    # p = p_e + p_0 (v.u/|v|)(1 - Z^2), p_0 = 3 mu L^2 |v|/(2 c^3), dropped where negative; in SI.
    speed, mu, R, L, c = 0.02, 0.01, 0.05, 0.025, 1e-4
    p0 = 1.5 * mu * L**2 * speed / c**3
    fed = PorousDamper(**DIMENSIONS, feed=AxialFeed(start_pressure=share * p0, end_pressure=share * p0))
    Z, weights = np.polynomial.legendre.leggauss(2000)
    cut = np.minimum(share / (1.0 - Z**2), 1.0)  # pressure vanishes at cos(psi) = -cut
    psi = np.arccos(-cut)
    around = 2.0 * (share * np.sin(psi) + (1.0 - Z**2) * 0.5 * (psi + np.sin(psi) * np.cos(psi)))
    expected = -0.5 * L * R * p0 * (weights @ around)
    assert_allclose(fed.force([0.0, 0.0], [speed, 0.0]), [expected, 0.0], rtol=1e-3, atol=1e-9 * p0)
