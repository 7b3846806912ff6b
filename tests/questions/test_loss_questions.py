"""Questions about power loss and side flow: estimates beside true errors, and who cannot answer."""

from dataclasses import replace

import pytest

from rotorfilm import InputError
from rotorfilm.analysis import equilibrium
from rotorfilm.bearings.journal import MapFilm, ReynoldsFilm
from rotorfilm.scenes import parse_scene

pytestmark = pytest.mark.filterwarnings("ignore::rotorfilm.core.errors.ValidityWarning")

SCENE = """schema = 1
[journal]
radius = 0.05
length = {length}
clearance = 1e-4
viscosity = 0.05
{film}
[operation]
speed = 200.0
load = "{load}"
[question]
quantity = "{quantity}"
tolerance = {tolerance}
"""


def ask(quantity, *, length=0.06, load="3 kN", film="", tolerance=0.02):
    scene = SCENE.format(quantity=quantity, length=length, load=load, film=film, tolerance=tolerance)
    return parse_scene(scene, "losses")


@pytest.mark.parametrize("quantity", ["power_loss", "side_flow"])
@pytest.mark.parametrize(
    ("options", "met"),
    [({}, True), ({"length": 0.004, "load": "20 N"}, True), ({"film": 'film = { name = "short" }'}, False)],
    ids=["map", "slim", "short"],
)
def test_estimate_covers_the_error_against_a_fine_film(quantity, options, met):
    scene = ask(quantity, **options)
    answer = scene.ask()
    fine = replace(scene.bearing, film=ReynoldsFilm(cells=(384, 24)))
    truth = getattr(equilibrium(fine, scene.static_load, scene.speed).losses, quantity)
    error = abs(answer.value / truth - 1.0)
    assert error <= 2.0 * answer.error_estimate + 1e-3
    assert answer.met is met
    assert answer.unit == {"power_loss": "W", "side_flow": "m^3/s"}[quantity]


def test_the_map_answers_with_its_own_losses():
    scene = ask("power_loss")
    at = equilibrium(replace(scene.bearing, film=MapFilm()), scene.static_load, scene.speed)
    assert scene.ask().value == pytest.approx(at.losses.power_loss, rel=1e-9)


def test_a_film_without_losses_cannot_be_asked():
    with pytest.raises(InputError, match=r"film must be a law with losses for side_flow.*got SplittingFilm"):
        ask("side_flow", film='film = { name = "splitting", order = [2, "inf"] }').ask()
