"""Dampers with seals and inertia in C: forces, masses and slopes are those of Python to round-off."""

import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm import InputError
from rotorfilm.analysis.force_calls import call_with_added_mass
from rotorfilm.native.film_call import MASSLESS

SIZE = {"radius": 63.5e-3, "length": 25.4e-3, "clearance": 0.127e-3, "viscosity": 2.5e-3}
FULL = rf.FullFilm()
CASES = {
    "short": {"density": 800.0, "seals": rf.EndSeal(leakage=1e-8)},
    "short, full": {"density": 800.0, "extent": FULL},
    "ruptured": {"film": rf.bearings.MapSqueeze(), "density": 800.0},
    "full": {"film": rf.bearings.MapSqueeze(), "density": 800.0, "extent": FULL},
    "leaking": {"film": rf.bearings.MapSqueeze(), "density": 800.0, "seals": rf.EndSeal(leakage=1e-8)},
    "finite": {"film": rf.FiniteSqueeze(), "density": 800.0, "extent": FULL},
    "sealed": {
        "film": rf.FiniteSqueeze(),
        "density": 800.0,
        "extent": FULL,
        "seals": rf.EndSeal(leakage=1e-10),
    },
    "ruptured, finite": {"film": rf.FiniteMapSqueeze(cells=(10, 20)), "density": 800.0},
    "tight, no inertia": {"film": rf.FiniteSqueeze(), "extent": FULL, "seals": rf.EndSeal(leakage=0.0)},
}


@pytest.mark.parametrize("name", CASES)
def test_kernel_is_the_python_film(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        damper = rf.SqueezeFilmDamper(**SIZE, **CASES[name])
    kernel, rng, c = damper.film_in_c.kernel, np.random.default_rng(3), damper.clearance
    for _ in range(6):
        q, v = rng.uniform(-0.6, 0.6, 2) * c, rng.uniform(-1.0, 1.0, 2) * 300.0 * c
        jacobian = damper.jacobian(q, v, 0.0)
        *force, slopes, status = kernel.tangent(*q, *v, 50.0)
        assert status == 0
        assert_allclose(force, damper.force(q, v), rtol=1e-12, atol=1e-12 * np.abs(force).max())
        assert_allclose(np.reshape(slopes, (2, 5)), jacobian, rtol=1e-11, atol=1e-12 * np.abs(jacobian).max())
        if damper.has_inertia:
            whole = kernel.masses(q[:, None], v[:, None]).values[..., 0]
            mass, by = whole[:, 0], whole[:, 1:]
            right, right_by = damper.mass(q, v), damper.mass_slopes(q, v)
            assert_allclose(mass, right[[0, 0, 1], [0, 1, 1]], atol=1e-13 * np.abs(right).max())
            assert not right_by[:, :, 4].any()  # by the speed
            by_motion = right_by[[0, 0, 1], [0, 1, 1], :4]
            assert_allclose(by, by_motion, atol=1e-12 * np.abs(right_by).max())


def test_inertia_without_a_kernel_is_refused_by_loops_in_c():
    class Own(rf.SqueezeFilmDamper):
        """A damper that may differ."""

    with pytest.raises(InputError, match="reaction must have its added mass in C"):
        call_with_added_mass(Own(**SIZE, density=800.0, extent=FULL))


@pytest.mark.parametrize("stiffness", [1e6, (1e6, 2e6)])
def test_springs_pass_on_where_the_mass_is(stiffness):
    damper = rf.SqueezeFilmDamper(**SIZE, **CASES["finite"])
    call = call_with_added_mass(rf.with_springs(damper, stiffness))
    assert call.mass == call_with_added_mass(damper).mass != MASSLESS
    light = rf.SqueezeFilmDamper(**SIZE, **CASES["tight, no inertia"])
    assert call_with_added_mass(rf.with_springs(light, stiffness)).mass == MASSLESS
    with pytest.raises(InputError, match="reaction must have its added mass in C"):
        call_with_added_mass(rf.Parallel((damper, damper)))
