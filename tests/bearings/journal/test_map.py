"""The map as a film law and in a bearing: derivatives, symmetries, damping, range, equal answers."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from rotorfilm import FilmContactError, InputError, UndefinedDerivativeError, ValidityWarning
from rotorfilm.analysis import coefficients
from rotorfilm.bearings import FilmLaw, FilmOptions, options, tabulate_film
from rotorfilm.bearings.journal import JournalBearing, MapFilm, ShortFilm, SplittingFilm
from rotorfilm.native import JournalKernel

DIMENSIONS = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
FILM = MapFilm(
    tabulate_film(
        ShortFilm(), slenderness_range=(0.1, 1.0), cells=(32, 64, 5), largest_eccentricity_ratio=0.999
    )
)
bearing = JournalBearing(**DIMENSIONS, film=FILM)
short = JournalBearing(**DIMENSIONS, film=ShortFilm())


def random_states(count, lowest=0.0, highest=0.95):
    rng = np.random.default_rng(12)
    chi, phi = rng.uniform(lowest, highest, count), rng.uniform(-np.pi, np.pi, count)
    return chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


def si_states(count):
    e, w = random_states(count)
    return 1e-4 * e, 1e-2 * w, np.random.default_rng(2).normal(size=count) * 200.0


def test_is_a_film_law_that_binds():
    assert isinstance(FILM, FilmLaw)
    dimensions = {"slenderness": 0.5, "clearance": 1e-4, "force_scale": 1.0}
    assert FILM.bind(**dimensions) is not None
    assert options(SplittingFilm(), FilmOptions).bind(**dimensions) is None


@pytest.mark.closed_form
@pytest.mark.parametrize(
    ("lowest", "highest", "error"), [(0.0, 0.95, 1e-6), (0.95, 0.99, 1e-5), (0.99, 0.999, 5e-3)]
)
def test_map_of_the_short_film_is_the_short_film(lowest, highest, error):
    e, w = random_states(2000, lowest, highest)
    exact = ShortFilm().force(e, w, 0.4)
    difference = np.linalg.norm(FILM.force(e, w, 0.4) - exact, axis=0) / np.linalg.norm(exact, axis=0)
    assert np.quantile(difference, 0.99) < error


@pytest.mark.closed_form
def test_jacobian_of_the_short_film():
    e, w = random_states(500)
    exact = ShortFilm().jacobian(e, w, 0.4)
    scale = np.abs(exact).max(axis=(0, 1))
    np.testing.assert_allclose(FILM.jacobian(e, w, 0.4) / scale, exact / scale, atol=5e-5)


@pytest.mark.closed_form
@pytest.mark.parametrize("chi", [0.0, 1e-12, 1e-8, 1e-5])
def test_jacobian_of_the_short_film_at_the_center(chi):
    e, w = chi * np.array([0.6, -0.8]), np.array([0.3, 0.7])
    exact = ShortFilm().jacobian(e, w, 0.4)
    np.testing.assert_allclose(FILM.jacobian(e, w, 0.4), exact, atol=1e-6)


@settings(deadline=None, max_examples=60)
@given(
    chi=st.floats(0.0, 0.999),
    phi=st.floats(-3.1, 3.1),
    turn=st.floats(-3.1, 3.1),
    slenderness=st.floats(0.1, 1.0),
)
def test_damping_is_symmetric_and_semidefinite(chi, phi, turn, slenderness):
    e, w = chi * np.array([np.cos(phi), np.sin(phi)]), np.array([np.cos(turn), np.sin(turn)])
    damping = -FILM.jacobian(e, w, slenderness)[:, 2:]
    size = np.abs(damping).max()
    assert abs(damping[0, 1] - damping[1, 0]) <= 1e-12 * size
    assert np.linalg.eigvalsh(damping)[0] >= -1e-6 * size
    # Degree one: the derivative along the source is the force itself.
    np.testing.assert_allclose(-damping @ w, FILM.force(e, w, slenderness), atol=1e-12 * size)


@settings(deadline=None, max_examples=30)
@given(x=st.floats(-0.6, 0.6), y=st.floats(-0.6, 0.6), vx=st.floats(-1, 1), vy=st.floats(-1, 1))
def test_mirrored_bearing_turns_the_other_way(x, y, vx, vy):
    c = bearing.clearance
    force = bearing.force([x * c, y * c], [vx * c, vy * c], 100.0)
    mirrored = bearing.force([x * c, -y * c], [vx * c, -vy * c], -100.0)
    np.testing.assert_allclose(mirrored, force * [1, -1], atol=1e-13 * np.linalg.norm(force))


def test_bound_film_equals_law_and_kinematics():
    q, v, omega = si_states(50)
    e = q / 1e-4
    w = v / 1e-4 + 0.5 * omega * np.stack([e[1], -e[0]])
    np.testing.assert_allclose(
        bearing.force(q, v, omega), bearing.force_scale * FILM.force(e, w, bearing.slenderness), rtol=1e-10
    )


def test_bearing_jacobian_equals_that_of_the_short_film():
    q, v, omega = si_states(200)
    exact = short.jacobian(q, v, omega)
    scale = np.abs(exact).max(axis=0)
    np.testing.assert_allclose(bearing.jacobian(q, v, omega) / scale, exact / scale, atol=5e-5)


@pytest.mark.parametrize("model", [bearing, short], ids=["map", "short"])
def test_prepared_call_equals_the_validated_one(model):
    call = model.prepare()
    q, v, omega = si_states(5)
    for i in range(5):
        force = call(*q[:, i].tolist(), *v[:, i].tolist(), float(omega[i]))
        assert all(type(component) is float for component in force)
        np.testing.assert_array_equal(force, model.force(q[:, i], v[:, i], omega[i]))
        np.testing.assert_allclose(force, model.force(q, v, omega)[:, i], rtol=1e-12)
    with pytest.raises(
        FilmContactError, match=r"inside the clearance 0.0001 m, got an eccentricity of 0.00011"
    ):
        call(1.1e-4, 0.0, 0.0, 0.0, 1.0)
    with pytest.raises(InputError, match="must be finite"):
        call(np.nan, 0.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize("model", [bearing, short], ids=["map", "short"])
def test_prepared_tangent_is_force_and_jacobian(model):
    tangent = model.prepare_tangent()
    q, v, omega = si_states(5)
    for i in range(5):
        *force, derivatives = tangent(*q[:, i].tolist(), *v[:, i].tolist(), float(omega[i]))
        np.testing.assert_array_equal(force, model.force(q[:, i], v[:, i], omega[i]))
        np.testing.assert_array_equal(derivatives, model.jacobian(q[:, i], v[:, i], omega[i]).ravel())
    with pytest.raises(FilmContactError, match=r"inside the clearance 0.0001 m"):
        tangent(1.1e-4, 0.0, 0.0, 0.0, 1.0)
    with pytest.raises(UndefinedDerivativeError, match=r"w = 0"):
        tangent(5e-5, 0.0, 0.0, 0.0, 0.0)


def test_scalar_jacobian_equals_that_of_the_batch():
    q, v, omega = si_states(5)
    batch = bearing.jacobian(q, v, omega)
    np.testing.assert_array_equal(bearing.jacobian(q[:, 2], v[:, 2], omega[2]), batch[:, :, 2])
    assert bearing.jacobian(q[:, :, None], v[:, :, None], omega[:3]).shape == (2, 5, 5, 3)


def test_contact_names_the_farthest_state():
    with pytest.raises(FilmContactError, match=r"got an eccentricity of 0.00013"):
        bearing.force([[0.0, 1.1e-4, 1.3e-4], [0.0, 0.0, 0.0]], np.zeros((2, 3)), 100.0)


def test_no_damping_at_rest_nor_in_exact_half_speed_whirl():
    q, omega = np.array([3e-5, 4e-5]), 123.4
    for velocity, speed in (([0.0, 0.0], 0.0), (0.5 * omega * np.array([-q[1], q[0]]), omega)):
        np.testing.assert_array_equal(bearing.force(q, velocity, speed), 0.0)
        with pytest.raises(UndefinedDerivativeError, match=r"w = 0 at eccentricity ratio 0\.5"):
            bearing.jacobian(q, velocity, speed)
    assert np.isfinite(bearing.jacobian([0.0, 0.0], [0.0, 0.0], 0.0)).all()


def test_beyond_the_table_is_continued_with_a_warning():
    near, far = np.array([0.998e-4, 0.0]), np.array([0.9999e-4, 0.0])
    with pytest.warns(ValidityWarning, match=r"eccentricity ratio 0\.9999 is beyond the map"):
        force = bearing.force(far, [1e-3, 0.0], 0.0)
    # The squeeze force of a short film goes with gap^-2.5; the power law keeps it within a third.
    exact = short.force(far, [1e-3, 0.0], 0.0)
    assert force[0] / exact[0] == pytest.approx(1.0, abs=0.35)
    assert abs(force[0]) > 10 * abs(bearing.force(near, [1e-3, 0.0], 0.0)[0])
    with pytest.warns(ValidityWarning):
        damping = -bearing.jacobian(far, [1e-3, 2e-4], 100.0)[:, 2:4]
    assert np.linalg.eigvalsh(damping)[0] > 0.0


def test_slenderness_outside_the_table_is_an_input_error():
    with pytest.raises(InputError, match=r"length / diameter must be 0.1 to 1 for MapFilm, got 2"):
        JournalBearing(**{**DIMENSIONS, "length": 0.2}, film=FILM)
    with pytest.raises(InputError, match="length/diameter must be within the table"):
        FILM.force(np.zeros(2), np.ones(2), 2.0)


@pytest.mark.parametrize("twin", [copy.deepcopy, lambda b: pickle.loads(pickle.dumps(b))])
def test_bearings_copy_and_pickle_after_use(twin):
    force = bearing.force([1e-5, 0.0], [0.0, 0.0], 100.0)
    np.testing.assert_array_equal(twin(bearing).force([1e-5, 0.0], [0.0, 0.0], 100.0), force)
    assert twin(bearing) == bearing


@pytest.mark.parametrize(
    "ask",
    [
        lambda far: bearing.force(far, [1e-3, 0.0], 0.0),
        lambda far: bearing.jacobian(far[:, None], [[1e-3], [0.0]], [0.0]),
        lambda far: bearing.prepare()(*far.tolist(), 1e-3, 0.0, 0.0),
        lambda far: bearing.prepare_tangent()(*far.tolist(), 1e-3, 0.0, 0.0),
        lambda far: FILM.force(far / 1e-4, np.array([1.0, 0.0]), 0.3),
        lambda far: coefficients(bearing, far, 100.0),
    ],
)
def test_warning_points_at_the_line_that_asks(ask):
    with pytest.warns(ValidityWarning, match="beyond the map") as caught:
        ask(np.array([0.9999e-4, 0.0]))
    line = ask.__code__.co_firstlineno
    assert {(entry.filename, entry.lineno) for entry in caught} == {(__file__, line)}


def test_message_has_the_values_at_fault():
    with pytest.raises(InputError, match=r"got \(1e-05, 0\.0\) m, \(nan, 0\.0\) m/s and 5\.0 rad/s"):
        bearing.prepare()(1e-5, 0.0, np.nan, 0.0, 5.0)
    states = np.zeros((2, 3)), np.array([[0.0, 0.0, 0.0], [0.0, 0.0, np.inf]]), np.array([1.0, 2.0, 3.0])
    with pytest.raises(InputError, match=r"got \(0\.0, 0\.0\) m, \(0\.0, inf\) m/s and 3\.0 rad/s"):
        bearing.prepared_force(*states)
    with pytest.raises(FilmContactError, match=r"eccentricity ratio must be below 1, got 1\.1"):
        FILM.force(np.array([0.0, 1.1]), np.array([1.0, 0.0]), 0.3)
    with pytest.raises(
        InputError, match=r"eccentricity and source must .* got \[0\.5, 0\.0\] and \[nan, 0\.0\] 1/s"
    ):
        FILM.jacobian(np.array([0.5, 0.0]), np.array([np.nan, 0.0]), 0.3)
    with pytest.raises(ValueError, match=r"velocity must have the shape of position, \(2, 3\), got \(2, 2\)"):
        JournalKernel(FILM._kernel(0.3), 1e-4, 1.0).force(np.zeros((2, 3)), np.zeros((2, 2)), np.zeros(3))


@pytest.mark.parametrize("table", [3, ShortFilm(), "map.bin"])
def test_what_is_no_table_is_refused(table):
    with pytest.raises(InputError, match="table must be a MapTable, got"):
        MapFilm(table)
