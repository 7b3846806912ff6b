"""Power loss, torques and oil flow: identities, closed forms, published friction, two independent films."""

import dataclasses
import math

import numpy as np
import pytest
from map_nodes import fit_loss_table, node_losses
from scipy.integrate import quad

from rotorfilm import FilmContactError, FullFilm, Groove, InputError, Pad, RotorfilmError
from rotorfilm.analysis import equilibrium
from rotorfilm.bearings import FilmGeometry, gap_shear
from rotorfilm.bearings.journal import (
    ExtrapolatedFilm,
    JournalBearing,
    MapFilm,
    ReynoldsFilm,
    ShortFilm,
    SplittingFilm,
)
from rotorfilm.bearings.journal.map_film import LossTable, packaged_losses, packaged_table

R, c, mu, omega = 0.05, 1e-4, 0.02, 100.0
PLAIN = JournalBearing(radius=R, length=2.0 * R, clearance=c, viscosity=mu)
TWO = tuple(Groove(center=s * np.pi / 2, width=np.radians(20.0)) for s in (1, -1))
REST = np.zeros(2)


def states(count, top, seed=1):
    """Return random eccentricities and sources (2, n) in all directions."""
    rng = np.random.default_rng(seed)
    chi, angle, turn = rng.uniform(0.0, [[top], [2 * np.pi], [2 * np.pi]], (3, count))
    size = rng.lognormal(size=count)
    e = chi * np.array([np.cos(angle), np.sin(angle)])
    return e, size * np.array([np.cos(angle + turn), np.sin(angle + turn)])


def of(found):
    return np.array([found.shear_film, found.shear_streamers, found.side_flow])


@pytest.mark.closed_form
@pytest.mark.parametrize("film", [MapFilm(), ShortFilm(), ReynoldsFilm()])
def test_torques_differ_by_the_moment_of_the_force(film):
    b = dataclasses.replace(PLAIN, length=0.04, film=film)
    q, v = np.array([0.4 * c, -0.3 * c]), np.array([3.0 * c, 20.0 * c])
    found, force = b.losses(q, v, omega), b.force(q, v, omega)
    moment = q[0] * force[1] - q[1] * force[0]
    assert found.friction_torque - found.bush_torque == pytest.approx(moment, rel=1e-11)
    # What is not shear is the pressure flow: -F . W.
    shear = mu * omega * R**3 * b.length / c * float(film.losses(*b.kinematics(q, v, omega), 0.4).shear)
    carried = v - 0.5 * omega * np.array([-q[1], q[0]])
    assert found.power_loss == pytest.approx(omega * shear - force @ carried, rel=1e-12)
    assert found.bush_torque == pytest.approx(shear - 0.5 * moment, rel=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize("cavitation", [ReynoldsFilm().cavitation, FullFilm()])
def test_pressure_flow_dissipates_what_the_source_does_on_the_force(cavitation):
    # Sum of conductance (difference of pressure)^2 over all faces, with cells of our own: -F . w.
    film, slenderness = ReynoldsFilm(cells=(64, 8), cavitation=cavitation), 0.7
    e, w = np.array([0.5, -0.3]), np.array([-0.4, 0.9])
    theta, face, P, _ = film._kernel(slenderness).field(e, w)
    grid = film.grids(slenderness)[1][0]

    def cubed(angle):
        return (1.0 - e[0] * np.cos(angle) - e[1] * np.sin(angle)) ** 3

    turn = 2.0 * np.pi
    step = (np.roll(theta, -1) - theta) % turn
    cell = (face - np.roll(face, 1)) % turn
    around = (cubed(face) / step * (np.roll(P, -1, axis=0) - P).T ** 2).T @ grid.width
    along = np.diff(P, axis=1, append=0.0) ** 2 @ grid.conductance * cubed(theta) * cell
    work = 12.0 * (around.sum() + along.sum() / slenderness**2)
    assert work == pytest.approx(-film.force(e, w, slenderness) @ w, rel=1e-11)


@pytest.mark.closed_form
def test_short_film_is_the_half_circle_that_faces_the_source():
    # 1/H over the half circle; behind its end, the streamers that keep their thickness; flow 2 |w|.
    for e, w in zip(states(6, 0.95)[0].T, states(6, 0.95)[1].T, strict=True):
        found = ShortFilm().losses(e, w, 0.2)
        t, sense = math.atan2(w[1], w[0]), math.copysign(1.0, e[1] * w[0] - e[0] * w[1])
        end = 1.0 - e @ [math.cos(t + sense * np.pi / 2), math.sin(t + sense * np.pi / 2)]

        def gap(angle, e=e):
            return 1.0 - e[0] * math.cos(angle) - e[1] * math.sin(angle)

        film = quad(lambda a: 1.0 / gap(a), t - np.pi / 2, t + np.pi / 2, epsabs=1e-12)[0]
        torn = quad(
            lambda a, end=end: min(1.0, end / gap(a)) / gap(a), t + np.pi / 2, t + 1.5 * np.pi, limit=500
        )[0]
        assert of(found) == pytest.approx([film, torn, 2.0 * math.hypot(*w)], rel=1e-6)


@pytest.mark.closed_form
@pytest.mark.parametrize("film", [ShortFilm(), ReynoldsFilm(cells=(192, 8))])
def test_side_flow_of_a_short_bearing(film):
    b = JournalBearing(radius=R, length=1e-3, clearance=c, viscosity=mu, film=film)
    found = b.losses([0.3 * c, -0.4 * c], REST, -omega)
    assert found.side_flow == pytest.approx(0.5 * omega * c * R * b.length, rel=1e-3)


@pytest.mark.parametrize("film", [MapFilm(), ShortFilm()])
def test_slopes_are_those_of_differences(film):
    e, w = states(40, 0.98, seed=3)
    slopes = film.losses(e, w, 0.4).slopes
    for column in range(4):
        d = np.zeros((4, 1))
        d[column] = 1e-6
        plus, minus = (of(film.losses(e + s * d[:2], w + s * d[2:], 0.4)) for s in (1, -1))
        size = np.abs(slopes).max(axis=1)
        assert np.all(np.abs((plus - minus) / 2e-6 - slopes[:, column]) < 1e-5 * size + 1e-7)


@pytest.mark.closed_form
@pytest.mark.parametrize("film", [MapFilm(), ShortFilm(), ReynoldsFilm()])
def test_losses_turn_and_mirror_with_the_state_and_flow_grows_with_the_source(film):
    e, w = states(8, 0.9)
    one, mirrored = film.losses(e, w, 0.5), film.losses(e * [[1], [-1]], w * [[1], [-1]], 0.5)
    cos, sin = math.cos(1.1), math.sin(1.1)
    turn = np.array([[cos, -sin], [sin, cos]])
    np.testing.assert_allclose(of(mirrored), of(one), rtol=1e-9)
    # Lines of a grid do not turn with the state.
    np.testing.assert_allclose(
        of(film.losses(turn @ e, turn @ w, 0.5)),
        of(one),
        rtol=3e-3 if isinstance(film, ReynoldsFilm) else 1e-9,
    )
    np.testing.assert_allclose(of(film.losses(e, 3.0 * w, 0.5)), of(one) * [[1], [1], [3]], rtol=1e-9)


@pytest.mark.closed_form
@pytest.mark.parametrize("film", [MapFilm(), ShortFilm(), ReynoldsFilm()])
def test_a_film_without_source_is_a_full_gap_at_the_center(film):
    still = film.losses(REST, REST, 0.5)
    assert still.shear == pytest.approx(2.0 * np.pi, rel=1e-6)
    assert still.shear_gap == pytest.approx(2.0 * np.pi, rel=1e-12)
    assert still.side_flow == 0.0
    assert still.slopes is None or np.isnan(still.slopes).all()
    with pytest.raises(FilmContactError):
        film.losses(np.array([1.0, 0.0]), REST, 0.5)


# Of the potential's curved ends and of finite volumes: two films that share nothing.
@pytest.mark.parametrize(("chi", "turn"), [(0.3, 0.5), (0.6, 0.05), (0.9, 0.5), (0.9, 0.8)])
@pytest.mark.parametrize("slenderness", [0.25, 1.0])
def test_shear_and_flow_converge_at_second_order_to_the_film_with_curved_ends(chi, turn, slenderness):
    cosine, sine = 2.0 * turn - 1.0, -2.0 * math.sqrt(turn * (1.0 - turn))
    exact = node_losses(chi, turn, slenderness)
    e, w = np.array([chi, 0.0]), np.array([cosine, sine])

    def errors(cells):
        found = ReynoldsFilm(cells=cells).losses(e, w, slenderness)
        return np.array([found.shear_film, found.shear, found.side_flow]) / exact - 1.0

    assert np.abs(errors((96, 8))).max() < 8e-3
    assert np.abs(errors((384, 32))).max() < 2.5e-4


@pytest.mark.parametrize("slenderness", [0.13, 0.37, 1.0, 2.3])
def test_tables_are_within_their_error_of_the_two_dimensional_film(slenderness):
    e, w = states(40, 0.95, seed=7)
    table, grid = (film.losses(e, w, slenderness) for film in (MapFilm(), ReynoldsFilm(cells=(384, 24))))
    # Film, film with streamers, flow, the last as far as the grid knows it in a long bearing.
    pairs = ("shear_film", 5e-4, 1e-3), ("shear", 5e-5, 2e-4), ("side_flow", 6e-4, 1e-3)
    for name, median, most in pairs:
        error = np.abs(getattr(table, name) / getattr(grid, name) - 1.0)
        assert np.median(error) < median, name
        assert np.quantile(error, 0.9) < most, name


def test_tables_go_on_to_the_wall():
    e, w = np.array([[0.995, 0.999], [0.0, 0.0]]), np.array([[0.0, 0.0], [-1.0, -1.0]])
    table, grid = (film.losses(e, w, 1.0) for film in (MapFilm(), ReynoldsFilm(cells=(384, 24))))
    np.testing.assert_allclose(table.shear, grid.shear, rtol=3e-3)
    np.testing.assert_allclose(table.side_flow, grid.side_flow, rtol=3e-3)


# Eccentricity, S = viscosity N/P (R/c)^2 and f R/c of Raimondi & Boyd (1958), L/D = 1, film from the maximum.
RAIMONDI_BOYD = [(0.9, 0.0188, 1.05), (0.8, 0.0446, 1.70), (0.6, 0.121, 3.22), (0.4, 0.264, 5.79)]


def friction(b, eps, **options):
    """Return S and f R/c, the power over that of the load sliding."""
    position = [eps * b.clearance, 0.0]
    load = math.hypot(*b.force(position, REST, omega))
    power = b.losses(position, REST, omega, **options).power_loss
    turns = omega / (2.0 * np.pi)
    S = b.viscosity * turns * b.length * 2.0 * R * (R / c) ** 2 / load
    return S, power / (omega * R * load) * R / c


@pytest.mark.literature
@pytest.mark.parametrize(("eps", "S", "published"), RAIMONDI_BOYD)
def test_friction_of_a_full_gap_is_that_of_raimondi_and_boyd(eps, S, published):
    film = ReynoldsFilm(cells=(256, 24))
    b = dataclasses.replace(PLAIN, grooves=(Groove(center=np.pi),), film=film)
    found = friction(b, eps, full_gap=True)
    assert found == pytest.approx((S, published), rel=0.015 if eps == 0.4 else 0.005)


# Computed once by finite volumes of another program, that shares no code with this one.
OWN_FRICTION = [
    (0.9, 1.056, 0.900),
    (0.8, 1.711, 1.471),
    (0.6, 3.232, 2.850),
    (0.4, 5.785, 5.277),
    (0.2, 12.68, 12.05),
    (0.1, 25.90, 25.21),
]


@pytest.mark.parametrize(("eps", "full", "streamers"), OWN_FRICTION)
def test_friction_with_streamers_is_less(eps, full, streamers):
    assert friction(PLAIN, eps, full_gap=True)[1] == pytest.approx(full, rel=1e-3)
    assert friction(PLAIN, eps)[1] == pytest.approx(streamers, rel=1e-3)


@pytest.mark.literature
@pytest.mark.parametrize("film", [MapFilm(), ReynoldsFilm(cells=(192, 16))])
def test_two_groove_bearing_of_ross(film, two_groove_film):
    # petrobras/ross, tests/data/fluid_film/fixed_isoviscous.json: another program, on 20 x 10 elements.
    grooves = tuple(Groove(center=s * np.pi / 2, width=np.pi - 3.07178) for s in (1, -1))
    viscosity = 0.01901574 * (0.00771523 / 0.01901574) ** (0.018 / 30.0)
    b = JournalBearing(
        radius=0.1999996,
        length=0.263144,
        clearance=0.194564e-3,
        viscosity=viscosity,
        film=film if isinstance(film, ReynoldsFilm) else two_groove_film,
        grooves=grooves,
    )
    at = equilibrium(b, (112814.907, 0.0), 900.0 * np.pi / 30.0)
    found = at.losses
    assert at.eccentricity_ratio == pytest.approx(0.5410, rel=0.01)
    assert at.attitude_angle == pytest.approx(0.8436, rel=0.01)
    assert found.power_loss == pytest.approx(11675.0, rel=0.01)
    assert found.side_flow == pytest.approx(3.352e-4, rel=0.01)
    assert sorted(found.inflow) == pytest.approx([2.937e-4, 5.725e-4], rel=0.01)


@pytest.fixture(scope="module")
def two_groove_film():
    """Return a coarse grid, as a map of that bearing would take."""
    return ExtrapolatedFilm(film=ReynoldsFilm(cells=(96, 8)))


@pytest.mark.closed_form
def test_oil_is_neither_made_nor_lost_between_openings():
    # The film begins where openings or streamers feed it: what openings do not get back leaves at the ends.
    b = dataclasses.replace(PLAIN, grooves=TWO, film=ReynoldsFilm(cells=(192, 16)))
    found = b.losses([0.5 * c, 0.3 * c], REST, omega)
    assert (found.inflow - found.arriving).sum() == pytest.approx(found.side_flow, rel=1e-3)
    # A groove after the film receives the thickness at which it was torn, at half the speed of the journal.
    assert np.all(found.arriving > 0.0)
    assert np.all(found.inflow > found.arriving * 0.9)


def test_openings_see_rotation_backwards_in_a_mirror():
    grooves = (Groove(center=0.4, width=0.3), Groove(center=2.5))
    mirrored = tuple(dataclasses.replace(g, center=-g.center) for g in grooves)
    b = dataclasses.replace(PLAIN, grooves=grooves, film=ReynoldsFilm(cells=(96, 8)))
    one = b.losses([0.4 * c, 0.3 * c], [2.0 * c, -c], omega)
    other = dataclasses.replace(b, grooves=mirrored).losses([0.4 * c, -0.3 * c], [2.0 * c, c], -omega)
    # The openings of the mirrored bearing come in the other order.
    assert other.power_loss == pytest.approx(one.power_loss, rel=1e-9)
    assert other.friction_torque == pytest.approx(-one.friction_torque, rel=1e-9)
    assert other.inflow[::-1] == pytest.approx(one.inflow, rel=1e-9)
    assert other.arriving[::-1] == pytest.approx(one.arriving, rel=1e-9)


@pytest.mark.closed_form
def test_supply_gives_the_pressure_flow_its_power():
    # At the center, without rotation: all power is that of the pump.
    grooves, supply = (Groove(center=0.4, width=0.3),), 1e5
    b = dataclasses.replace(PLAIN, grooves=grooves, supply_pressure=supply, film=ReynoldsFilm())
    found = b.losses(REST, REST, 0.0)
    assert found.power_loss == pytest.approx(supply * found.inflow.sum(), rel=1e-12)
    assert found.power_loss > 0.0
    assert found.inflow.sum() == pytest.approx(found.side_flow, rel=1e-9)


@pytest.mark.closed_form
def test_full_film_shears_all_of_the_gap_but_the_openings():
    geometry = FilmGeometry(pads=(Pad(start=0.3, extent=2.0), Pad(start=3.0, extent=2.5)))
    film = ReynoldsFilm(cavitation=FullFilm()).fitted(geometry)
    e, w = states(5, 0.9)
    found = film.losses(e, w, 0.6)
    np.testing.assert_allclose(found.shear_film, found.shear_gap, rtol=1e-12)
    one = e[:, 0]
    parts = [
        quad(lambda a: 1.0 / (1.0 - one @ [math.cos(a), math.sin(a)]), *ends)[0]
        for ends in ((0.3, 2.3), (3.0, 5.5))
    ]
    assert gap_shear(one, geometry) == pytest.approx(sum(parts), rel=1e-9)


def test_maps_without_tables_take_the_two_dimensional_film():
    e, w = states(2, 0.6)
    assert MapFilm().losses(e, w, 0.05).slopes is None


def test_equilibrium_tells_losses_and_a_law_without_them_tells_none():
    at = equilibrium(PLAIN, (0.0, -5000.0), omega)
    assert at.losses.power_loss == PLAIN.losses(at.position, REST, omega).power_loss
    splitting = dataclasses.replace(PLAIN, film=SplittingFilm(order=(2, None)))
    assert equilibrium(splitting, (0.0, -5000.0), omega).losses is None


def test_batches_are_their_states():
    q, v = np.array([[0.1, 0.5], [0.2, -0.3]]) * c, np.array([[1.0, 0.0], [0.0, 2.0]]) * c
    both = PLAIN.losses(q, v, [omega, -omega])
    for k, speed in enumerate((omega, -omega)):
        one = PLAIN.losses(q[:, k], v[:, k], speed)
        assert both.power_loss[k] == pytest.approx(one.power_loss, rel=1e-13)


def test_a_loss_table_is_its_bytes():
    nodes = np.exp(np.random.default_rng(0).normal(0.0, 0.001, (3, 1, 8, 7)))
    nodes[:, :, :2] = 1.0
    table = fit_loss_table(nodes, slenderness_range=(0.5, 0.5), largest_eccentricity_ratio=0.9)
    again = LossTable.from_bytes(table.to_bytes())
    assert again == LossTable.from_bytes(again.to_bytes())
    assert again.reach == table.reach
    with pytest.raises(RotorfilmError, match="LossTable: the checksum"):
        LossTable.from_bytes(table.to_bytes()[:-3])
    with pytest.raises(
        RotorfilmError, match="LossTable: the content must be that of such a table, got a MapTable"
    ):
        LossTable.from_bytes(packaged_table().to_bytes())
    with pytest.raises(InputError, match=r"log_center must be finite, of shape \(1, 3\), got shape \(1,\)"):
        dataclasses.replace(table, log_center=table.log_center[:, 0])


@pytest.mark.convergence
def test_table_meets_its_nodes():
    # A node of the packaged table, by the film that it was made of.
    table, slenderness = packaged_losses(), 0.1 * 40.0 ** (7 / 12)
    chi = 0.6
    film, all_of_it, flow = node_losses(chi, 0.25, slenderness)
    found = table.losses(slenderness).losses(np.array([[chi], [0.0]]), np.array([[-0.5], [-math.sqrt(0.75)]]))
    expected = [film, all_of_it - film, flow]
    np.testing.assert_allclose(found.losses[:, 0], expected, rtol=5e-4)
