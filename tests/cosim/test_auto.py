"""The cheapest scheme that is stable and accurate enough, and why."""

import numpy as np
import pytest

from rotorfilm import InputError
from rotorfilm.analysis import simulate
from rotorfilm.cosim import Auto, GaussSeidel, Newton, SIExp3, cosimulate
from rotorfilm.fmu import export_fmu
from rotorfilm.studies.coupling_cost import cost_case, limit_case, nudged

SPEED = 157.0


@pytest.mark.parametrize(
    ("degrees", "tolerance", "expected"),
    [
        (0.5, 3e-2, "Gauss-Seidel 0"),
        (0.5, 1e-3, "Gauss-Seidel 1"),
        (0.5, 1e-6, "SI-exp3"),
        (5.0, 1e-2, "SI-exp3"),
    ],
)
def test_the_cheapest_scheme_that_will_do_is_taken(degrees, tolerance, expected):
    rotor, bearing = cost_case()
    step = np.radians(degrees) / SPEED
    found = cosimulate(
        rotor, bearing, macro_step=step, duration=np.pi / SPEED, scheme=Auto(tolerance=tolerance)
    )
    assert found.scheme.label == expected
    assert found.choice.scheme == found.scheme
    *others, taken = found.choice.trials
    assert taken.reason.startswith("stable, an error of")
    assert all(trial.reason.startswith(("not accurate", "unstable", "macro_step")) for trial in others)
    own = found.trajectory
    exact = simulate(rotor, bearing, duration=own.time[-1], times=own.time, rtol=1e-9)
    extent = np.abs(exact.position).max()
    assert np.abs(own.position - exact.position).max() < 1.5 * tolerance * extent


@pytest.mark.long
def test_auto_is_the_word_for_it_and_takes_what_fmus_can_do(tmp_path):
    rotor, bearing = cost_case()
    film = export_fmu(bearing, tmp_path / "film.fmu")
    step = np.radians(5.0) / SPEED
    found = cosimulate(
        export_fmu(rotor, tmp_path / "rotor.fmu"), film, macro_step=step, duration=30 * step, scheme="auto"
    )
    assert found.scheme == SIExp3()
    python = export_fmu(rotor, tmp_path / "python.fmu", backend="python")
    # Without Model Exchange and force laws, and without FMU states of a film: what is left is refused.
    blind = export_fmu(bearing, tmp_path / "blind.fmu", backend="python")
    with pytest.raises(InputError, match=r"macro_step must be short enough.*SI-exp3: film must tell its"):
        cosimulate(python, blind, macro_step=step, duration=30 * step, scheme=Auto(tolerance=1e-3))


def test_an_unstable_scheme_is_refused_for_that_reason():
    rotor, bearing, _ = limit_case(0.9)
    moved = nudged(rotor, 1e-4 * bearing.clearance)
    step = 1.3 * np.radians(10.1) / SPEED
    found = cosimulate(moved, bearing, macro_step=step, duration=60 * step, scheme=Auto(tolerance=0.1))
    first = found.choice.trials[0]
    assert first.scheme.label == "Gauss-Seidel 0"
    assert first.reason.startswith("unstable: ")
    assert found.scheme not in (Newton(),)


def test_film_calls_count_derivatives_where_the_scheme_asks_for_them():
    rotor, bearing = cost_case()
    step, calls = np.radians(2.0) / SPEED, {}
    for scheme in (GaussSeidel(), SIExp3()):
        calls[scheme.label] = cosimulate(
            rotor, bearing, macro_step=step, duration=10 * step, scheme=scheme
        ).film_calls
    # one film call at each of the eleven points, and the derivatives of a linearly implicit scheme
    assert calls == {"Gauss-Seidel 0": 11, "SI-exp3": 22}
