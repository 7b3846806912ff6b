"""The lubricated contact on an ellipse: against Hertz, against Reynolds' equation in SI, and in time."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import integrate, sparse

from rotorfilm import ContactGrid, InputError, PointContact
from rotorfilm.bearings import (
    EllipticContact,
    FixedSteps,
    RoelandsViscosity,
    SmallMotion,
    StaggeredScheme,
    UpwindScheme,
)
from rotorfilm.bearings.contact.contact_law import under_load
from rotorfilm.bearings.contact.stationary import dry_contact
from rotorfilm.bearings.formulas import CIRCLE, Ellipse

SCHEMES = [UpwindScheme(), StaggeredScheme()]


def contact(ellipticity, cells=40, V=0.1, Q0=5.0, half_width=1.5, **change):
    grid = ContactGrid(cells=(cells, cells), half_width=half_width)
    return PointContact(V=V, Q0=Q0, grid=grid, ellipticity=ellipticity, **change)


def small_motion(c, state):
    return SmallMotion(c.equations, state.levels[0].pressure, state.delta)


# The dry contact


@pytest.mark.closed_form
def test_a_circle_has_the_constants_of_the_ball():
    assert CIRCLE.across == 1.0
    assert CIRCLE.strength == pytest.approx(4.0 / np.pi**2, rel=2e-16)
    assert CIRCLE.load == 2.0 * np.pi / 3.0
    assert CIRCLE.depth == pytest.approx(2.0, rel=2e-16)
    assert CIRCLE.slope == pytest.approx(np.pi / 2.0, rel=2e-16)


@pytest.mark.closed_form
@pytest.mark.parametrize("kappa", [1.0, 2.5, 8.0])
def test_pressure_of_the_dry_ellipse_flattens_the_gap(kappa):
    """By quadrature in polar coordinates about the point, which takes the singularity away."""
    ellipse = Ellipse(kappa)

    def deflected(x, y):
        def ray(phi):
            c, s = np.cos(phi), np.sin(phi)
            # Along a ray the pressure is sqrt(e - 2 f r - g r^2), whose integral is elementary.
            e, f, g = 1.0 - x**2 - (y / kappa) ** 2, x * c + y * s / kappa**2, c**2 + (s / kappa) ** 2
            return (e + f**2 / g) / np.sqrt(g) * (np.pi / 4.0 - 0.5 * np.arcsin(f / np.sqrt(f**2 + e * g)))

        def rest(phi):
            c, s = np.cos(phi), np.sin(phi)
            e, f, g = 1.0 - x**2 - (y / kappa) ** 2, x * c + y * s / kappa**2, c**2 + (s / kappa) ** 2
            return -0.5 * f / g * np.sqrt(e)

        return integrate.quad(lambda v: ray(v) + rest(v), 0.0, 2.0 * np.pi, epsabs=1e-12, limit=400)[0]

    for x, y in ((0.0, 0.0), (0.6, 0.0), (-0.3, 0.5 * kappa), (0.1, -0.8 * kappa)):
        gap = -ellipse.depth + x**2 + ellipse.across * y**2 + ellipse.strength * deflected(x, y)
        assert gap == pytest.approx(0.0, abs=1e-10)


@pytest.mark.closed_form
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("load", [1.0, 2.0])
def test_dry_contact_carries_its_load_and_closes_the_gap(scheme, load):
    c = contact(4.0, 96, scheme=scheme)
    pressure, delta = dry_contact(c.equations, load)
    assert c.equations.carried_load(pressure) == pytest.approx(load, rel=3e-3)
    assert c.equations.central_film(pressure, delta) == pytest.approx(0.0, abs=4e-3)
    film = (c.equations.sampling.stored @ c.equations.film(pressure, delta)).reshape(c.grid.shape)
    inside = np.hypot(*np.meshgrid(c.grid.x, c.grid.y, indexing="ij")) < 0.85
    assert np.abs(film[inside]).max() < 6e-3


@pytest.mark.closed_form
def test_thin_films_tend_to_the_dry_ellipse():
    misses = []
    for V, Q0 in ((0.3, 3.0), (0.05, 8.0), (0.012, 20.0)):
        c = contact(4.0, 48, V=V, Q0=Q0)
        state = c.stationary()
        x, y = np.meshgrid(c.grid.x, c.grid.y, indexing="ij")
        inside = np.hypot(x, y) < 0.8
        dry = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
        misses.append((np.abs(state.pressure - dry)[inside].max(), state.delta + Ellipse(4.0).depth))
    assert misses[0] > misses[1] > misses[2]
    assert misses[2][0] < 0.06
    assert 0.0 < misses[2][1] < 0.12


# Against Reynolds' equation in SI


class ReynoldsInSi:
    """Film, load and their small motions in SI, all cells at once and dense: nothing of the product."""

    def __init__(self, touch, load, rolling, viscosity, alpha, grid):
        self.load, self.viscosity, self.alpha, self.speed = load, viscosity, alpha, rolling
        a, b = touch.half_axes(load)
        nx, ny = grid.cells
        x = b * np.linspace(grid.inlet, grid.outlet, nx + 1)
        y = a * grid.half_width * np.linspace(-1.0, 1.0, ny + 1)
        dx, dy = x[1] - x[0], y[1] - y[0]
        self.area = dx * dy
        X, Y = (v.ravel() for v in np.meshgrid(x, y, indexing="ij"))
        self.gap = X**2 / (2.0 * touch.rolling_radius) + Y**2 / (2.0 * touch.groove_radius)

        def primitive(u, v):
            r = np.hypot(u, v)
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.nan_to_num(u * np.log(v + r)) + np.nan_to_num(v * np.log(u + r))

        left, right = (np.repeat(v, ny) for v in (x[:-1], x[1:]))
        below, above = (np.tile(v, nx) for v in (y[:-1], y[1:]))
        one = sum(
            sign * primitive(u - X[:, None], v - Y[:, None])
            for sign, u, v in ((1, right, above), (-1, left, above), (-1, right, below), (1, left, below))
        )
        self.bend = 2.0 / (np.pi * touch.combined_modulus) * one

        def mean(n):
            return sparse.diags([0.5, 0.5], [0, 1], shape=(n, n + 1))

        def rise(n):
            walls = [2.0 * (np.arange(n) == 0)], [-2.0 * (np.arange(n) == n - 1)]
            return sparse.csr_matrix(np.vstack([walls[0], np.diff(np.eye(n), axis=0), walls[1]]))

        def net(n):
            return sparse.diags([1.0, -1.0], [1, 0], shape=(n, n + 1))

        on, kron = sparse.identity, sparse.kron
        self.faces = kron(on(nx + 1), mean(ny)).tocsr(), kron(mean(nx), on(ny + 1)).tocsr()
        self.slope = kron(rise(nx), on(ny)).tocsr() / dx, kron(on(nx), rise(ny)).tocsr() / dy
        self.net = kron(net(nx), on(ny)).tocsr() / dx, kron(on(nx), net(ny)).tocsr() / dy
        self.cells = kron(mean(nx), mean(ny)).tocsr()

    def balance(self, p, h):
        """Return inflow per area [m/s] without squeeze, and its derivatives by p and by h."""
        mobility = np.exp(-self.alpha * p) / (12.0 * self.viscosity)
        total = -self.speed * self.net[0] @ (self.faces[0] @ h)
        by_p, by_h = 0.0, -self.speed * self.net[0] @ self.faces[0]
        for face, slope, net in zip(self.faces, self.slope, self.net, strict=True):
            # exp(-alpha p) grad p = -grad exp(-alpha p)/alpha, from 1 outside.
            push = slope @ ((1.0 - np.exp(-self.alpha * p)) / (12.0 * self.viscosity * self.alpha))
            height = face @ h
            total = total + net @ (height**3 * push)
            by_p = by_p + net @ sparse.diags(height**3) @ slope @ sparse.diags(mobility)
            by_h = by_h + net @ sparse.diags(3.0 * height**2 * push) @ face
        return total, by_p, by_h

    def rest(self, p, approach):
        for _ in range(2):
            h = self.gap + approach + self.bend @ p
            total, by_p, by_h = self.balance(p, h)
            wet = p > 0.0
            matrix = by_p[wet][:, wet].toarray() + by_h[wet] @ self.bend[:, wet]
            column = by_h[wet] @ np.ones(self.gap.size)
            full = np.block([[matrix, column[:, None]], [np.full((1, wet.sum()), self.area), 0.0]])
            # Pressures in GPa, the approach in um.
            scale = np.append(np.full(wet.sum(), 1e9), 1e-6)
            right = np.append(-total[wet], self.load - self.area * p.sum())
            step = scale * np.linalg.solve(full * scale, right)
            p, approach = p.copy(), approach + step[-1]
            p[wet] += step[:-1]
        return p, approach

    def stiffness(self, p, approach, omega):
        """Return -d(force)/d(approach) [N/m] at an angular frequency [rad/s]."""
        _, by_p, by_h = self.balance(p, self.gap + approach + self.bend @ p)
        by_h = by_h - 1j * omega * self.cells
        wet = p > 0.0
        matrix = by_p[wet][:, wet].toarray() + by_h[wet] @ self.bend[:, wet]
        return self.area * np.linalg.solve(matrix, by_h[wet] @ np.ones(self.gap.size)).sum()


@pytest.mark.closed_form
def test_film_approach_and_dynamic_stiffness_are_those_of_reynolds_equation_in_si():
    touch = EllipticContact(rolling_radius=3.2e-3, groove_radius=40e-3, combined_modulus=227e9)
    load, rolling, viscosity, alpha = 20.0, 3.0, 8e-3, 4e-9  # m/s: the mean of both surfaces
    a, b = touch.half_axes(load)
    peak, R = touch.pressure(load), touch.rolling_radius
    c = contact(
        touch.ellipticity,
        cells=26,
        V=24.0 * viscosity * 2.0 * rolling * R**2 / (peak * b**3),
        Q0=alpha * peak,
        scheme=StaggeredScheme(),
    )
    state = c.stationary()
    truth = ReynoldsInSi(touch, load, rolling, viscosity, alpha, c.grid)
    start = peak * np.concatenate([state.pressure[:, ::-1], state.pressure], axis=1).ravel()
    film = b**2 / (2.0 * R)
    p, approach = truth.rest(start, film * state.delta)
    assert 0.02 < c.V < 0.5
    assert a / b > 4.0
    assert np.abs(p - start).max() < 1e-6 * peak
    assert approach == pytest.approx(film * state.delta, rel=1e-7)
    assert truth.balance(p, truth.gap + approach + truth.bend @ p)[0][p == 0.0].max() < 1e-9
    small, unit = small_motion(c, state), load / (c.equations.ellipse.load * film)
    for w in (0.1, 1.0, 3.0):
        exact = truth.stiffness(p, approach, w * rolling / b)
        assert unit * small.stiffness(1j * w) == pytest.approx(exact, rel=1e-6)
    # Hertz's stiffness is the unit in which the film softens by 1 to 2 %.
    assert unit * c.equations.ellipse.slope == pytest.approx(1.5 * load / touch.approach(load), rel=1e-12)
    assert 0.97 < small.stiffness(1e-6j).real / c.equations.ellipse.slope < 0.995


# Figures


@pytest.mark.long
@pytest.mark.convergence
def test_film_on_an_ellipse_converges_to_one_limit():
    limits = []
    for scheme, name in ((UpwindScheme(), "central_film"), (StaggeredScheme(), "delta")):
        states = [contact(4.0, n, scheme=scheme).stationary() for n in (32, 48, 96)]
        values = [getattr(state, name) for state in states]
        # (h/32)^2 - (h/48)^2 over (h/48)^2 - (h/96)^2 is 5/3 at second order, 2.7 at third.
        assert 1.5 < (values[1] - values[0]) / (values[2] - values[1]) < 2.4
        fine, middle = (np.array([state.central_film, state.delta]) for state in states[:0:-1])
        limits.append(fine + (fine - middle) / 3.0)
    assert limits[0] == pytest.approx(limits[1], rel=5e-4)
    assert limits[0][0] == pytest.approx(0.1987, abs=1e-4)


@pytest.mark.literature
@pytest.mark.parametrize(
    ("kappa", "V", "Q0", "film", "stiffness", "damping"),
    [
        (1.0, 0.1, 5.0, 0.1736, 0.982, (0.0335, 0.0218, 0.0081, 0.0065)),
        (2.0, 0.1, 5.0, 0.1918, 0.981, (0.0425, 0.0285, 0.0120, 0.0081)),
        (4.0, 0.1, 5.0, 0.1988, 0.982, (0.0450, 0.0312, 0.0149, 0.0094)),
        (8.0, 0.1, 5.0, 0.2019, 0.985, (0.0440, 0.0313, 0.0164, 0.0101)),
    ],
)
def test_film_and_damping_over_the_ellipticity(kappa, V, Q0, film, stiffness, damping):
    """Of another dense code, on the same rectangle, 1 % off in damping between its grids."""
    c = contact(kappa, scheme=StaggeredScheme(), V=V, Q0=Q0)
    state = c.stationary()
    small, hertz = small_motion(c, state), c.equations.ellipse.slope
    assert state.central_film == pytest.approx(film, abs=1.5e-4)
    assert small.stiffness(1e-6j).real / hertz == pytest.approx(stiffness, abs=1.5e-3)
    for w, value in zip((1e-6, 1.0, 2.0, 6.0), damping, strict=True):
        assert small.stiffness(1j * w).imag / (w * hertz) == pytest.approx(value, rel=0.025)


# In time


def test_given_motion_takes_the_work_of_the_dynamic_stiffness():
    c = contact(4.0, 24)
    resting = c.stationary()
    omega, amplitude = 1.5, 0.1
    period = 2.0 * np.pi / omega
    run = c.drive(
        resting,
        duration=2.0 * period,
        approach=lambda t: resting.delta + amplitude * np.sin(omega * t),
        control=FixedSteps(step=period / 60),
    )
    last = run.time > period - 1e-9
    lost = -np.trapezoid(c.equations.ellipse.load * run.carried_load[last], run.delta[last])
    damping = small_motion(c, resting).stiffness(1j * omega).imag / omega
    assert lost == pytest.approx(np.pi * omega * amplitude**2 * damping, rel=0.03)


def test_a_ball_on_an_ellipse_rests_and_swings_by_its_stiffness():
    c = contact(4.0, 20)
    resting = c.stationary(1.3)
    assert resting.carried_load == pytest.approx(1.3, rel=1e-6)
    still = c.simulate(resting, duration=1.0, W=1.0, load=1.3, control=FixedSteps(step=0.25))
    assert still.delta == pytest.approx(resting.delta, abs=1e-6)
    massless = c.simulate(resting, duration=1.0, W=0.0, load=lambda t: 1.3 + 0.2 * t)
    assert massless.carried_load == pytest.approx(massless.driven, rel=1e-5)
    s = small_motion(c, c.stationary()).natural_motion(2.0, 1j * np.sqrt(c.equations.ellipse.slope / 2.0))
    state = c.stationary()
    pushed = c.state(state.pressure, state.delta, velocity=0.05)
    run = c.simulate(pushed, duration=2.0 * np.pi / s.imag, W=2.0, control=FixedSteps(step=0.04))
    back = np.diff(np.sign(run.delta - state.delta)) < 0
    turned = run.time[1:][back][0]
    assert turned == pytest.approx(np.pi / s.imag, rel=0.03)


@pytest.mark.parametrize("value", [0.5, np.nan, -4.0])
def test_ellipticity_is_at_least_one(value):
    with pytest.raises(InputError, match=r"ellipticity must be (at least 1|finite and positive), got"):
        contact(value)


def test_the_ellipse_stays_under_another_load_and_decides_the_contact():
    c = contact(4.0, piezoviscosity=RoelandsViscosity(exponent=0.6, pressure_ratio=3.0))
    assert under_load(c.equations, 2.0).ellipse == c.equations.ellipse
    assert replace(c, ellipticity=2.0).equations != c.equations
