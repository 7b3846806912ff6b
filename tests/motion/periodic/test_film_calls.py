"""Compiled forces behind an address equal those in Python."""

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st

from rotorfilm import JournalBearing, LinearBearing, Parallel, PorousDamper, RubRing, ShortFilm, with_springs
from rotorfilm.analysis.compiled_rotor import JournalFilms
from rotorfilm.analysis.force_calls import film_call
from rotorfilm.bearings import MapSqueeze
from rotorfilm.core.port import compiled_force
from rotorfilm.native import Status
from rotorfilm.native.film_call import FilmCall

SIZES = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
MAP, SHORT = JournalBearing(**SIZES), JournalBearing(**SIZES, film=ShortFilm())
SPRING = LinearBearing(stiffness=((1e6, 2e5), (-3e5, 2e6)), damping=((900.0, 5.0), (7.0, 400.0)))
DAMPER = PorousDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=0.02, film=MapSqueeze())


SIDES = tuple(LinearBearing(stiffness=(1e6,), damping=(800.0,), freedoms=(axis,)) for axis in "xy")
RING = RubRing(gap=2e-4, stiffness=1e7, radius=0.05)


class OwnBearing(JournalBearing):
    """A bearing of a user."""


class CompiledBearing(LinearBearing):
    """One whose user says where its force is in the C library: twice the stiffness."""

    def compiled(self):
        return FilmCall.of_numbers("rf_springs_at", 2.0 * np.ravel([self.stiffness, self.damping]))


BEARINGS = {
    "map": MAP,
    "short": SHORT,
    "linear": SPRING,
    "sprung": with_springs(MAP, 1e6),
    "damper": with_springs(DAMPER, 1e6),
    "beside": Parallel((MAP, SPRING, MAP)),
    "one freedom each": Parallel(SIDES),
    "called back": OwnBearing(**SIZES),
}


def answer(bearing, state):
    call = film_call(bearing)
    films, of = np.array([[call.address], [call.data]], dtype=np.uintp)
    journals = JournalFilms(
        films, of, np.zeros(4), *np.zeros((2, 2)), np.array([1e-4]), np.array([np.inf]), np.zeros(1)
    )
    status, force, slope = journals.forces(state[:4, None], state[4])
    return status, force[:, 0], slope[:, :, 0]


@pytest.mark.parametrize("name", BEARINGS)
@settings(deadline=None, max_examples=60)
@given(
    chi=st.floats(0.0, 0.97),
    angle=st.floats(0.0, 6.3),
    velocity=st.tuples(st.floats(-0.02, 0.02), st.floats(-0.02, 0.02)),
    speed=st.sampled_from([-300.0, 20.0, 157.08]),
)
def test_compiled_force_is_that_of_the_bearing(name, chi, angle, velocity, speed):
    bearing = BEARINGS[name]
    position = 1e-4 * chi * np.array([np.cos(angle), np.sin(angle)])
    state = np.array([*position, *velocity, speed])
    source = (
        state[2:4] / 1e-4 + 0.5 * (name != "damper") * speed * np.array([position[1], -position[0]]) / 1e-4
    )
    assume(np.hypot(*source) >= 1e-3)  # no derivative there
    _, force, slope = answer(bearing, state)
    exact = bearing.force(position, state[2:4], speed)
    slopes = bearing.jacobian(position, state[2:4], speed)[:, :4]
    assert force == pytest.approx(exact, rel=1e-8, abs=1e-8 * np.abs(exact).max())
    size = np.abs(slopes[:, :2]).max(), np.abs(slopes[:, 2:]).max()
    assert slope[:, :2] == pytest.approx(slopes[:, :2], abs=2e-7 * size[0])
    assert slope[:, 2:] == pytest.approx(slopes[:, 2:], abs=2e-7 * size[1])


@pytest.mark.parametrize("name", ["map", "short", "sprung", "damper", "called back"])
def test_wall_is_a_status(name):
    assert answer(BEARINGS[name], np.array([1e-4, 0.0, 0.0, 0.0, 100.0]))[0] == Status.AT_WALL


@pytest.mark.parametrize(
    "bearing", [MAP, SPRING, DAMPER, RING, with_springs(MAP, 1e6), Parallel((MAP, RING))]
)
def test_a_subclass_which_may_differ_is_not_compiled(bearing):
    kind = type(bearing)
    own = object.__new__(type("Own", (kind,), {}))
    vars(own).update(vars(bearing))
    assert compiled_force(bearing) is not None
    assert compiled_force(own) is None


def test_a_subclass_may_say_itself_that_it_is_compiled():
    bearing = CompiledBearing(stiffness=1e6, damping=500.0)
    force = answer(bearing, np.array([1e-5, 2e-5, 1e-3, 2e-3, 0.0]))[1]
    assert force == pytest.approx([-21.0, -42.0], rel=1e-14)
