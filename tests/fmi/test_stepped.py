"""A model with its own integrator as an FMU: outputs at t = 0, its state as bytes, steps that fail."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu

from rotorfilm import ContactGrid, FmuError, InputError, PointContact, export_fmu
from rotorfilm.bearings import MovingContact
from rotorfilm.cosim import open_fmu
from rotorfilm.fmu import check_fmu

MODEL = MovingContact(contact=PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(16, 16))))
STEP = 0.05


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    return export_fmu(
        MODEL, tmp_path_factory.mktemp("film") / "film.fmu", component="film", start={"z": -1.8}
    )


def values(answer):
    return np.array([answer[signal.name] for signal in MODEL.outputs])


@pytest.mark.long
def test_the_file_is_valid_and_passes_the_checks(film):
    assert validate_fmu(str(film)) == []
    assert [item for item in check_fmu(film) if item.passed is False] == []


def test_outputs_depend_on_inputs_during_initialization_only(film):
    description = fmpy.read_model_description(str(film))
    assert [len(unknown.dependencies) for unknown in description.outputs] == [0, 0, 0]
    assert [len(unknown.dependencies) for unknown in description.initialUnknowns] == [1, 1, 1]


def test_steps_are_those_of_the_model_from_the_start_on(film):
    state = MODEL.start([-1.7])
    with open_fmu(film) as fmu:
        fmu.start({"z": -1.7})
        np.testing.assert_array_equal(values(fmu.get()), MODEL.answer(state))
        for k, z in enumerate((-1.72, -1.75, -1.69)):
            fmu.set({"z": z})
            np.testing.assert_array_equal(values(fmu.get()), MODEL.answer(state))  # acts in the step only
            fmu.step(k * STEP, STEP)
            state, output, _ = MODEL.step(state, k * STEP, [z], STEP)
            np.testing.assert_array_equal(values(fmu.get()), output)


def test_a_state_is_restored_to_the_last_bit(film):
    with open_fmu(film) as fmu, open_fmu(film) as other:
        instance = fmu._instance
        for each in (fmu, other):
            each.start({"z": -1.8})
        fmu.set({"z": -1.7})
        fmu.step(0.0, STEP)
        state = instance.save()
        content = instance.serialize(state)
        answers = []
        for again in (lambda: None, lambda: instance.restore(state)):
            again()
            fmu.set({"z": -1.75})
            fmu.step(STEP, STEP)
            answers.append(values(fmu.get()))
        instance.release(state)
        other._instance.restore(other._instance.deserialize(content))
        other.set({"z": -1.75})
        other.step(STEP, STEP)
        answers.append(values(other.get()))
        np.testing.assert_array_equal(answers[0], answers[1])
        np.testing.assert_array_equal(answers[0], answers[2])
        later = content.replace(b'"time": 0.05', b'"time": 0.06')
        assert later != content
        for wrong in (content[:-3], later, b"{}" + content[2:]):
            with pytest.raises(FMICallException):
                other._instance.restore(other._instance.deserialize(wrong))


@pytest.mark.long
def test_a_step_that_fails_is_discarded_and_may_be_tried_again(film):
    with open_fmu(film) as fmu:
        fmu.start({"z": -1.8})
        before = values(fmu.get())
        fmu.set({"z": -1e9})
        with pytest.raises(FmuError, match="discard"):
            fmu.step(0.0, STEP)
        assert any("ConvergenceError" in line for line in fmu._instance.log)
        np.testing.assert_array_equal(values(fmu.get()), before)
        fmu.set({"z": -1.78})
        fmu.step(0.0, STEP)
        expected = MODEL.step(MODEL.start([-1.8]), 0.0, [-1.78], STEP)[1]
        np.testing.assert_array_equal(values(fmu.get()), expected)


def test_export_names_what_cannot_be(tmp_path):
    with pytest.raises(InputError, match="start must be values at which the model has an output"):
        export_fmu(MODEL, tmp_path / "a.fmu", start={"z": -1e9})
    with pytest.raises(FmuError, match="model must have a kernel in the C library"):
        export_fmu(MODEL, tmp_path / "a.fmu", backend="native", start={"z": -1.8})
    with pytest.raises(FmuError, match=r"version must be '2\.0' for the python backend"):
        export_fmu(MODEL, tmp_path / "a.fmu", "3.0", start={"z": -1.8})
