"""What a film law may have besides force and jacobian: named in one place, and asked for by no other way."""

import ast
from pathlib import Path

import numpy as np
import pytest

import rotorfilm
from rotorfilm import Groove, InputError, ValidityWarning
from rotorfilm.bearings import FilmOptions, options
from rotorfilm.bearings.damper import PorousDamper, ShortSqueeze
from rotorfilm.bearings.damper.squeeze_laws import SqueezeOptions
from rotorfilm.bearings.journal import JournalBearing, ShortFilm
from rotorfilm.core import largest_eccentricity_ratio

DIMENSIONS = {"radius": 0.05, "length": 0.03, "clearance": 1e-4, "viscosity": 0.1}
STATE = [2e-5, -5e-5], [1e-3, 2e-3], -157.08
GROOVE = Groove(center=0.3, width=0.2)


class PlainLaw:
    """A law of a user, with what is required and no more."""

    def force(self, eccentricity, source, slenderness):
        return ShortFilm().force(eccentricity, source, slenderness)

    def jacobian(self, eccentricity, source, slenderness):
        return ShortFilm().jacobian(eccentricity, source, slenderness)


class NarrowLaw(PlainLaw):
    """One that has options without deriving from where they are named."""

    slenderness_range = (0.1, 0.5)
    slenderness_limit = 0.2

    def fitted(self, geometry):
        return NarrowLaw()


class PlainSqueeze:
    def bind(self, case):
        return ShortSqueeze().bind(case)


@pytest.mark.closed_form
def test_a_law_with_what_is_required_is_enough():
    own, ours = JournalBearing(**DIMENSIONS, film=PlainLaw()), JournalBearing(**DIMENSIONS, film=ShortFilm())
    np.testing.assert_allclose(own.force(*STATE), ours.force(*STATE), rtol=1e-12)
    np.testing.assert_allclose(own.jacobian(*STATE), ours.jacobian(*STATE), rtol=1e-11)
    fx, fy, slopes = own.prepare_tangent()(*STATE[0], *STATE[1], STATE[2])
    assert own.prepare()(*STATE[0], *STATE[1], STATE[2]) == (fx, fy)
    np.testing.assert_allclose(slopes, ours.jacobian(*STATE).ravel(), rtol=1e-11)
    assert own.native() is None
    assert own.portable() is own


def test_a_law_without_openings_says_so():
    with pytest.raises(InputError, match="got PlainLaw, which cannot"):
        JournalBearing(**DIMENSIONS, film=PlainLaw(), grooves=(GROOVE,))


def test_a_law_may_have_options_under_their_names():
    with pytest.warns(ValidityWarning, match=r"must not exceed 0\.2"):
        bearing = JournalBearing(**DIMENSIONS, film=NarrowLaw(), grooves=(GROOVE,))
    assert isinstance(bearing.fitted_film, NarrowLaw)
    with pytest.raises(InputError, match=r"must be 0\.1 to 0\.5 for NarrowLaw, got 1"):
        JournalBearing(**DIMENSIONS | {"length": 0.1}, film=NarrowLaw())


def test_a_squeeze_law_with_what_is_required_is_enough():
    dimensions = DIMENSIONS | {"length": 0.02}
    own, ours = PorousDamper(**dimensions, film=PlainSqueeze()), PorousDamper(**dimensions)
    np.testing.assert_array_equal(own.force(*STATE), ours.force(*STATE))
    assert own.largest_eccentricity_ratio == 1.0
    assert own.portable() is own


def test_options_of_a_law_that_derives_are_its_own():
    assert options(ShortFilm(), FilmOptions) == ShortFilm()
    assert options(ShortSqueeze(), SqueezeOptions).slenderness_limit == 0.25


def test_a_reaction_that_does_not_say_is_meant_up_to_the_wall():
    assert largest_eccentricity_ratio(JournalBearing(**DIMENSIONS)) == 1.0


@pytest.mark.long
def test_no_option_is_asked_for_by_its_name():
    named = {name for kind in (FilmOptions, SqueezeOptions) for name in vars(kind) if name[0] != "_"}
    assert {"fitted", "largest_eccentricity_ratio"} <= named
    named |= {"breakpoints", "prepare_tangent", "prepare"}
    found = []  # outside of the core, which asks for the optional parts of a reaction in one place
    for path in sorted(Path(rotorfilm.__file__).parent.rglob("*.py")):
        if path.parent.name == "core":
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) in ("getattr", "hasattr"):
                asked = node.args[1]
                if isinstance(asked, ast.Constant) and asked.value in named:
                    found.append(f"{path.name}:{node.lineno}: {ast.unparse(node)}")
    assert not found
