"""Bearings of any freedoms, by springs, by a table, by a function: hand algebra, signals, what is refused."""

import math

import fmpy
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotorfilm import (
    FilmContactError,
    InputError,
    LinearBearing,
    Reaction,
    TabulatedBearing,
    as_reaction,
    export_fmu,
)
from rotorfilm.core.dynamic_stiffness import rest_linearization, small_motion
from rotorfilm.core.port import require_terminals, static_force, static_slopes
from rotorfilm.core.signals import FREEDOMS, force_names, place_names

THRUST = ("z", "tilt_x", "tilt_y")
ALL = tuple(FREEDOMS)

PADS, PAD_STIFFNESS, PAD_DAMPING, RADIUS = 8, 2e7, 3e4, 0.05
"""Equal springs and dashpots along z around a collar: a thrust bearing in closed form."""

ANGLES = 2.0 * math.pi / PADS * np.arange(PADS)
LIFT = np.stack([np.ones(PADS), RADIUS * np.sin(ANGLES), -RADIUS * np.cos(ANGLES)])
"""Rise of the collar over each pad by z, tilt_x, tilt_y: z + (tilt x arm)_z."""

COLLAR = LinearBearing(
    stiffness=(PADS * PAD_STIFFNESS, *(2 * (0.5 * PADS * PAD_STIFFNESS * RADIUS**2,))),
    damping=(PADS * PAD_DAMPING, *(2 * (0.5 * PADS * PAD_DAMPING * RADIUS**2,))),
    freedoms=THRUST,
)


def pads(z, tilt_x, tilt_y, vz, tilt_rate_x, tilt_rate_y, speed):
    """Return the force of pads with a cubic spring, whose third part the speed stiffens."""
    rise, rate = LIFT.T @ (z, tilt_x, tilt_y), LIFT.T @ (vz, tilt_rate_x, tilt_rate_y)
    return -LIFT @ (PAD_STIFFNESS * (rise + (1.0 + 1e-3 * speed) * 1e7 * rise**3) + PAD_DAMPING * rate)


def pad_slopes(place, rate, speed):
    rise = LIFT.T @ place
    stiffness = PAD_STIFFNESS * (1.0 + 3e7 * (1.0 + 1e-3 * speed) * rise**2)
    by_speed = -LIFT @ (PAD_STIFFNESS * 1e4 * rise**3)
    return np.column_stack([-(LIFT * stiffness) @ LIFT.T, -PAD_DAMPING * LIFT @ LIFT.T, by_speed])


OWN = as_reaction(pads, clearance=1e-4, freedoms=THRUST, largest_angle=2e-3)
TABLE = TabulatedBearing(
    speeds=[0.0, 100.0, 300.0],
    stiffness=np.array([1.0, 2.0, 3.0])[:, None, None] * COLLAR.stiffness,
    damping=3 * [COLLAR.damping],
    freedoms=THRUST,
)


@pytest.mark.closed_form
def test_a_collar_on_pads_is_a_thrust_bearing_of_three_springs() -> None:
    place, rate = np.array([1e-5, 2e-4, -1e-4]), np.array([1e-3, -2e-2, 3e-2])
    by_pad = LIFT @ (PAD_STIFFNESS * (LIFT.T @ place) + PAD_DAMPING * (LIFT.T @ rate))
    assert_allclose(COLLAR.force(place, rate, 50.0), -by_pad, rtol=1e-12)
    wanted = np.column_stack([-PAD_STIFFNESS * LIFT @ LIFT.T, -PAD_DAMPING * LIFT @ LIFT.T, np.zeros(3)])
    assert_allclose(COLLAR.jacobian(place, rate, 50.0), wanted, atol=1e-12 * np.abs(wanted).max())
    # A load on one side: z and tilt of the collar by statics.
    load = np.array([-1000.0, 0.0, 1000.0 * RADIUS])
    rest = np.linalg.solve(COLLAR.stiffness, load)
    assert_allclose(COLLAR.force(rest, np.zeros(3), 0.0) + load, 0.0, atol=1e-9)
    assert rest[0] == pytest.approx(-1000.0 / (PADS * PAD_STIFFNESS))
    assert rest[2] == pytest.approx(1000.0 / (0.5 * PADS * PAD_STIFFNESS * RADIUS))


@pytest.mark.closed_form
def test_numbers_diagonals_and_matrices_are_the_same_springs() -> None:
    for freedoms in (("x", "y"), ("x", "y", "z"), ("z",)):
        n = len(freedoms)
        made = [LinearBearing(stiffness=k, freedoms=freedoms) for k in (2e6, (2e6,) * n, 2e6 * np.eye(n))]
        assert made[0] == made[1] == made[2]
    assert LinearBearing(stiffness=2e6) == LinearBearing(stiffness=2e6, freedoms=["x", "y"])
    assert LinearBearing(stiffness=(1e6, 2e6)).stiffness == ((1e6, 0.0), (0.0, 2e6))


@pytest.mark.closed_form
def test_the_whole_matrix_of_six_freedoms_acts() -> None:
    rng = np.random.default_rng(3)
    K, C = rng.standard_normal((2, 6, 6))
    bearing = LinearBearing(stiffness=K, damping=C, freedoms=ALL)
    q, v = rng.standard_normal((2, 6, 4, 3))
    force, slopes = bearing.force(q, v, 1.0), bearing.jacobian(q, v, 1.0)
    assert (force.shape, slopes.shape) == ((6, 4, 3), (6, 13, 4, 3))
    for one in np.ndindex(4, 3):
        at = (slice(None), *one)
        assert_allclose(force[at], -K @ q[at] - C @ v[at], rtol=1e-12)
        assert_array_equal(slopes[:, :, *one], np.hstack([-K, -C, np.zeros((6, 1))]))
    assert_allclose(bearing(q[..., 0], v[:, :1, 0], 1.0)[:, 2], -K @ q[:, 2, 0] - C @ v[:, 0, 0], rtol=1e-12)


@pytest.mark.parametrize("bearing", [COLLAR, TABLE, OWN], ids=lambda one: type(one).__name__)
def test_they_are_reactions_of_the_port(bearing: Reaction) -> None:
    assert isinstance(bearing, Reaction)
    require_terminals("bearing", bearing)
    assert [s.name for s in bearing.inputs] == [*place_names(THRUST), "speed"]
    assert [s.name for s in bearing.outputs] == force_names(THRUST)
    assert [s.unit for s in bearing.inputs] == ["m", "rad", "rad", "m/s", "rad/s", "rad/s", "rad/s"]
    assert [s.unit for s in bearing.outputs] == ["N", "N.m", "N.m"]
    place, rate = np.array([1e-5, 1e-4, -2e-4]), np.array([1e-3, 2e-2, 1e-2])
    u = [*place, *rate, 150.0]
    assert_array_equal(bearing.output(0.0, (), u), static_force(bearing, place, rate, 150.0))
    assert_array_equal(bearing.linearization(0.0, (), u).D, static_slopes(bearing, place, rate, 150.0))
    assert rest_linearization(bearing, place, 150.0).D.shape == (3, 7)
    s = 20j
    slopes = static_slopes(bearing, place, np.zeros(3), 150.0)
    assert_allclose(small_motion(bearing, place, 150.0).stiffness(s), -slopes[:, :3] - s * slopes[:, 3:6])


@pytest.mark.closed_form
def test_nominal_tilts_and_moments_fit_their_stiffness() -> None:
    z, tilt = COLLAR.inputs[0].nominal, COLLAR.inputs[1].nominal
    force, moment = (one.nominal for one in COLLAR.outputs[:2])
    assert force == pytest.approx(COLLAR.stiffness[0][0] * z)
    assert moment == pytest.approx(COLLAR.stiffness[1][1] * tilt)
    assert OWN.inputs[1].nominal == pytest.approx(2e-3)
    assert OWN.outputs[1].nominal == pytest.approx(OWN.outputs[0].nominal * 1e-4 / 2e-3)
    free = LinearBearing(stiffness=0.0, freedoms=THRUST)
    assert all(one.nominal > 0.0 for one in free.outputs)
    twist = LinearBearing(stiffness=[5.0], freedoms=("twist",))
    assert twist.outputs[0].nominal == pytest.approx(5.0 * twist.inputs[0].nominal)


@pytest.mark.closed_form
def test_a_table_has_its_own_matrices_at_its_speeds_and_derivatives_between() -> None:
    place, rate = np.array([1e-5, 1e-4, -2e-4]), np.array([1e-3, 2e-2, 1e-2])
    assert_allclose(TABLE.force(place, rate, 0.0), COLLAR.force(place, rate, 0.0), rtol=1e-12)
    hundred = LinearBearing(
        stiffness=2.0 * np.array(COLLAR.stiffness), damping=COLLAR.damping, freedoms=THRUST
    )
    assert_allclose(TABLE.jacobian(place, rate, 100.0)[:, :6], hundred.jacobian(place, rate, 0.0)[:, :6])
    h = 0.1
    ahead, behind = (TABLE.force(place, rate, 50.0 + k * h) for k in (1.0, -1.0))
    assert_allclose(TABLE.jacobian(place, rate, 50.0)[:, 6], (ahead - behind) / (2.0 * h), rtol=1e-5)
    batch = TABLE.jacobian(place[:, None] * [1.0, 2.0], rate[:, None], [10.0, 290.0])
    assert_allclose(batch[..., 1], TABLE.jacobian(2.0 * place, rate, 290.0), rtol=1e-12)


def test_a_table_goes_through_csv_with_the_names_of_its_freedoms(tmp_path) -> None:
    path = TABLE.to_csv(tmp_path / "thrust.csv")
    heading = path.read_text().splitlines()[0].split(",")
    assert heading[:3] == ["speed [rad/s]", "k_z_z [N/m]", "k_z_tilt_x [N/rad]"]
    assert heading[4:6] == ["k_tilt_x_z [N m/m]", "k_tilt_x_tilt_x [N m/rad]"]
    assert heading[-1] == "c_tilt_y_tilt_y [N m s/rad]"
    again = TabulatedBearing.from_csv(path)
    assert again.freedoms == THRUST
    assert_allclose(again.stiffness, TABLE.stiffness, rtol=1e-8)
    assert_allclose(again.damping, TABLE.damping, rtol=1e-8)
    path.write_text(path.read_text().replace("k_z_tilt_x", "k_z_twist", 1))
    with pytest.raises(InputError, match="must have a column 'k_z_tilt_x'"):
        TabulatedBearing.from_csv(path)


@pytest.mark.closed_form
def test_differences_of_a_function_are_its_derivatives_for_any_freedoms() -> None:
    rng = np.random.default_rng(1)
    place = OWN.scales[:, None] * rng.uniform(-0.8, 0.8, (3, 40))
    rate, speed = 100.0 * OWN.scales[:, None] * rng.standard_normal((3, 40)), rng.uniform(-300.0, 300.0, 40)
    found, estimate = OWN.jacobian(place, rate, speed), OWN.jacobian_error(place, rate, speed)
    size = np.array([1.0, 20.0, 20.0])  # tilts count as ways at the arm clearance/largest_angle, 1/20 m
    weights = np.concatenate([size, size, [1.0]])
    for k in range(40):
        exact = pad_slopes(place[:, k], rate[:, k], speed[k])
        off = np.abs(found[..., k] - exact)
        scaled = np.abs(exact) * size[:, None] * weights
        for columns in (slice(3), slice(3, 6), slice(6, 7)):
            assert (off * size[:, None] * weights)[:, columns].max() < 1e-9 * scaled[:, columns].max()
        assert np.all(off <= 20.0 * estimate[..., k])
    given = as_reaction(
        pads, clearance=1e-4, freedoms=THRUST, jacobian=lambda *u: pad_slopes(np.array(u[:3]), u[3:6], u[6])
    )
    assert_array_equal(
        given.jacobian(place, rate, speed)[..., 5], pad_slopes(place[:, 5], rate[:, 5], speed[5])
    )
    assert given.prepare()(*place[:, 0], *rate[:, 0], 7.0) == tuple(given(place[:, 0], rate[:, 0], 7.0))


def test_x_and_y_alone_are_held_within_the_clearance() -> None:
    def springs(*state: float) -> tuple[float, ...]:
        return tuple(-1e6 * one for one in state[:4])

    own = as_reaction(springs, clearance=1e-4, freedoms=("x", "y", "z", "tilt_x"))
    still = np.zeros(4)
    assert_allclose(own.force([0.0, 0.0, 3e-4, 0.1], still, 1.0), [0.0, 0.0, -300.0, -1e5])
    for call in (lambda q: own.force(q, still, 1.0), lambda q: own.prepare()(*q, *still, 1.0)):
        with pytest.raises(FilmContactError, match=r"inside the clearance 0\.0001 m, got .* of 0\.00015 m"):
            call([9e-5, 12e-5, 0.0, 0.0])


OWN_MODULE = '''
def collar(z, tilt_x, vz, tilt_rate_x, speed):
    """Return force and moment of a spring off the axis."""
    return -1e7 * z - 1e5 * tilt_x - 10.0 * vz, -1e5 * z - 2e3 * tilt_x
'''


def test_an_fmu_carries_a_function_of_other_freedoms(write_module, tmp_path) -> None:
    module = write_module("own_collar_module", OWN_MODULE)
    own = as_reaction(module.collar, clearance=1e-4, freedoms=("z", "tilt_x"))
    path = export_fmu(own, tmp_path / "own.fmu", start={"z": 2e-5, "tilt_x": -3e-4, "vz": 1e-3})
    last = fmpy.simulate_fmu(str(path), stop_time=1e-3)[-1]
    force = own(position=(2e-5, -3e-4), velocity=(1e-3, 0.0), speed=0.0)
    assert_array_equal([last["collar.force_z"], last["collar.moment_x"]], force)


@pytest.mark.parametrize("freedoms", [("tilt_x", "z"), ("z", "z"), (), ("z", "roll"), "force_z", ("y", "x")])
def test_freedoms_out_of_order_are_refused(freedoms) -> None:
    one = np.ones((1, max(len(freedoms), 1), max(len(freedoms), 1)))
    for make in (
        lambda: LinearBearing(stiffness=1e6, freedoms=freedoms),
        lambda: TabulatedBearing(speeds=[1.0], stiffness=one, damping=one, freedoms=freedoms),
        lambda: as_reaction(lambda *u: u[:2], clearance=1e-4, freedoms=freedoms),
    ):
        with pytest.raises(
            InputError, match=r"freedoms must be some of \['x', 'y', 'z', .*'twist'\], in this"
        ):
            make()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            {"stiffness": 1e6},
            r"stiffness must be 3 x 3 numbers, or the 3 numbers of its diagonal, for z, tilt_x, tilt_y, got",
        ),
        ({"stiffness": (1.0, 2.0)}, "stiffness must be 3 x 3 numbers"),
        ({"stiffness": np.eye(2)}, "stiffness must be 3 x 3 numbers"),
        ({"stiffness": (1.0, 2.0, math.nan)}, "stiffness must be finite"),
        ({"damping": 5.0}, "damping must be 3 x 3 numbers"),
        ({"stiffness": "much"}, "stiffness"),
        ({"freedoms": 3}, "freedoms must be a tuple"),
    ],
)
def test_springs_of_another_shape_are_refused(given, message) -> None:
    with pytest.raises(InputError, match=message):
        LinearBearing(**{"stiffness": (1.0, 2.0, 3.0), "freedoms": THRUST, **given})


def test_a_table_of_another_shape_is_refused() -> None:
    two = np.zeros((3, 2, 2))
    with pytest.raises(InputError, match=r"stiffness must have shape \(3, 3, 3\), got \(3, 2, 2\)"):
        TabulatedBearing(speeds=TABLE.speeds, stiffness=two, damping=two, freedoms=THRUST)
    with pytest.raises(InputError, match=r"stiffness must have shape \(3, 2, 2\), got \(3, 3, 3\)"):
        TabulatedBearing(speeds=TABLE.speeds, stiffness=TABLE.stiffness, damping=two)


@pytest.mark.parametrize("bearing", [COLLAR, TABLE, OWN], ids=lambda one: type(one).__name__)
def test_states_of_another_shape_are_refused(bearing) -> None:
    for call in (bearing.force, bearing.jacobian):
        with pytest.raises(InputError, match=r"position must have shape \(3, \.\.\.\), got shape \(2,\)"):
            call([0.0, 0.0], [0.0, 0.0, 0.0], 1.0)
        with pytest.raises(InputError, match=r"velocity must have shape \(3, \.\.\.\), got shape \(5,\)"):
            call(np.zeros(3), np.zeros(5), 1.0)
        with pytest.raises(
            InputError, match=r"position \(3, \.\.\.\), velocity \(3, \.\.\.\) and .* broadcast"
        ):
            call(np.zeros((3, 2)), np.zeros((3, 4)), 1.0)
        with pytest.raises(InputError, match="position must be finite"):
            call([0.0, math.nan, 0.0], np.zeros(3), 1.0)
    wanted = r"u must have shape \(7,\) for z, tilt_x, tilt_y, vz, tilt_rate_x, tilt_rate_y, speed, got shape"
    for asked in (bearing.output, bearing.linearization):
        with pytest.raises(InputError, match=wanted):
            asked(0.0, (), np.zeros(5))


@pytest.mark.parametrize(
    ("law", "message"),
    [
        (lambda x, y, vx, vy, speed: (x, y), r"function of \(z, vz, speed\), got one of \(x, y, vx"),
        (lambda *u: (1.0, 2.0, 3.0), r"force of 'own_bearing' must return finite numbers of shape \(1,\)"),
        (lambda *u: 1.0, r"force of 'own_bearing' must return finite numbers of shape \(1,\)"),
    ],
)
def test_functions_that_do_not_fit_the_freedoms_are_refused(law, message) -> None:
    with pytest.raises(InputError, match=message):
        as_reaction(law, clearance=1e-4, freedoms=("z",))
    with pytest.raises(InputError, match="largest_angle must be finite and positive"):
        as_reaction(lambda *u: (0.0,), clearance=1e-4, freedoms=("tilt_x",), largest_angle=0.0)
