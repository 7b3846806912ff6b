"""The point contact: stationary solution, motion in time, small motions, files."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, RectBivariateSpline
from scipy.io import netcdf_file

from rotorfilm import ContactGrid, ConvergenceError, InputError, PointContact, ValidityWarning
from rotorfilm.bearings import (
    AdaptiveSteps,
    FixedSteps,
    SineLoad,
    SmallMotion,
    StaggeredScheme,
    StepLoad,
    UpwindScheme,
    perturbed,
)
from rotorfilm.bearings.contact import contact_steps as contact_files
from rotorfilm.bearings.contact.contact_steps import derivative_weights, extrapolation_weights
from rotorfilm.bearings.contact.film_equations import TimeDerivative


def contact(cells=32, V=0.1, Q0=5.0, **change):
    return PointContact(V=V, Q0=Q0, grid=ContactGrid(cells=(cells, cells)), **change)


@pytest.fixture(scope="module")
def coarse():
    return contact(24)


@pytest.fixture(scope="module")
def resting(coarse):
    return coarse.stationary()


@pytest.fixture(scope="module")
def natural(coarse, resting):
    small = SmallMotion(coarse.equations, resting.levels[0].pressure, resting.delta)
    return small, small.natural_motion(1.0, 1.25j)


# Stationary contact


def test_pressure_balances_the_load_and_obeys_complementarity():
    c = contact(40)
    for load in (0.4, 1.0, 2.5):
        state = c.stationary(load)
        assert state.carried_load == pytest.approx(load, rel=1e-6)
        film = c.equations.film(state.levels[0].pressure, state.delta)
        left = c.equations.residual(state.levels[0].pressure, film, TimeDerivative()).reshape(c.grid.shape)
        assert np.all(state.pressure >= 0.0)
        assert np.all(left[state.pressure == 0.0] <= 0.0)
        assert np.abs(left[state.pressure > 0.0]).max() < 1e-5
        assert state.minimum_film > 0.0


@pytest.mark.closed_form
def test_thin_films_tend_to_the_dry_contact():
    errors = []
    for V, Q0 in ((0.3, 3.0), (0.05, 8.0), (0.006, 20.0)):
        c = contact(48, V=V, Q0=Q0)
        state = c.stationary()
        x, y = np.meshgrid(c.grid.x, c.grid.y, indexing="ij")
        inside = np.hypot(x, y) < 0.8
        dry = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
        errors.append((np.abs(state.pressure - dry)[inside].max(), state.delta + 2.0))
    assert errors[0] > errors[1] > errors[2]
    assert errors[2][0] < 0.05
    assert 0.0 < errors[2][1] < 0.05


@pytest.mark.long
@pytest.mark.literature
def test_published_case_on_the_published_grid_and_converged():
    # Panovko (2011), 40 x 40: 0.1761 and 1.793, with a midpoint rule for the singular integral whose error is
    # 1.6155 (4/pi^2) dx p, and a rectangle that is not given; the sum is .1761 + 1.793 = 1.969.
    published = contact(40, scheme=StaggeredScheme()).stationary()
    peak = published.pressure[np.abs(contact(40).grid.x).argmin(), 0]
    missing = 1.6155 * 4.0 / np.pi**2 * 0.1 * peak
    assert published.central_film - published.delta - missing + 0.04 == pytest.approx(1.969, abs=0.03)
    # Two independent discretizations, and the limit h -> 0 on this rectangle known to 1e-5.
    fine = contact(128, scheme=StaggeredScheme()).stationary()
    upwind = [contact(n).stationary() for n in (64, 128)]
    assert fine.central_film == pytest.approx(0.173743, rel=1e-4)
    assert fine.delta == pytest.approx(-1.819553, rel=1e-4)
    for name in ("central_film", "delta"):
        coarse, better = (getattr(state, name) for state in upwind)
        extrapolated = better + (better - coarse) / 3.0
        assert extrapolated == pytest.approx(getattr(fine, name), rel=3e-4)


def test_hard_contact_is_reached_and_stays_clean():
    state = contact(64, V=0.006, Q0=20.0).stationary()
    assert state.carried_load == pytest.approx(1.0, rel=1e-6)
    assert state.checkerboard < 0.01


def test_staggered_scheme_alternates_and_says_so():
    c = contact(40, V=0.05, Q0=8.0, scheme=StaggeredScheme())
    with pytest.warns(ValidityWarning, match=r"must not alternate from cell to cell by more than 2.5%, got "):
        state = c.stationary()
    assert contact(40, V=0.05, Q0=8.0).stationary().checkerboard < 0.1 * state.checkerboard


# Motion in time


@pytest.mark.closed_form
def test_difference_formulas_are_exact_for_their_degree():
    t, times = 1.3, [1.0, 0.8, 0.1]
    for degree, count in ((1, 1), (2, 2)):
        weights = derivative_weights(t, times[:count])
        past = [a**degree for a in times[:count]]
        assert weights.new * t**degree + weights.history(past) == pytest.approx(degree * t ** (degree - 1))
    ahead = extrapolation_weights(t, times)
    assert ahead @ np.array([a**2 - 3.0 * a for a in times]) == pytest.approx(t**2 - 3.0 * t)


@pytest.mark.convergence
@pytest.mark.parametrize("order", [1, 2])
def test_time_converges_at_the_declared_order(coarse, resting, order):
    load = SineLoad(amplitude=0.4, frequency=2.0)
    runs = [
        coarse.simulate(
            resting, duration=1.0, W=0.5, load=load, control=FixedSteps(step=step, order=o, tolerance=1e-8)
        ).delta
        for step, o in ((0.1, order), (0.05, order), (0.0125, 2))
    ]
    errors = [np.abs(runs[0] - runs[2][::8]).max(), np.abs(runs[1][::2] - runs[2][::8]).max()]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.25)


@pytest.mark.long
@pytest.mark.convergence
def test_error_follows_the_tolerance(coarse, resting):
    load = SineLoad(amplitude=0.4, frequency=2.0)
    exact = coarse.simulate(
        resting, duration=2.0, W=0.5, load=load, control=FixedSteps(step=0.005, tolerance=1e-8)
    )
    errors = []
    for tolerance in (1e-2, 1e-3, 1e-4):
        run = coarse.simulate(
            resting, duration=2.0, W=0.5, load=load, control=AdaptiveSteps(tolerance=tolerance)
        )
        errors.append(abs(run.delta[-1] - exact.delta[-1]))
    assert errors[1] < 0.003
    assert errors[2] < 0.5 * errors[1] < 0.1 * errors[0]


@pytest.mark.closed_form
def test_stationary_contact_stays(coarse, resting):
    run = coarse.simulate(resting, duration=2.0, W=1.0)
    assert np.abs(run.delta - resting.delta).max() < 1e-5
    assert run.complete
    assert run.work["rejected"] == 0


@pytest.mark.closed_form
def test_momentum_is_the_integral_of_the_forces(coarse, resting):
    load = StepLoad(amplitude=0.7, start=0.5)
    run = coarse.simulate(resting, duration=1.5, W=0.3, load=load, control=AdaptiveSteps(tolerance=1e-5))
    assert 0.5 in run.time
    force = 2.0 * np.pi / 3.0 * (run.carried_load - run.driven)
    late = run.time > 0.5 + 1e-12
    impulse = np.trapezoid(force[late], run.time[late])
    assert 0.3 * (run.velocity[-1] - run.velocity[late][0]) == pytest.approx(impulse, abs=2e-3)


@pytest.mark.closed_form
@pytest.mark.parametrize(("step", "order"), [(0.2, 1), (0.1, 2)])
def test_scheme_damps_as_its_amplification_says(coarse, resting, natural, step, order):
    # A linear motion exp(s t) becomes z^n with s h = 1 - 1/z (Euler) or 3/2 - 2/z + 1/(2 z^2) (BDF2).
    s = natural[1]
    z = 1.0 / (1.0 - s * step)
    if order == 2:
        z = 1.0 / (2.0 - np.sqrt(1.0 + 2.0 * s * step))
    start = perturbed(coarse, resting, -1e-3)
    run = coarse.simulate(
        start, duration=12.0, W=1.0, control=FixedSteps(step=step, order=order, tolerance=1e-9)
    )
    rate = _decay(run.time, run.delta - resting.delta)
    assert rate == pytest.approx(-np.log(abs(z)) / step, rel=0.02)


def _decay(time, delta):
    """Return the rate at which a decaying oscillation decays, from its peaks."""
    spline = CubicSpline(time, delta)
    peaks = spline.derivative().roots(extrapolate=False)
    peaks = peaks[peaks > 6.0]
    return -np.polyfit(peaks, np.log(np.abs(spline(peaks))), 1)[0]


@pytest.mark.long
@pytest.mark.closed_form
def test_three_ways_to_the_decay_time(coarse, resting, natural):
    small, W = natural[0], 0.5
    s = small.natural_motion(W, 1j * np.sqrt(1.57 / W))
    assert abs(W * s**2 + small.stiffness(s)) < 1e-8
    # In time, by variable steps. Smaller motions are off by 2-4 % on so coarse a grid: the film's edge
    # moves by whole cells.
    pushed = coarse.state(resting.pressure, resting.delta, velocity=0.1 / np.sqrt(W))
    run = coarse.simulate(pushed, duration=18.0, W=W, control=AdaptiveSteps(tolerance=2e-5, largest=0.1))
    assert np.ptp(np.diff(run.time)) > 0.02
    assert _decay(run.time, run.delta - resting.delta) == pytest.approx(-s.real, rel=0.02)
    # By the energy that a given motion loses in a cycle, pi omega c a^2, over what the ball stores.
    omega, amplitude = s.imag, 0.08
    period = 2.0 * np.pi / omega
    driven = coarse.drive(
        resting,
        duration=3.0 * period,
        approach=lambda t: resting.delta + amplitude * np.sin(omega * t),
        control=FixedSteps(step=period / 100),
    )
    last = driven.time > 2.0 * period - 1e-9
    lost = -np.trapezoid(2.0 * np.pi / 3.0 * driven.carried_load[last], driven.delta[last])
    assert lost / (2.0 * W * np.pi * omega * amplitude**2) == pytest.approx(-s.real, rel=0.02)


@pytest.mark.closed_form
@pytest.mark.parametrize("scheme", [UpwindScheme(), StaggeredScheme()])
def test_what_flows_into_a_box_flows_out(scheme):
    # By splines through p and H, which know nothing of the scheme: entrainment less the flow by pressure.
    misses = []
    for cells in (32, 64):
        c = contact(cells, scheme=scheme)
        state = c.stationary()
        y = np.concatenate([-c.grid.y[::-1], c.grid.y])
        p, film = (
            RectBivariateSpline(c.grid.x, y, np.concatenate([v[:, ::-1], v], axis=1))
            for v in (state.pressure, state.thickness)
        )

        def along(x, v, p=p, film=film):
            return 0.1 * film(x, v) - film(x, v) ** 3 * np.exp(-5.0 * p(x, v)) * p(x, v, dx=1)

        def across(u, y, p=p, film=film):
            return -(film(u, y) ** 3) * np.exp(-5.0 * p(u, y)) * p(u, y, dy=1)

        u, v = np.linspace(-1.6, 0.4, 801), np.linspace(0.0, 0.7, 401)
        inflow, outflow = (np.trapezoid(along(x, v).ravel(), v) for x in (u[0], u[-1]))
        sideways = np.trapezoid(across(u, v[-1]).ravel(), u)
        misses.append(abs(outflow + sideways - inflow) / inflow)
    assert misses[1] < 1e-2
    assert misses[1] < 0.5 * misses[0]


@pytest.mark.long
@pytest.mark.literature
def test_infinite_rectangle():
    # The error of delta falls as one over the length of the rectangle; that of the cells is taken from the
    # small rectangle, whose limit is known: H0 = .173743, delta = -1.819553.
    def solved(per_unit, inlet, outlet, half):
        cells = round(per_unit * (outlet - inlet)), round(2 * per_unit * half)
        grid = ContactGrid(cells=cells, inlet=inlet, outlet=outlet, half_width=half)
        state = PointContact(V=0.1, Q0=5.0, grid=grid, scheme=StaggeredScheme()).stationary()
        return np.array([state.central_film, state.delta])

    small = np.array([0.173743, -1.819553]) - solved(10, -2.5, 1.5, 2.0)
    medium, large = solved(10, -8.0, 2.0, 5.0) + small, solved(10, -16.0, 2.0, 9.0) + small
    assert large[0] == pytest.approx(0.1749, rel=2e-3)
    assert large[1] == pytest.approx(-1.804, rel=2e-3)
    assert 2.0 * large[1] - medium[1] == pytest.approx(-1.804, rel=1e-3)


@pytest.mark.literature
def test_published_scheme_damps_by_itself(resting):
    # Published grid, scheme and case 4.1: the decay times 53.9 and 65.3 of the equations become 3.2 and 6.0.
    c = contact(40, scheme=StaggeredScheme())
    at = c.stationary()
    small = SmallMotion(c.equations, at.levels[0].pressure, at.delta)
    for W, physical, published in ((0.5, 53.9, 3.2), (1.0, 65.3, 6.0)):
        s = small.natural_motion(W, 1j * np.sqrt(1.57 / W))
        assert -1.0 / s.real == pytest.approx(physical, rel=5e-3)
        assert 0.2 / np.log(abs(1.0 - 0.2 * s)) == pytest.approx(published, rel=0.03)
    for omega, k, damping in (
        (1e-3, 1.542, 0.0560),
        (1.2533, 1.576, 0.0304),
        (2.0, 1.583, 0.0156),
        (5.0, 1.602, 0.0144),
    ):
        z = small.stiffness(1j * omega)
        assert (z.real, z.imag / omega) == (pytest.approx(k, abs=6e-4), pytest.approx(damping, abs=6e-5))


@pytest.mark.long
def test_ball_leaves_the_film_and_comes_back(coarse, resting):
    load = StepLoad(amplitude=-1.5, start=0.5, end=2.5)
    run = coarse.simulate(resting, duration=8.0, W=1.0, load=load, control=AdaptiveSteps(tolerance=1e-3))
    assert run.delta.max() > 1.0
    assert run.carried_load.min() < 1e-3
    assert run.carried_load[-1] > 0.5
    assert run.minimum_film.min() > 0.0


def test_massless_ball_carries_the_load_at_once(coarse, resting):
    load = StepLoad(amplitude=0.7, start=0.5)
    run = coarse.simulate(resting, duration=2.0, W=0.0, load=load, control=AdaptiveSteps(tolerance=1e-3))
    assert run.carried_load == pytest.approx(run.driven, rel=1e-5)


@pytest.mark.long
def test_load_step_of_eight_completes_by_adapting():
    grid = ContactGrid(cells=(64, 48), inlet=-4.5, outlet=3.5, half_width=3.0)
    c = PointContact(V=0.1, Q0=5.0, grid=grid)
    start, load = c.stationary(), StepLoad(amplitude=8.0, start=0.5)
    run = c.simulate(start, duration=4.0, W=1.0, load=load, control=AdaptiveSteps(tolerance=2e-3))
    assert run.complete
    assert run.carried_load.max() > 15.0


def test_failed_run_keeps_what_it_has(coarse, resting):
    load = StepLoad(amplitude=60.0, start=0.5)
    with pytest.raises(ConvergenceError, match=r"\(at t = ") as caught:
        coarse.simulate(resting, duration=8.0, W=0.1, load=load, control=FixedSteps(step=0.5, order=1))
    assert not caught.value.partial.complete
    assert caught.value.partial.time[0] == 0.0


def test_interrupted_run_keeps_what_it_has_and_is_resumed(coarse, resting, tmp_path):
    def load(t):
        if stop and t > 0.5:
            raise KeyboardInterrupt
        return 1.0 + 0.3 * np.sin(2.0 * t)

    control, stop = FixedSteps(step=0.05, tolerance=1e-9), False
    whole = coarse.simulate(resting, duration=1.0, W=0.5, load=load, control=control)
    stop = True
    part = coarse.simulate(resting, duration=1.0, W=0.5, load=load, control=control)
    assert not part.complete
    assert part.time[-1] == pytest.approx(0.5)
    coarse.save(part, tmp_path / "part.nc")
    read = coarse.load(tmp_path / "part.nc")
    assert np.array_equal(read.delta, part.delta)
    assert read.work == part.work
    stop = False
    rest = coarse.simulate(read, duration=1.0, W=0.5, load=load, control=control)
    for name in ("time", "delta", "velocity", "carried_load", "driven", "work"):
        assert np.array_equal(getattr(rest, name), getattr(whole, name))
    assert np.array_equal(rest.final.pressure, whole.final.pressure)
    with pytest.raises(InputError, match=r"path must be a run of PointContact.*, got '.*part\.nc'"):
        contact(16).load(tmp_path / "part.nc")
    with pytest.raises(
        InputError, match=r"start must be continued with the arguments that it began with, BallMotion\(W=0\.5"
    ):
        coarse.simulate(read, duration=1.0, W=0.6, load=load, control=control)
    with pytest.raises(InputError, match="that is not complete, got a complete run"):
        coarse.simulate(whole, duration=1.0, W=0.5, load=load, control=control)


def test_a_run_goes_on_under_its_own_load_only(coarse, resting):
    asked = {"duration": 0.5, "W": 1.0, "snapshots": tuple(np.arange(0.01, 0.5, 0.01))}
    whole = coarse.simulate(resting, **asked, load=lambda t: 1.0 + 0.3 * t)
    part = replace(whole, complete=False)
    # The same until then: what comes later is not known of a function.
    assert coarse.simulate(part, **asked, load=lambda t: 1.0 + 0.3 * t).complete
    with pytest.raises(InputError, match=r"that it began with, 1\.00\d+ at t = 0\.0\d+, got 1\.00\d+$"):
        coarse.simulate(part, **asked, load=lambda t: 1.0 + 0.4 * t)
    other = {**asked, "snapshots": (*asked["snapshots"], 0.49)}
    with pytest.raises(InputError, match=r"with the arguments that it began with, .*got") as caught:
        coarse.simulate(part, **other, load=lambda t: 1.0 + 0.3 * t)
    assert len(str(caught.value)) < 400


@pytest.mark.long
def test_a_run_goes_on_to_the_last_bit_from_every_step(coarse, resting, tmp_path, monkeypatch):
    # Steps adapt, a jump starts the history anew, and snapshots are hit on the way.
    asked = {"duration": 1.5, "W": 0.5, "load": StepLoad(amplitude=0.8, start=0.7), "snapshots": (0.3,)}
    monkeypatch.setattr(contact_files, "EVERY", -1.0)
    whole, parts = tmp_path / "whole.nc", []

    def keep(self, run, path):
        contact_files.save_run(run, path, repr(self))
        parts.append(path.read_bytes())

    with monkeypatch.context() as patch:
        patch.setattr(PointContact, "save", keep)
        coarse.simulate(resting, **asked, keep=whole)
    assert len(parts) > 20
    for content in parts[:-1:4]:
        (tmp_path / "part.nc").write_bytes(content)
        coarse.simulate(coarse.load(tmp_path / "part.nc"), **asked, keep=tmp_path / "part.nc")
        assert (tmp_path / "part.nc").read_bytes() == whole.read_bytes()


def test_a_run_that_cannot_be_saved_is_not_lost(coarse, resting, tmp_path):
    with pytest.warns(RuntimeWarning, match=r"could not be saved: .*No such file.*'.*absent.run\.nc'"):
        assert coarse.simulate(resting, duration=0.1, W=1.0, keep=tmp_path / "absent" / "run.nc").complete


def test_a_damaged_run_is_refused(coarse, resting, tmp_path):
    path = tmp_path / "run.nc"
    coarse.save(coarse.simulate(resting, duration=0.1, W=1.0), path)
    whole, size = path.read_bytes(), path.stat().st_size
    with netcdf_file(path, "r", mmap=False) as file:  # any reader of NetCDF reads it
        assert file.variables["delta"][0] == resting.delta
    damages = [whole[:k] for k in range(0, size, size // 20)]
    damages += [whole[:k] + bytes([whole[k] ^ 16]) + whole[k + 1 :] for k in range(0, size, size // 20)]
    damages += [whole[: size // 2] + bytes(size - size // 2)]  # a tail of zeros
    for content in damages:
        path.write_bytes(content)
        with pytest.raises(InputError, match=r"'.*run\.nc' must"):
            coarse.load(path)


def test_snapshots_are_kept_at_their_times(coarse, resting):
    run = coarse.simulate(resting, duration=1.0, W=1.0, load=0.8, snapshots=(0.4, 0.7))
    assert [state.t for state in run.snapshots] == pytest.approx([0.4, 0.7])
    assert run.snapshots[0].delta == pytest.approx(np.interp(0.4, run.time, run.delta), abs=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"V": 0.0}, r"V must be finite and positive, got 0\.0"),
        ({"Q0": np.nan}, "Q0 must be finite and positive, got nan"),
        ({"scheme": "upwind"}, "scheme must be a ContactScheme, got 'upwind'"),
        ({"density": 1.0}, r"density must be a DowsonHigginsonDensity or None, got 1\.0"),
    ],
)
def test_contact_names_the_broken_rule(change, message):
    with pytest.raises(InputError, match=message):
        PointContact(**{"V": 0.1, "Q0": 5.0, **change})


def test_runs_name_the_broken_rule(coarse, resting):
    with pytest.raises(InputError, match=r"W must be finite and not negative, got -1\.0"):
        coarse.simulate(resting, duration=1.0, W=-1.0)
    with pytest.raises(InputError, match="load must be finite at every time, got nan at t = "):
        coarse.simulate(resting, duration=1.0, W=1.0, load=lambda t: np.nan)
    with pytest.raises(InputError, match="start must be a ContactState on ContactGrid"):
        contact(16).simulate(resting, duration=1.0, W=1.0)
    with pytest.raises(InputError, match="delta must leave a film everywhere, got -9"):
        coarse.state(resting.pressure, -9.0)
