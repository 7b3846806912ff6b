"""Films of thrust bearings against closed forms, published numbers, differences and the balance of power."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import rotorfilm as rf
from rotorfilm.bearings import ThrustBearing, TiltingThrustBearing, double_acting
from rotorfilm.core.dynamic_stiffness import small_motion

LENGTH, FAR = 4e-4, 4.0
"""Length of pads that are straight, so far out as they are."""

STILL = np.zeros(3)

TAPER = ThrustBearing(
    inner_radius=0.5, outer_radius=1.0, pads=8, pad_arc=math.radians(40.0), viscosity=1.0, taper_depth=1.0
)
FREE = TiltingThrustBearing(
    inner_radius=0.5, outer_radius=1.0, pads=1, pad_arc=math.radians(45.0), viscosity=1.0
)


def straight(width, cells, **profile):
    """Return a pad of such a width over length, on a slider under a least film of 1, viscosity 1."""
    return ThrustBearing(
        inner_radius=FAR - 0.5 * width * LENGTH,
        outer_radius=FAR + 0.5 * width * LENGTH,
        pads=1,
        pad_arc=LENGTH / FAR,
        viscosity=1.0,
        cells=cells,
        **profile,
    )


def middle_load(pad):
    """Return the load per width in the middle of a wide pad, over speed and length squared."""
    found = pad.pressure(0, [1.0, 0.0, 0.0], STILL, 1.0 / FAR)
    middle = found.pressure[:, len(found.radius) // 2]
    return np.trapezoid(middle, found.angle) * FAR / LENGTH**2


def test_infinite_slider_of_reynolds():
    pad = straight(40.0, (256, 8), taper_depth=1.2, taper_share=1.0)
    assert middle_load(pad) == pytest.approx(0.160239, rel=1e-4)


def test_infinite_step_of_rayleigh():
    pad = straight(40.0, (64, 8), step_depth=0.866, step_share=0.718)
    assert middle_load(pad) == pytest.approx(0.206267, rel=3e-4)


def test_square_slider():
    pad, speed = straight(1.0, (64, 32), taper_depth=1.0, taper_share=1.0), 1.0 / FAR
    force, moment, _ = pad.force([1.0, 0.0, 0.0], STILL, speed)
    power = pad.losses([1.0, 0.0, 0.0], STILL, speed).power_loss
    assert force / LENGTH**3 == pytest.approx(0.069276, rel=2e-3)
    assert moment / force / LENGTH == pytest.approx(0.58199, rel=2e-3)
    assert power / LENGTH**2 == pytest.approx(0.72779, rel=2e-3)


def test_plain_collar_is_a_squeeze_film():
    collar = ThrustBearing(
        inner_radius=0.5,
        outer_radius=1.0,
        pads=1,
        pad_arc=2 * math.pi,
        viscosity=1.0,
        continuous=True,
        cells=(64, 32),
    )
    slopes = collar.jacobian([1.0, 0.0, 0.0], STILL, 1.0)
    C_aa = -slopes[1, 4]
    assert -slopes[0, 3] == pytest.approx(0.593686, rel=1e-5)
    assert C_aa == pytest.approx(0.165670, rel=1e-5)
    # The conical mode is driven at half speed, as the journal in its concentric film.
    assert -slopes[1, 2] == pytest.approx(0.5 * C_aa, rel=1e-9)
    assert collar.force([1.0, 0.0, 0.0], STILL, 1.0) == pytest.approx(STILL, abs=1e-12)


def test_taper_land_ring():
    K_C = TAPER.jacobian([0.3, 0.0, 0.0], STILL, 1.0)
    found = [
        TAPER.force([0.3, 0.0, 0.0], STILL, 1.0)[0],
        -K_C[0, 0],
        -K_C[0, 3],
        -K_C[1, 1],
        -K_C[1, 2],
        -K_C[1, 4],
    ]
    assert found == pytest.approx([0.6732, 3.590, 1.1822, 1.107, 0.1466, 0.3616], rel=5e-3)
    assert TAPER.losses([0.3, 0.0, 0.0], STILL, 1.0).power_loss == pytest.approx(2.890, rel=5e-3)
    # Three pads or more: equal about both axes, and the force is of degree one in rates and speed.
    assert K_C[1, 1] == pytest.approx(K_C[2, 2], rel=1e-12)
    assert K_C[1, 2] == pytest.approx(-K_C[2, 1], rel=1e-12)
    assert K_C[0, 6] == pytest.approx(found[0], rel=1e-12)


def test_step_ring_of_comsol():
    ring = ThrustBearing(
        inner_radius=0.025,
        outer_radius=0.05,
        pads=6,
        pad_arc=math.radians(60.0),
        viscosity=0.072,
        step_depth=200e-6,
        step_share=0.25,
        continuous=True,
        cells=(48, 16),
    )
    at, omega = [100e-6, 0.0, 0.0], 500.0
    slopes = ring.jacobian(at, STILL, omega)
    found = [ring.force(at, STILL, omega)[0], -slopes[0, 0], -slopes[0, 3]]
    found.append(ring.losses(at, STILL, omega).highest_pressure)
    assert found == pytest.approx([575.8, 6.106e6, 1.0090e5, 4.599e5], rel=5e-3)


def test_double_acting_pair_with_end_play():
    pair = double_acting(TAPER, 0.8)
    forces = [pair.force([z, 0.0, 0.0], STILL, 1.0)[0] for z in (0.0, 0.1, 0.2, 0.3)]
    assert forces == pytest.approx([0.0, -0.395, -1.040, -2.81], rel=5e-3, abs=1e-12)
    found = rf.equilibrium(pair, [1.04, 0.0, 0.0], 1.0)
    assert found.position[0] == pytest.approx(0.2, rel=1e-3)
    assert found.minimum_film == pytest.approx(0.2, rel=1e-3)


def test_free_pad_on_a_point_pivot():
    x = FREE.rest_state([1.0, 0.0, 0.0], 1.0)
    force = FREE.output(0.0, x, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    assert force[0] == pytest.approx(0.016307, rel=2e-3)
    assert -force[3] == pytest.approx(0.18870, rel=2e-3)
    fine = replace(FREE, cells=(64, 32)).rest_state([1.0, 0.0, 0.0], 1.0)
    assert fine * FREE.pivot_radius == pytest.approx([-1.0026, -0.0978], rel=2e-3)
    K, C = FREE.held_coefficients([1.0, 0.0, 0.0], 1.0)
    motion = small_motion(FREE, [1.0, 0.0, 0.0], 1.0)
    slow, turning = motion(0j)[0], motion(1j)[0]
    found = [slow[0, 0].real, K[0, 0], C[0, 0], turning[0, 0].imag]
    assert found == pytest.approx([0.032613, 0.050034, 0.032864, 0.040233], rel=2e-3)
    assert slow[0, 0].real == pytest.approx(2.0 * force[0], rel=1e-9)
    ratio = [motion(1j * nu)[0][0, 0].real / slow[0, 0].real for nu in (0.5, 1.0, 1e4)]
    assert ratio == pytest.approx([1.04, 1.13, 1.53], abs=6e-3)


def test_line_pivot_has_one_tilt_and_carries_a_little_less_freely():
    line = replace(FREE, line_pivot=True)
    x = line.rest_state([1.0, 0.0, 0.0], 1.0)
    assert x.shape == (1,)
    F, _, M, _ = line.output(0.0, x, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    # No moment about the radial line, some about the other axis.
    assert abs(-M - line.pivot_radius * F) > 1e-4 * F


@pytest.mark.parametrize(
    "bearing", [TAPER, replace(TAPER, side=-1, gap=0.6), replace(FREE, pads=3, cells=(16, 8))]
)
def test_slopes_are_those_of_the_discrete_film(bearing):
    u = np.array([0.3, 0.05, -0.03, 0.02, 0.03, -0.01, 1.0]) * np.array([bearing.side] * 6 + [1.0])
    x = bearing.rest_state(u[:3], 1.0) * 1.05 if bearing.states else np.zeros(0)
    A, B, C, D = bearing.linearization(0.0, x, u)
    step = 1e-5

    def around(k):
        dx, du = np.zeros(len(x)), np.zeros(7)
        (dx if k < len(x) else du)[k if k < len(x) else k - len(x)] = step
        rate = getattr(bearing, "derivative", lambda *_: np.zeros(0))
        ends = [
            np.append(rate(0.0, x + s * dx, u + s * du), bearing.output(0.0, x + s * dx, u + s * du))
            for s in (1, -1, 2, -2)
        ]
        return (8.0 * (ends[0] - ends[1]) - (ends[2] - ends[3])) / (12.0 * step)

    found = np.stack([around(k) for k in range(len(x) + 7)], axis=1)
    exact = np.block([[A, B], [C, D]])
    assert np.abs(found - exact).max() <= 1e-9 * np.abs(exact).max()
    if not len(x):
        assert D[:3, 3:6] == pytest.approx(D[:3, 3:6].T, abs=1e-13)


def test_power_is_dissipation_and_oil_balances():
    bearing, u = replace(TAPER, extrapolated=False), np.array([0.3, 0.04, -0.02, 0.0, 0.0, 0.0, 1.0])
    none = np.zeros(0)
    answer = bearing.answer(none, u, differentiated=False)
    facts = np.array([bearing.kernel.field(k, none, none, u)[1] for k in range(8)])
    assert facts[:, :2].sum() == pytest.approx(-answer.wrench[3], rel=1e-13)
    flows = bearing.losses([0.3, 0.0, 0.0], STILL, 1.0)
    assert flows.inflow == pytest.approx(flows.outflow + flows.side_flow, rel=1e-12)


def test_mirror_image():
    crowned = replace(TAPER, taper_depth=0.0, crown=0.2, start=-math.radians(20.0))
    one = crowned.force([0.3, 0.05, 0.03], [0.01, 0.02, 0.01], 1.0)
    other = crowned.force([0.3, -0.05, 0.03], [0.01, -0.02, 0.01], -1.0)
    assert other == pytest.approx(one * [1.0, -1.0, 1.0], rel=1e-10)


def test_ruptured_film_keeps_its_slopes():
    # At an opening collar the film ruptures over a part of each pad.
    at, rate = [0.3, 0.02, 0.01], [0.3, 0.0, 0.0]
    assert 0.2 < TAPER.losses(at, rate, 1.0).film_share < 0.99
    slopes = TAPER.jacobian(at, rate, 1.0)
    step = 1e-5
    for k in range(3):
        move = step * np.eye(3)[k]
        change = TAPER.force(at + move, rate, 1.0) - TAPER.force(at - move, rate, 1.0)
        assert change / (2.0 * step) == pytest.approx(slopes[:, k], rel=1e-4, abs=1e-4)


def test_order_of_the_grid():
    coarse, medium, fine = (
        replace(TAPER, cells=(n, n // 4), extrapolated=False).force([0.3, 0.0, 0.0], STILL, 1.0)[0]
        for n in (48, 96, 192)
    )
    assert (coarse - medium) / (medium - fine) == pytest.approx(4.0, rel=0.05)
    best = fine + (fine - medium) / 3.0
    assert replace(TAPER, cells=(96, 24)).force([0.3, 0.0, 0.0], STILL, 1.0)[0] == pytest.approx(
        best, rel=2e-4
    )


def test_tilts_in_time_are_those_of_the_schur_complement():
    pad, nu, swing = replace(FREE, cells=(16, 8)), 0.5, 1e-3

    def input_at(t):
        return [1.0 + swing * math.sin(nu * t), 0.0, 0.0, swing * nu * math.cos(nu * t), 0.0, 0.0, 1.0]

    end = 2.0 * 2.0 * math.pi / nu
    times = np.linspace(0.5 * end, end, 40, endpoint=False)
    x = solve_ivp(
        lambda t, x: pad.derivative(t, x, input_at(t)),
        (0.0, end),
        pad.rest_state([1.0, 0.0, 0.0], 1.0),
        t_eval=times,
        rtol=1e-6,
        atol=1e-9,
    ).y.T
    force = np.array([pad.output(t, one, input_at(t))[0] for t, one in zip(times, x, strict=True)])
    harmonic = 2.0 * np.mean(force * np.exp(-1j * nu * times)) / (-1j * swing)
    assert -harmonic == pytest.approx(small_motion(pad, [1.0, 0.0, 0.0], 1.0)(1j * nu)[0][0, 0], rel=1e-4)


SMALL = TiltingThrustBearing(
    inner_radius=0.025,
    outer_radius=0.05,
    pads=3,
    pad_arc=math.radians(38.0),
    viscosity=0.02,
    gap=3e-5,
    cells=(16, 8),
)


@pytest.mark.parametrize(("arc", "width"), [(0.52, 0.54), (0.6, 0.5), (0.75, 0.54), (0.75, 0.6)])
def test_pads_rest_where_their_pressure_has_no_moment(arc, width):
    """Also with a steep wedge, which a search from small tilts does not find."""
    pads = replace(SMALL, pivot_arc=arc, pivot_width=width)
    tilts = pads.rest_state(STILL, 500.0)
    assert np.abs(pads.derivative(0.0, tilts, [*STILL, *STILL, 500.0])).max() < 1e-6 * 500.0 * 3e-5 / 0.05
    assert tilts[0] < 0.0
    assert pads.output(0.0, tilts, [*STILL, *STILL, 500.0])[0] > 0.0


@pytest.mark.parametrize(("arc", "width"), [(0.505, 0.5), (0.52, 0.52), (0.55, 0.45)])
def test_flat_pads_whose_pressure_cannot_lie_at_the_pivot_have_no_rest(arc, width):
    """No tilt has its center of pressure there: Newton's method finds none from 35 tilts all over."""
    pads = replace(SMALL, pivot_arc=arc, pivot_width=width)
    with pytest.raises(rf.EquilibriumError, match="center of pressure of a flat pad can lie"):
        pads.rest_state(STILL, 500.0)
    turned, film = pads._unit_turned(np.zeros(7)), 3e-5 / 0.05
    for along in np.linspace(-6.0, -0.1, 7):
        for out in np.linspace(-1.5, 1.5, 5):
            assert pads._unit.rest(turned, np.tile([along * film, out * film], 3))[1]


ROSS = TiltingThrustBearing(
    inner_radius=1.150,
    outer_radius=1.725,
    pads=12,
    pad_arc=math.radians(26.0),
    pivot_arc=15.0 / 26.0,
    pivot_width=(1.4425 - 1.150) / 0.575,
    oil=rf.Oil.iso_vg(68),
    cooling=rf.Cooling(supply_temperature=313.15, carry_over=0.0),
    cells=(32, 16),
)
"""The 12 pads of the example of ROSS 3.1, at 90 rpm under 13.32 MN; ROSS holds them in their tilts."""


def test_example_of_ross_with_heat():
    speed = 90.0 * math.pi / 30.0
    found = rf.equilibrium(ROSS, [-13.320e6, 0.0, 0.0], speed)
    film = found.position[0]
    # ROSS has 30.3 K with a viscosity that falls along the pad.
    assert 2.0 * (found.temperature - 313.15) == pytest.approx(29.4, rel=0.02)
    warm = ROSS.at_temperature(found.temperature)
    held, _ = warm.held_coefficients(found.position, speed)
    free = rf.coefficients(warm, found.position, speed, frequency=0.0)
    assert free.stiffness[0, 0] == pytest.approx(2.0 * 13.320e6 / film, rel=1e-6)
    assert 1.50 <= held[0, 0] / free.stiffness[0, 0] <= 1.55
    losses = warm.losses(found.position, STILL, speed)
    rise = losses.power_loss / (losses.inflow * float(ROSS.oil.volumetric_heat(313.15)))
    assert found.temperature == pytest.approx(313.15 + 0.5 * rise, rel=1e-6)


def test_held_pads_have_the_stiffness_of_ross_at_its_film():
    """Its golden figures are of pivots .131 mm apart; its viscosity falls along the pad, ours does not."""
    speed, load = 90.0 * math.pi / 30.0, [-13.320e6, 0.0, 0.0]

    def film(temperature):
        return rf.equilibrium(ROSS.at_temperature(temperature), load, speed).position[0]

    warm = ROSS.at_temperature(brentq(lambda T: film(T) - 0.131e-3, 313.2, 345.0, xtol=1e-3))
    at = rf.equilibrium(warm, load, speed)
    held, damping = warm.held_coefficients(at.position, speed)
    assert held[0, 0] == pytest.approx(3.1763e11, rel=0.03)
    # Finite volumes of another program have 1.62e10; where viscosity falls along the pad 0.98e10.
    assert damping[0, 0] == pytest.approx(1.623e10, rel=0.01)
    assert warm.losses(at.position, STILL, speed).highest_pressure == pytest.approx(6.957e6, rel=0.05)


def test_hot_oil_that_is_carried_over_thins_the_film():
    at, speed = [1e-4, 0.0, 0.0], 9.42
    fresh, carried = (
        replace(ROSS, cooling=rf.Cooling(supply_temperature=313.15, carry_over=share)).balanced_temperature(
            at, STILL, speed
        )
        for share in (0.0, 0.7)
    )
    assert carried > fresh + 5.0


def test_bad_input_names_itself():
    with pytest.raises(rf.InputError, match=r"pivot_arc must not be 0\.5"):
        replace(FREE, pivot_arc=0.5)
    assert replace(FREE, pivot_arc=0.5, crown=0.3).rest_state([1.0, 0.0, 0.0], 1.0).shape == (2,)
    with pytest.raises(rf.InputError, match="inner_radius"):
        replace(TAPER, inner_radius=1.0)
    with pytest.raises(rf.InputError, match="at most a turn"):
        replace(TAPER, pads=10)
    with pytest.raises(rf.InputError, match="side"):
        replace(TAPER, side=0)
    with pytest.raises(rf.FilmContactError, match="least film"):
        TAPER.force([0.3, 0.4, 0.0], STILL, 1.0)
    with pytest.raises(rf.EquilibriumError, match="onto the pads"):
        rf.equilibrium(TAPER, [0.6, 0.0, 0.0], 1.0)
    plane = replace(TAPER, taper_depth=0.0)
    with pytest.raises(rf.UndefinedDerivativeError):
        plane.jacobian([0.3, 0.0, 0.0], STILL, 1.0)
    assert plane.force([0.3, 0.0, 0.0], STILL, 1.0) == pytest.approx(STILL, abs=1e-12)


@pytest.mark.parametrize("film", [1e-5, 1e-4, 1e-3])
@pytest.mark.parametrize("speed", [-300.0, 0.0, 3e3])
def test_any_size_and_speed_gives_numbers(film, speed):
    bearing = ThrustBearing(
        inner_radius=0.025, outer_radius=0.05, pads=6, pad_arc=0.9, viscosity=0.03, taper_depth=film
    )
    at = np.array([[film, 0.1 * film], [3.0 * film, 0.0], [0.0, 0.5 * film]])
    force = bearing.force(at, np.zeros((3, 2)), speed)
    assert force.shape == (3, 2)
    assert np.isfinite(force).all()
    assert (force[0] >= 0.0).all()


@pytest.mark.parametrize(
    ("call", "named"),
    [
        (lambda: TAPER.losses([1.0, 0.0, 0.0], [0.0, 0.0], 1.0), r"velocity must have shape \(3,\)"),
        (lambda: TAPER.pressure(0, [1.0, 0.0, 0.0], [0.0], 1.0), r"velocity must have shape \(3,\)"),
        (lambda: TAPER.pressure(True, [1.0, 0.0, 0.0], STILL, 1.0), "pad must be an integer from 0 to 7"),
        (lambda: TAPER.minimum_film([1.0, 0.0]), r"position must have shape \(3, ...\)"),
        (lambda: TAPER.minimum_film([math.nan, 0.0, 0.0]), "position must be finite"),
        (lambda: FREE.rest_state([1.0, 0.0], 1.0), r"position must have shape \(3,\)"),
        (lambda: FREE.rest_state([1.0, 0.0, 0.0], math.nan), "speed must be a single finite number"),
    ],
)
def test_bad_input_names_the_argument(call, named):
    with pytest.raises(rf.InputError, match=named):
        call()


def test_flat_pads_that_turn_away_from_their_pivots_say_so():
    small = replace(FREE, inner_radius=0.025, outer_radius=0.05, pads=8, pad_arc=math.radians(38.0))
    with pytest.raises(rf.EquilibriumError, match="speed must be positive for flat pads"):
        small.rest_state([3e-5, 0.0, 0.0], -300.0)
    with pytest.warns(rf.ValidityWarning, match="speed must be negative for flat pads"):
        replace(FREE, pivot_arc=0.4).warn_of_flow(1.0)


def test_an_equilibrium_prints_and_tabulates_its_motions_with_their_units():
    pytest.importorskip("pandas")
    at = rf.equilibrium(TAPER, [-0.5, 0.01, 0.0], 1.0)
    assert [row[0].strip() for row in at.to_rows()][:3] == [
        "position z",
        "position tilt x",
        "position tilt y",
    ]
    frame = at.to_dataframe()
    assert frame["load_tilt_x"][0] == 0.01
    units = frame.attrs["units"]
    assert [units[name] for name in ("position_z", "position_tilt_x", "load_z", "load_tilt_x")] == [
        "m",
        "rad",
        "N",
        "N.m",
    ]
    film = rf.coefficients(TAPER, at.position, 1.0).to_dataframe()
    assert film["stiffness_tilt_x_z"][0] == rf.coefficients(TAPER, at.position, 1.0).stiffness[1, 0]
    assert [film.attrs["units"][f"stiffness_{name}"] for name in ("z_z", "z_tilt_x", "tilt_x_z")] == [
        "N/m",
        "N/rad",
        "N",
    ]
    assert at.losses.power_loss == TAPER.losses(at.position, STILL, 1.0).power_loss


def test_round_off_beside_the_diagonal_prints_as_zero():
    at = rf.equilibrium(TAPER, [-0.5, 0.0, 0.0], 1.0)
    rows = dict(row[:2] for row in rf.coefficients(TAPER, at.position, 1.0).to_rows())
    assert float(rows["stiffness z tilt x"].split()[0]) == 0.0
    assert float(rows["stiffness z z"].split()[0]) > 1.0
    assert not [row for row in at.to_rows() if "eccentricity" in row[0]]
