"""What a film does along a given motion: its force and its derivatives, that of its mass included."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import rotorfilm as rf
from rotorfilm.analysis.equal_steps import ExcitedRotor, StatesAlong
from rotorfilm.bearings import JudgedDamper
from rotorfilm.core.port import force_along
from rotorfilm.scenes.film_rungs import counted_calls

SPEED = 300.0
SIZE = {"radius": 63.5e-3, "length": 25.4e-3, "clearance": 0.127e-3, "viscosity": 2.5e-3}
DAMPER = rf.SqueezeFilmDamper(**SIZE, density=800.0, extent=rf.FullFilm())
SEAL = rf.AnnularSeal(
    **{"radius": 0.05, "length": 0.02, "clearance": 2e-4, "pressure_drop": 1e6},
    **{"viscosity": 1e-3, "density": 1000.0, "inlet_loss": 0.2},
)
FILMS = {
    "damper": DAMPER,
    "sprung": rf.with_springs(DAMPER, 1e6),
    "counted": counted_calls(DAMPER),
    "seal": SEAL,
    "sprung seal": rf.with_springs(SEAL, 1e6),
    "damper and seal": rf.Parallel((DAMPER, SEAL)),
}


def states(count=4):
    rng, c = np.random.default_rng(2), SIZE["clearance"]
    sizes = (0.4 * c, 100.0 * c, 3e4 * c)
    return StatesAlong(*(rng.uniform(-one, one, (2, count)) for one in sizes), 1e-4)


def rotor(film):
    return ExcitedRotor(film, 3.0, SPEED, np.zeros(2), lambda t: np.zeros(2))


@pytest.mark.closed_form
@pytest.mark.parametrize("name", FILMS)
def test_force_along_a_motion_is_that_of_the_outputs(name):
    """F(q, v, speed) - M(q, v, speed) a, of the six outputs that a simulator sees."""
    film, at = FILMS[name], states()
    found = rotor(film).tangents(film, at)
    for n, a in enumerate(at.acceleration.T):
        u = [*at.position[:, n], *at.velocity[:, n], SPEED]
        x, y, xx, xy, yy = film.output(0.0, [], u)
        expected = [x - xx * a[0] - xy * a[1], y - xy * a[0] - yy * a[1]]
        assert_allclose(found.force[:, n], expected, rtol=1e-9)


@pytest.mark.convergence
@pytest.mark.parametrize("name", FILMS)
def test_tangents_are_the_slopes_of_the_force(name):
    film, at = FILMS[name], states()
    rotor_on_it, c = rotor(film), SIZE["clearance"]
    found = rotor_on_it.tangents(film, at)
    for field, scale in (("position", c), ("velocity", 100.0 * c), ("acceleration", 3e4 * c)):
        exact = {"position": found.stiffness, "velocity": found.damping, "acceleration": found.mass}[field]
        for k, axis in enumerate(np.eye(2)):
            shift = 1e-5 * scale * axis[:, None]
            up, down = (at._replace(**{field: getattr(at, field) + s * shift}) for s in (1, -1))
            change = rotor_on_it.tangents(film, up).force - rotor_on_it.tangents(film, down).force
            assert_allclose(-change / (2e-5 * scale), exact[:, k], atol=1e-6 * np.abs(exact).max())


def test_a_judged_damper_has_the_mass_of_its_damper():
    judged, at = JudgedDamper(damper=DAMPER, frequency=SPEED), states()
    q, v = at.position, at.velocity
    assert_allclose(judged.mass(q, v, SPEED), DAMPER.mass(q, v), rtol=0.0)
    assert judged.mass_slopes(q, v, SPEED).shape == (2, 2, 5, 4)
    left = judged.left_out(q, v, at.acceleration)
    found, own = (force_along(film, q, v, at.acceleration, SPEED) for film in (judged, DAMPER))
    assert_allclose(found, own + left, rtol=1e-12)
