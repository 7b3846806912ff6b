"""Journal bearing in SI: scaling, exact derivatives, validation, and the model protocols."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import FilmContactError, InputError, Model, Reaction, UndefinedDerivativeError, ValidityWarning
from rotorfilm.bearings.journal import (
    JournalBearing,
    MapFilm,
    RotatingArc,
    ShortFilm,
    SpectralArcFilm,
    SplittingFilm,
)

DIMENSIONS = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
bearing = JournalBearing(**DIMENSIONS)


def states(count, c=1e-4):
    rng = np.random.default_rng(11)
    q, v = rng.uniform(-0.6, 0.6, (2, count)) * c, rng.normal(size=(2, count)) * 100.0 * c
    return q, v, rng.normal(size=count) * 200.0


def test_film_is_the_map_unless_another_is_named():
    q, v, omega = states(7)
    assert bearing.film == MapFilm()
    expected = bearing.force_scale * MapFilm().force(*bearing.kinematics(q, v, omega), bearing.slenderness)
    np.testing.assert_allclose(bearing.force(q, v, omega), expected, rtol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [157.0, -157.0])
def test_static_force_in_newtons(speed):
    # Ocvirk: F_t = mu omega b^3 R pi e/(4 c^2 (1 - e^2)^1.5), F_r = -mu omega b^3 R e^2/(c^2 (1 - e^2)^2).
    mu, b, R, c = 0.1, 0.03, 0.05, 1e-4
    e = 0.4
    bearing = JournalBearing(**DIMENSIONS, film=ShortFilm())
    force = bearing.force([0.0, -e * c], [0.0, 0.0], speed)
    radial = mu * abs(speed) * b**3 * R / c**2 * e**2 / (1 - e**2) ** 2
    tangential = np.pi * mu * speed * b**3 * R / (4 * c**2) * e / (1 - e**2) ** 1.5
    # At the bottom of the bearing, outward is -y and +90 degrees from it is +x.
    np.testing.assert_allclose(force, [tangential, radial], rtol=1e-12)


@pytest.mark.parametrize("clearance", [1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize(
    "film", [ShortFilm(), SplittingFilm(order=(2, None)), SplittingFilm(order=(4, 2), rupture=RotatingArc())]
)
def test_jacobian_equals_scaled_differences(film, clearance):
    bearing = JournalBearing(radius=0.05, length=0.03, clearance=clearance, viscosity=0.1, film=film)
    q, v, omega = states(20, clearance)
    jacobian = bearing.jacobian(q, v, omega)
    z = np.concatenate([q, v, omega[None]])
    for column, nominal in enumerate(s.nominal for s in bearing.inputs):
        d = np.zeros((5, 1))
        d[column] = 1e-4 * nominal
        near = bearing.force(*split(z + d)) - bearing.force(*split(z - d))
        far = bearing.force(*split(z + 2 * d)) - bearing.force(*split(z - 2 * d))
        difference = (8.0 * near - far) / (12.0 * d[column])
        scale = np.abs(jacobian[:, column]).max(axis=0) + 1e-6 * np.abs(jacobian[:, column]).max()
        np.testing.assert_allclose(jacobian[:, column] / scale, difference / scale, atol=3e-6)


def split(z):
    return z[:2], z[2:4], z[4]


@pytest.mark.parametrize("film", [ShortFilm(), SplittingFilm(order=(2, 1)), SplittingFilm(order=(1, 1))])
@settings(deadline=None, max_examples=30)
@given(x=st.floats(-0.6, 0.6), y=st.floats(-0.6, 0.6), vx=st.floats(-1, 1), vy=st.floats(-1, 1))
def test_mirrored_bearing_turns_the_other_way(film, x, y, vx, vy):
    bearing = JournalBearing(**DIMENSIONS, film=film)
    c = bearing.clearance
    force = bearing.force([x * c, y * c], [vx * c * 50, vy * c * 50], 100.0)
    mirrored = bearing.force([x * c, -y * c], [vx * c * 50, -vy * c * 50], -100.0)
    np.testing.assert_allclose(mirrored, force * [1, -1], atol=1e-8 * (np.linalg.norm(force) + 1.0))


def test_prepared_calls_equal_the_validated_ones():
    q, v, omega = states(5)
    np.testing.assert_array_equal(bearing.prepared_force(q, v, omega), bearing.force(q, v, omega))
    np.testing.assert_array_equal(bearing.prepared_jacobian(q, v, omega), bearing.jacobian(q, v, omega))


def test_broadcasts_over_trailing_axes():
    q, v, _ = states(6)
    force = bearing.force(q[:, :, None], v[:, :, None], np.array([10.0, 20.0, 30.0]))
    assert force.shape == (2, 6, 3)
    np.testing.assert_allclose(force[:, 2, 1], bearing.force(q[:, 2], v[:, 2], 20.0), rtol=1e-12)
    assert bearing.jacobian(q, v, 10.0).shape == (2, 5, 6)


def test_is_a_reaction_and_a_static_model():
    assert isinstance(bearing, Model)
    assert isinstance(bearing, Reaction)
    assert [s.name for s in bearing.inputs] == ["x", "y", "vx", "vy", "speed"]
    assert [s.name for s in bearing.outputs] == ["force_x", "force_y"]
    u = np.array([1e-5, -2e-5, 1e-4, 0.0, 100.0])
    np.testing.assert_array_equal(bearing.output(0.0, [], u), bearing.force(u[:2], u[2:4], u[4]))
    matrices = bearing.linearization(0.0, [], u)
    assert [m.shape for m in matrices] == [(0, 0), (0, 5), (2, 0), (2, 5)]
    np.testing.assert_array_equal(matrices.D, bearing.jacobian(u[:2], u[2:4], u[4]))


@pytest.mark.parametrize("name", list(DIMENSIONS))
@pytest.mark.parametrize("value", [-5e-5, 0.0, np.nan, np.inf, True])
def test_bad_dimension_is_refused(name, value):
    with pytest.raises(InputError, match=f"{name} must be finite and positive, got"):
        JournalBearing(**{**DIMENSIONS, name: value})


@pytest.mark.parametrize("name", list(DIMENSIONS))
def test_a_dimension_as_a_text_without_its_unit_is_refused(name):
    with pytest.raises(InputError, match=rf"{name} must have its unit, as '-1 .+', got '-1'"):
        JournalBearing(**{**DIMENSIONS, name: "-1"})


@pytest.mark.parametrize("clearance", [0.1e-6, 2e-3])
def test_clearance_that_no_bearing_has_is_warned_of(clearance):
    with pytest.warns(
        ValidityWarning, match=r"clearance / radius should be 1e-05 to 0\.02, got .*check units"
    ):
        JournalBearing(**{**DIMENSIONS, "clearance": clearance})


@pytest.mark.parametrize("clearance", [0.5e-6, 1e-3])
def test_clearance_at_the_end_of_the_range_is_taken(clearance):
    assert JournalBearing(**{**DIMENSIONS, "clearance": clearance}).clearance == clearance


def test_clearance_above_the_radius_is_refused():
    with pytest.raises(InputError, match=r"clearance must be below the radius 0.05, got 0.1"):
        JournalBearing(**{**DIMENSIONS, "clearance": 0.1})


@pytest.mark.parametrize("film", ["short", ShortFilm])
def test_film_must_be_a_law(film):
    with pytest.raises(InputError, match="film must be a film law"):
        JournalBearing(**DIMENSIONS, film=film)


def test_short_film_in_a_long_bearing_is_warned_about():
    with pytest.warns(
        ValidityWarning, match=r"length / diameter must not exceed 0.5 for ShortFilm\(\), got 0.6"
    ):
        JournalBearing(**{**DIMENSIONS, "length": 0.06}, film=ShortFilm())


@pytest.mark.closed_form
@pytest.mark.parametrize(("slenderness", "median", "high"), [(0.25, 0.06, 0.28), (0.5, 0.23, 0.97)])
def test_short_film_is_off_by_what_its_docstring_says(slenderness, median, high):
    rng = np.random.default_rng(5)
    chi, n = rng.uniform(0.05, 0.95, 300), 300
    e = np.stack([chi, np.zeros(n)])
    w = np.stack([rng.uniform(-0.5, 0.5, n), chi * rng.uniform(-1.0, 1.0, n)])
    exact = SpectralArcFilm(degree=16, rupture=RotatingArc()).force(e, w, slenderness)
    error = np.linalg.norm(ShortFilm().force(e, w, slenderness) - exact, axis=0) / np.linalg.norm(
        exact, axis=0
    )
    np.testing.assert_allclose(np.quantile(error, [0.5, 0.9]), [median, high], rtol=0.25)


@pytest.mark.parametrize("call", [bearing.force, bearing.jacobian])
def test_contact_is_an_error_with_the_values(call):
    with pytest.raises(
        FilmContactError, match=r"inside the clearance 0.0001 m, got an eccentricity of 0.00011"
    ):
        call([[0.0, 1.1e-4], [0.0, 0.0]], [0.0, 0.0], 100.0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([np.nan, 0.0], [0.0, 0.0], 1.0), "position must be finite"),
        (([0.0, 0.0], [np.inf, 0.0], 1.0), "velocity must be finite"),
        (([0.0, 0.0], [0.0, 0.0], np.nan), "speed must be finite"),
        (([0.0, 0.0, 0.0], [0.0, 0.0], 1.0), r"position must have shape \(2, ...\), got shape \(3,\)"),
        ((np.zeros((2, 3)), np.zeros((2, 4)), 1.0), "must broadcast"),
        ((["a", 0.0], [0.0, 0.0], 1.0), "position must be numeric"),
    ],
)
def test_bad_state_is_refused(arguments, message):
    with pytest.raises(InputError, match=message):
        bearing.force(*arguments)


def test_bad_input_vector_is_refused():
    with pytest.raises(InputError, match=r"u must have shape \(5,\)"):
        bearing.output(0.0, [], np.zeros(4))


def test_no_damping_at_rest_nor_in_exact_half_speed_whirl():
    q, omega = np.array([3e-5, 4e-5]), 123.4
    for velocity, speed in (([0.0, 0.0], 0.0), (0.5 * omega * np.array([-q[1], q[0]]), omega)):
        np.testing.assert_array_equal(bearing.force(q, velocity, speed), 0.0)
        with pytest.raises(UndefinedDerivativeError):
            bearing.jacobian(q, velocity, speed)


@pytest.mark.closed_form
@pytest.mark.parametrize(
    "film",
    [
        ShortFilm(),
        SplittingFilm(order=(1, 1)),
        SplittingFilm(order=(2, None)),
        SplittingFilm(order=(4, 2), rupture=RotatingArc()),
        SpectralArcFilm(degree=24),
    ],
)
def test_stiffness_at_the_exact_center_is_the_limit_of_the_force(film):
    # F is linear in the position near the center: K = -F/q, column by column.
    bearing, q = JournalBearing(**DIMENSIONS, film=film), 1e-10
    jacobian = bearing.jacobian([0.0, 0.0], [0.0, 0.0], 100.0)
    force = bearing.force(q * np.eye(2), np.zeros((2, 2)), 100.0)
    np.testing.assert_allclose(jacobian[:, :2], force / q, atol=1e-5 * np.abs(force / q).max())


def test_native_parameters_say_how_far_they_may_change():
    spec = JournalBearing(**DIMENSIONS).native()
    said = {parameter.name: parameter.description for parameter in spec.parameters}
    assert said["radius"] == "bearing radius; length / diameter must stay from 0.1 to 4"
    assert said["length"] == "axial length; length / diameter must stay from 0.1 to 4"
    assert said["clearance"] == "radial clearance"
