"""Reactions answer with finite numbers or say which state is beyond them: never with infinity in silence."""

import warnings

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm import InputError, RotorfilmError, ValidityWarning
from rotorfilm.bearings.reaction import single_state

FILM = {"radius": 0.05, "length": 0.02, "clearance": 1e-4, "viscosity": 4e-4}
SEAL = {**FILM, "pressure_drop": 1e6, "density": 1000.0}
PADS = {"radius": 0.05, "length": 0.03, "pad_clearance": 1e-4, "viscosity": 0.1}
REACTIONS = [
    rf.AnnularSeal(**SEAL),
    rf.JournalBearing(**FILM),
    rf.LobedBearing(**PADS, lobes=rf.lobe_set("elliptical")),
    rf.SqueezeFilmDamper(**FILM, density=850.0),
    rf.PorousDamper(**FILM, cage=rf.PorousCage(thickness=2.5e-3, permeability=4e-13)),
    rf.with_springs(rf.LinearBearing(stiffness=1e6), 2e6),
    rf.LinearBearing(stiffness=1e6, damping=100.0),
    rf.TabulatedBearing(speeds=[0.0, 1e308], stiffness=1e6 * np.ones((2, 2, 2)), damping=np.ones((2, 2, 2))),
    rf.RubRing(gap=2e-4, stiffness=1e7, radius=0.05, friction_coefficient=0.1),
    rf.bearings.PalmgrenBalls(balls=8, ball_diameter=8e-3, damping=10.0),
]
PLACE = np.array([1e-5, 2e-5])
EXTREME = {
    "speed": (PLACE, np.zeros(2), 1e308),
    "backward": (PLACE, np.zeros(2), -1e160),
    "velocity": (PLACE, np.array([1e308, -1e308]), 100.0),
    "fast": (PLACE, np.array([1e200, 0.0]), 100.0),
    "place": (np.array([1e308, 1e308]), np.zeros(2), 100.0),
    "all": (PLACE, np.array([1e308, 1e308]), 1e308),
    "batch": (np.stack([PLACE, PLACE], axis=1), np.array([[0.0, 1e308], [0.0, 1e308]]), 100.0),
}


METHODS = [
    pytest.param(one, method, id=f"{type(one).__name__}-{method}")
    for one in REACTIONS
    for method in ("force", "jacobian", "losses", "mass")
    if hasattr(one, method)
]


@pytest.mark.parametrize("state", EXTREME)
@pytest.mark.parametrize(("reaction", "method"), METHODS)
def test_an_answer_is_finite_or_an_error(reaction, method, state):
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore", ValidityWarning)
        try:
            found = getattr(reaction, method)(*EXTREME[state])
        except RotorfilmError:
            return
    assert np.isfinite(found.power_loss if method == "losses" else found).all()


@pytest.mark.parametrize("speed", [1e308, -1e200])
def test_a_seal_names_the_state_that_overflows(speed):
    with pytest.raises(
        InputError, match=r"^position, velocity and speed must be finite and not overflow, got"
    ):
        rf.AnnularSeal(**SEAL).force([1e-5, 0.0], [0.0, 0.0], speed)


@pytest.mark.parametrize(
    "bearing", [rf.JournalBearing(**FILM), rf.LobedBearing(**PADS, lobes=rf.lobe_set("elliptical"))]
)
def test_losses_name_the_state_that_overflows(bearing):
    with (
        np.errstate(all="ignore"),
        pytest.raises(
            InputError,
            match=r"^position, velocity and speed must be finite and not overflow, got .* and 1e\+160 rad/s",
        ),
    ):
        bearing.losses(PLACE, np.zeros(2), 1e160)


@pytest.mark.parametrize("name", ["pressure_drop", "viscosity", "density"])
def test_a_seal_of_an_absurd_size_is_refused(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        with pytest.raises(InputError, match=rf"^{name} must be at most 1e\+150 in size, got 1e\+308"):
            rf.AnnularSeal(**{**SEAL, name: 1e308})


def test_a_film_law_in_python_does_not_overflow_in_silence():
    film = rf.JournalBearing(**FILM, film=rf.SplittingFilm(order=(2, 1)))
    with pytest.raises(InputError, match="must be finite and not overflow"):
        film.force([1e-5, 0.0], [1e306, 0.0], 100.0)


def test_springs_take_the_arguments_of_every_reaction():
    spring = rf.LinearBearing(stiffness=1e6, damping=10.0)
    with pytest.raises(InputError, match="speed must be finite"):
        spring.force([1e-5, 0.0], [0.0, 0.0], np.nan)
    with pytest.raises(InputError, match="must broadcast"):
        spring.force(np.zeros((2, 2)), np.zeros((2, 3)), 1.0)
    assert spring.force([1e-5, 0.0], [0.0, 0.0], np.ones(4)).shape == (2, 4)


@pytest.mark.parametrize("kind", [list, tuple, np.array, lambda pair: np.array(pair, dtype=object)])
def test_a_single_state_has_the_force_of_a_batch_whatever_holds_it(kind):
    bearing = rf.JournalBearing(**FILM)
    batch = bearing.force([[1e-5], [-2e-5]], [[1.0], [0.0]], [300.0])
    assert np.array_equal(bearing.force(kind([1e-5, -2e-5]), kind([1, 0]), 300), batch[:, 0])
    assert single_state(kind([1e-5, -2e-5]), kind([1, 0]), 300) is not None


@pytest.mark.parametrize("bad", [True, np.nan, np.inf, 10**400, 1j, None])
@pytest.mark.parametrize("place", range(5))
def test_a_single_state_of_other_things_than_finite_numbers_is_refused(bad, place):
    state = [1e-5, 2e-5, 0.0, 0.0, 300.0]
    state[place] = bad
    with pytest.raises(InputError):
        rf.JournalBearing(**FILM).force(state[:2], state[2:4], state[4])
