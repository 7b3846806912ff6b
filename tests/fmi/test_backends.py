"""What every FMU does, whatever runs inside it: each backend and FMI version, each model, both interfaces."""

from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import control
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from rotorfilm import FmuError, JournalBearing
from rotorfilm.bearings.journal import MapFilm, ShortFilm
from rotorfilm.fmu import export_fmu, extracted, from_state_space, instantiated
from rotorfilm.rotors import RigidRotor, SpeedProfile

BEARING = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1, film=MapFilm())
ROTOR = RigidRotor(
    mass=50.0, speed=157.0, unbalance=8e-4, unbalance_angle=0.3, position=(1e-5, -2e-5), velocity=(1e-3, 2e-3)
)
RUN_UP = replace(ROTOR, speed=SpeedProfile(times=(0.0, 0.01, 0.03), speeds=(40.0, 160.0, 120.0)))
PLANT = control.ss(
    [[0.0, 1.0], [-400.0, -2.0]], [[0.0], [1.0]], [[1.0, 0.0], [0.0, 1.0]], [[0.0], [0.5]], inputs=["u"]
)
SHORT = replace(BEARING, film=ShortFilm())
MODELS = {"film": BEARING, "short": SHORT, "rotor": ROTOR, "run_up": RUN_UP, "plant": PLANT}
KINDS = [("native", "2.0", False), ("native", "2.0", True), ("native", "3.0", False), ("native", "3.0", True)]
KINDS.append(("python", "2.0", False))


@dataclass
class Case:
    """One model in one FMU: the model as Python has it, and how to make an instance."""

    model: Any
    description: Any
    folder: str
    exchange: bool
    opened: list

    def instance(self):
        made = instantiated(self.description, self.folder, self.exchange)
        self.opened.append(made)
        return made

    def references(self, causality):
        return [v.valueReference for v in self.description.modelVariables if v.causality == causality]

    def started(self, values=None):
        inputs = self.references("input")
        instance = self.instance()
        instance.initialize(inputs, [0.0] * len(inputs) if values is None else list(values))
        return instance


def _name(kind):
    backend, version, exchange = kind
    return f"{backend}-{version}-{'exchange' if exchange else 'steps'}"


@pytest.fixture(params=KINDS, ids=_name)
def kind(request):
    return request.param


@pytest.fixture(scope="module")
def open_fmu(tmp_path_factory):
    """Return a function that exports and extracts a model, each once: description and folder."""
    with ExitStack() as held:

        @cache
        def open_one(name, version, backend):
            path = tmp_path_factory.mktemp("fmus") / f"{name}.fmu"
            export_fmu(MODELS[name], path, version, backend, component="part")
            return held.enter_context(extracted(path))

        yield open_one


@pytest.fixture
def open_case(kind, open_fmu):
    """Return a function that opens a model; the instances it makes are freed at the end."""
    backend, version, exchange = kind
    opened = []

    def open_one(name):
        model = MODELS[name]
        description, folder = open_fmu(name, version, backend)
        subject = from_state_space(model) if name == "plant" else model
        return Case(subject, description, folder, exchange, opened)

    yield open_one
    for instance in opened:
        # A failed instance of PythonFMU does not terminate.
        with suppress(FMICallException):
            instance.close()


@pytest.fixture(params=MODELS)
def case(request, open_case):
    return open_case(request.param)


def sample(model, generator):
    """Return inputs at which the model has outputs."""
    scale = np.array([signal.nominal for signal in model.inputs])
    return 0.5 * scale * generator.uniform(-1.0, 1.0, len(scale))


def state_of(model):
    return getattr(model, "initial_state", np.zeros(0))


def error(call, *arguments):
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    return caught.value.status


def test_outputs_at_the_start_are_those_of_the_model(case):
    generator = np.random.default_rng(5)
    for _ in range(4):
        values = sample(case.model, generator)
        found = case.started(values).get(case.references("output"))
        np.testing.assert_allclose(
            found, case.model.output(0.0, state_of(case.model), values), rtol=1e-12, atol=1e-15
        )


def test_outputs_follow_the_inputs_without_a_step(case):
    generator = np.random.default_rng(6)
    instance = case.started()
    for _ in range(4):
        values = sample(case.model, generator)
        instance.set(case.references("input"), values.tolist())
        expected = case.model.output(0.0, state_of(case.model), values)
        np.testing.assert_allclose(instance.get(case.references("output")), expected, rtol=1e-12, atol=1e-15)


def test_a_wrong_value_reference_is_an_error(case):
    instance = case.started()
    assert error(instance.get, [4_000_000]) >= 3
    assert instance.log


def test_an_output_cannot_be_set(case):
    instance = case.started()
    assert error(instance.set, case.references("output")[:1], [1.0]) >= 3
    assert instance.log


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_finite_is_an_error(case, value):
    instance = case.started()
    assert error(instance.set, case.references("input")[:1], [value]) >= 3
    assert instance.log


def test_an_instance_can_be_reset(case):
    values = sample(case.model, np.random.default_rng(7))
    inputs, outputs = case.references("input"), case.references("output")
    instance = case.started(values)
    first = instance.get(outputs)
    error(instance.set, inputs[:1], [np.nan])
    instance.reset()
    instance.initialize(inputs, values.tolist())
    assert instance.get(outputs) == first


def test_two_instances_share_nothing(case):
    generator = np.random.default_rng(8)
    values = [sample(case.model, generator) for _ in range(2)]
    outputs = case.references("output")
    alone = [case.started(value).get(outputs) for value in values]
    instances = [case.started(value) for value in values]
    assert [instance.get(outputs) for instance in instances] == alone
    with suppress(FMICallException):
        instances[0].set(outputs[:1], [1.0])
    assert instances[1].get(outputs) == alone[1]


def test_the_wall_is_an_error_whose_values_are_in_the_log(open_case, kind):
    case = open_case("film")
    instance = case.started([3e-5, -4e-5, 0.0, 0.0, 157.0])
    instance.set(case.references("input")[:1], [1.2e-4])
    # While an integrator tries states, FMI has Discard for those where there is no answer.
    assert error(instance.get, case.references("output")) >= (2 if kind[2] else 3)
    assert "inside the clearance" in " ".join(instance.log)
    assert "0.00012" in " ".join(instance.log)


def test_a_start_at_the_wall_is_an_error(open_case):
    case = open_case("film")
    assert error(case.started, [0.0, -1e-4, 0.0, 0.0, 157.0]) >= 3


def test_the_token_is_checked(open_case, kind):
    if kind[0] == "python":
        pytest.skip("PythonFMU does not check the guid")
    case = open_case("film")
    case.description.guid = "another"
    with pytest.raises(FmuError, match="cannot be instantiated"):
        case.instance()
