"""Arguments of the wrong kind name themselves, in every public function."""

import inspect

import pytest

import rotorfilm as rf
from rotorfilm import InputError
from rotorfilm.core import units_of
from rotorfilm.core.inputs import is_object, kinds_of

from .public_objects import PUBLIC

FILM = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
ROTOR = rf.RigidShaft(
    mass=10.0, diametral_inertia=0.2, polar_inertia=0.1, stations=(("a", -0.1), ("b", 0.1)), speed=9.0
)
FUNCTIONS = [one for one in PUBLIC.values() if inspect.isfunction(one)]
CHECKED = [
    (one, name)
    for one in FUNCTIONS
    for name, kind in kinds_of(inspect.unwrap(one)).items()
    if is_object(kind)
]


@pytest.mark.parametrize(("function", "name"), CHECKED)
def test_every_argument_of_a_class_is_checked(function, name):
    with pytest.raises(InputError, match=rf"^{name} must be .*, got <object object"):
        function(**{name: object()})


def test_the_public_functions_are_among_them():
    known = {one.__name__ for one, _ in CHECKED}
    assert {
        "campbell",
        "equilibrium",
        "coefficients",
        "simulate",
        "mount",
        "linearize",
        "closed_loop",
    } <= known
    assert len(CHECKED) > 40


def test_every_public_function_with_units_takes_quantities():
    bare = {one.__name__ for one in FUNCTIONS if units_of(one) and not hasattr(one, "__wrapped__")}
    assert not bare


def test_a_film_without_a_name_is_no_mapping():
    for function in (rf.campbell, rf.critical_speeds, rf.rotor_threshold):
        with pytest.raises(
            InputError,
            match=r"^bearings must be a mapping such as \{'left': film\}, got J",
        ):
            function(ROTOR, FILM, [10.0, 20.0])


def test_a_wrong_bearing_of_a_mapping_is_named():
    with pytest.raises(
        InputError, match=r"^bearings\['b'\] must be a Reaction such as .* got .film. without"
    ):
        rf.campbell(ROTOR, {"a": FILM, "b": "film"}, [10.0, 20.0])


def test_a_class_is_no_object():
    with pytest.raises(InputError, match=r"^reaction must be a Reaction such as .*, got <class"):
        rf.equilibrium(rf.JournalBearing, (0.0, -500.0), 100.0)


def test_unions_name_all():
    with pytest.raises(InputError, match=r"^at must be an OperatingPoint or an Equilibrium, got 3.0"):
        rf.linearize(FILM, 3.0)


def test_members_of_an_object_alone_count():
    class Own:
        """A film of functions."""

        inputs, outputs, states = FILM.inputs, FILM.outputs, FILM.states

        def __init__(self):
            self.clearance = FILM.clearance
            self.force, self.jacobian = FILM.force, FILM.jacobian
            self.output, self.linearization = FILM.output, FILM.linearization

    found = rf.equilibrium(Own(), (0.0, -500.0), 100.0)
    assert found.position == pytest.approx(rf.equilibrium(FILM, (0.0, -500.0), 100.0).position, rel=1e-9)
