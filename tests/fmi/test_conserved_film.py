"""The film that conserves its oil as an FMU: its steps, its oil saved, restored, resumed."""

import fmpy
import numpy as np
import pytest
from fmpy.validation import validate_fmu

from rotorfilm import Groove, JFOFilm, JournalBearing, export_fmu
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import check_fmu

OMEGA, STEP = 314.0, 1e-4
TOP = Groove(center=np.pi / 2, width=np.radians(20.0), length=0.04)
FILM = JFOFilm(
    bearing=JournalBearing(
        radius=0.05, length=0.05, clearance=1e-4, viscosity=0.02, grooves=(TOP,), supply_pressure=2e5
    ),
    cells=(24, 4),
)


def motion(k):
    """Return the motion of the journal after k steps."""
    phase = 0.5 * OMEGA * k * STEP
    place, rate = 2e-5 * np.array([1.0 - np.cos(phase), np.sin(phase)]), 2e-5 * 0.5 * OMEGA
    x, y = np.array([3e-5, -4e-5]) + place
    return dict(x=x, y=y, vx=rate * np.sin(phase), vy=rate * np.cos(phase), speed=OMEGA)


def values(answer):
    return np.array([answer[signal.name] for signal in FILM.outputs])


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    return export_fmu(FILM, tmp_path_factory.mktemp("jfo") / "film.fmu", component="film", start=motion(0))


def test_the_file_is_valid_and_passes_the_checks(film):
    assert validate_fmu(str(film)) == []
    assert [item for item in check_fmu(film) if item.passed is False] == []
    description = fmpy.read_model_description(str(film))
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate
    assert description.modelExchange is None


def test_steps_are_those_of_the_model_and_go_on_elsewhere(film):
    # A second instance takes the bytes of the first in mid-run, as after the end of a process.
    state, expected = FILM.start(list(motion(0).values())), []
    for k in range(1, 9):
        state, output, _ = FILM.step(state, (k - 1) * STEP, list(motion(k).values()), STEP)
        expected.append(output)
    with open_fmu(film) as fmu, open_fmu(film) as other:
        fmu.start(motion(0))
        other.start(motion(3))
        np.testing.assert_array_equal(values(fmu.get()), FILM.answer(FILM.start(list(motion(0).values()))))
        found = [stepped(fmu, k) for k in range(1, 5)]
        saved = fmu._instance.save()
        content = fmu._instance.serialize(saved)
        found += [stepped(fmu, k) for k in range(5, 9)]
        np.testing.assert_allclose(found, expected, rtol=1e-9)
        fmu._instance.restore(saved)
        again = [stepped(fmu, k) for k in range(5, 9)]
        fmu._instance.release(saved)
        other._instance.restore(other._instance.deserialize(content))
        resumed = [stepped(other, k) for k in range(5, 9)]
    np.testing.assert_array_equal(again, found[4:])
    np.testing.assert_array_equal(resumed, found[4:])


def stepped(fmu, k):
    """Return the outputs of an FMU after its k-th step."""
    fmu.set(motion(k))
    fmu.step((k - 1) * STEP, STEP)
    return values(fmu.get())
