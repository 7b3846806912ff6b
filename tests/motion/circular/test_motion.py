"""Motion in eccentricity and phase against the Cartesian equations."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from rotorfilm import InputError, simulate
from rotorfilm.analysis import cartesian_state, polar_acceleration, polar_series, transmitted_ratio


@settings(deadline=None, max_examples=25)
@given(
    eps=st.floats(0.05, 0.9),
    phi=st.floats(-3.0, 3.0),
    eps_rate=st.floats(-200, 200),
    phi_rate=st.floats(-500, 500),
)
def test_polar_equations_are_the_cartesian_ones(support, rotor, eps, phi, eps_rate, phi_rate):
    shaft, film, t = rotor(0.4), support(0.12, 0.4, 0.001), 0.0123
    polar = np.array([eps, phi, eps_rate, phi_rate])
    state = cartesian_state(tuple(polar), film.clearance)
    force = film.force(state[:2], state[2:], 400.0)
    ax, ay = shaft.derivative(t, state, force)[2:] / film.clearance
    eps2, phi2 = polar_acceleration(shaft, film, t, polar)
    # x'' of eps exp(i phi), differentiated twice by hand
    both = (eps2 - eps * phi_rate**2 + 1j * (eps * phi2 + 2.0 * eps_rate * phi_rate)) * np.exp(1j * phi)
    assert_allclose([both.real, both.imag], [ax, ay], atol=1e-9 * (1e5 + abs(both)))


@pytest.mark.long
def test_transient_of_the_paper_in_both_coordinates(support, rotor):
    # Figure 4: Bs = 2 B = 0.24 if L/D = 1/2, U = .4, Omega_s = .4, eps(0) = .6, beta(0) = -2.8 rad, at rest
    # in turning axes.
    shaft, film = rotor(0.4), support(0.24, 0.4)
    start = (0.6, -2.8, 0.0, 400.0)
    run = simulate(shaft, film, duration=0.05, initial_state=cartesian_state(start, film.clearance))

    def rates(t, z):
        return [z[2], z[3], *polar_acceleration(shaft, film, t, z)]

    polar = solve_ivp(rates, (0.0, 0.05), start, method="Radau", rtol=1e-8, atol=1e-8, t_eval=run.time)
    eps, phase = polar_series(run, shaft, film.clearance)
    assert_allclose(eps, polar.y[0], atol=2e-5)
    turned = np.angle(np.exp(1j * (polar.y[1] - 400.0 * run.time - phase)))
    assert_allclose(turned, 0.0, atol=1e-3)
    ratio = transmitted_ratio(run, shaft)
    assert ratio.shape == run.time.shape
    assert ratio[0] > 1.0


@pytest.mark.closed_form
def test_axes_of_the_phase():
    state = cartesian_state((0.5, np.pi / 2, 2.0, 3.0), 1e-4)
    assert_allclose(state, [0.0, 0.5e-4, -1.5e-4, 2e-4], atol=1e-18)


def test_what_has_no_answer_is_refused(support, rotor):
    film = support(0.12, 0.4)
    with pytest.raises(
        InputError, match=r"eccentricity ratio must be positive in polar coordinates, got 0.0"
    ):
        polar_acceleration(rotor(0.4), film, 0.0, np.zeros(4))
    run = simulate(rotor(0.0), film, duration=1e-3, samples=3, initial_state=[1e-5, 0.0, 0.0, 0.0])
    with pytest.raises(InputError, match="rotor must have an unbalance"):
        transmitted_ratio(run, rotor(0.0))
