"""Running FMUs in fmpy call by call, with each status and the log as they are."""

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import (
    FMU2Slave,
    calloc,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    free,
)

from rotorfilm import export_fmu
from rotorfilm.fmu import extracted, instantiated

from .journals import FORCES, INPUTS


class Instance:
    """An FMU instance by variable names, with its log."""

    def __init__(self, path, folder):
        self.description = fmpy.read_model_description(str(path))
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.log = []
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._logger)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.fmu = FMU2Slave(
            guid=self.description.guid,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            unzipDirectory=fmpy.extract(str(path), unzipdir=str(folder)),
            instanceName="instance",
        )
        self.fmu.instantiate(callbacks=self.callbacks, loggingOn=True)

    def initialize(self, values=None, time=0.0):
        self.fmu.setupExperiment(startTime=time)
        self.fmu.enterInitializationMode()
        self.set(values or {})
        self.fmu.exitInitializationMode()

    def set(self, values):
        self.fmu.setReal([self.references[name] for name in values], list(values.values()))

    def get(self, *names):
        return self.fmu.getReal([self.references[name] for name in names])

    def _logger(self, environment, instance, status, category, message):
        self.log.append((status, message.decode()))


@pytest.fixture
def load(tmp_path):
    """Return a function that instantiates an FMU; all instances are freed at the end."""
    loaded = []

    def load_one(path):
        loaded.append(Instance(path, tmp_path / f"extracted_{len(loaded)}"))
        return loaded[-1]

    yield load_one
    for instance in loaded:
        instance.fmu.freeInstance()


@pytest.fixture
def opened(tmp_path):
    """Return a function (model, version, exchange) -> (instance, value references by local name)."""
    held = []

    def open_one(model, version, exchange):
        # Its reference trajectory, which nobody looks at here, is short: that of stiff pads takes its time.
        path = export_fmu(model, tmp_path / f"{len(held)}.fmu", version, component="film", stop_time=1e-4)
        context = extracted(path)
        description, folder = context.__enter__()
        held.append((context, instantiated(description, folder, exchange)))
        references = {v.name.removeprefix("film."): v.valueReference for v in description.modelVariables}
        return held[-1][1], references

    yield open_one
    for context, instance in held:
        instance.close(terminate=False)
        context.__exit__(None, None, None)


@pytest.fixture
def same_as_python(opened):
    """Return a function that compares forces of an FMU, to the last bit, and derivatives with its model's."""

    def compare(model, version, exchange, states, rtol):
        instance, reference = opened(model, version, exchange)
        inputs, outputs = [reference[name] for name in INPUTS], [reference[name] for name in FORCES]
        instance.initialize(inputs, states[0].tolist())
        for number, state in enumerate(states):
            if not exchange:
                instance.step(1e-3 * number, 1e-3)
            instance.set(inputs, state.tolist())
            found = np.array(instance.get(outputs))
            np.testing.assert_array_equal(found, model.force(state[:2], state[2:4], state[4]))
            columns = [instance.directional(outputs, [one], [1.0]) for one in inputs]
            expected = model.jacobian(state[:2], state[2:4], state[4])
            np.testing.assert_allclose(np.array(columns).T, expected, rtol=rtol)

    return compare
