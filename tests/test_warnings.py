"""Our own warnings fail the tests, those of other packages do not, and users see only ours."""

import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import control.statesp
import numpy as np
import pytest

from rotorfilm import LinearBearing, Scene, ValidityWarning, bundled_scene, linearize
from rotorfilm.analysis import OperatingPoint, to_nlsys
from rotorfilm.core.errors import UnloadedPadWarning, silencing, warn_user


def deprecated(module):
    warnings.warn_explicit("this will go", DeprecationWarning, "file.py", 1, module=module)


MODULES = ["rotorfilm.bearings.journal.map_film", __name__, "scene_battery", "fmu_recipe_bush"]


@pytest.mark.parametrize("module", MODULES)
def test_what_our_own_modules_cause_is_an_error(module):
    with pytest.raises(DeprecationWarning):
        deprecated(module)


@pytest.mark.parametrize("module", ["control.statesp", "numpy", "fmu_manipulation_toolbox.gui"])
def test_what_other_packages_cause_is_none(module):
    with warnings.catch_warnings(record=True) as caught:
        deprecated(module)
    assert all(one.category is DeprecationWarning for one in caught)


def test_a_limit_of_a_model_is_an_error_wherever_it_shows():
    with pytest.raises(ValidityWarning):
        warnings.warn_explicit("beyond its range", ValidityWarning, "file.py", 1, module="concurrent.futures")


@pytest.fixture
def deprecating(monkeypatch):
    """Let python-control warn of each matrix of a system, and every warning be an error."""
    given = control.statesp._ssmatrix

    def matrix(*arguments, **options):
        deprecated("control.statesp")
        return given(*arguments, **options)

    monkeypatch.setattr(control.statesp, "_ssmatrix", matrix)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def test_nobody_sees_what_python_control_is_warned_of(deprecating):
    with pytest.raises(DeprecationWarning):
        control.StateSpace([], [], [], np.eye(2))
    film = LinearBearing(stiffness=1e6, damping=1e3)
    system = linearize(film, OperatingPoint(u=np.zeros(5)))
    assert system.nstates == 0
    np.testing.assert_array_equal(to_nlsys(film).linearize([], np.zeros(5)).D, system.D)


def test_the_command_line_shows_our_warnings_only(run, monkeypatch):
    def describe(scene):
        warnings.warn("theirs", UserWarning, stacklevel=1)
        warnings.warn("ours", ValidityWarning, stacklevel=1)
        return answer

    answer = bundled_scene().describe()
    monkeypatch.setattr(Scene, "describe", describe)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        code, _, shown = run("solve", Path(__file__).parents[1] / "examples" / "friswell.toml")
    assert code == 0
    assert "ours" in shown
    assert "theirs" not in shown


def test_a_silenced_category_is_given_in_other_threads():
    with ThreadPoolExecutor(1) as pool, silencing(UnloadedPadWarning):
        with warnings.catch_warnings(action="error"):
            warn_user("here", UnloadedPadWarning)
        with pytest.warns(UnloadedPadWarning, match="there"):
            pool.submit(warn_user, "there", UnloadedPadWarning).result()
