"""Running FMUs in fmpy, and a user's own model in a module of its own."""

import importlib
import sys

import fmpy
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

PROPORTIONAL = '''
"""A user's model."""

from __future__ import annotations

import numpy as np
from dataclasses import dataclass

from rotorfilm.model import Linearization, static_linearization
from rotorfilm.signals import Signal

GAIN = 2.0


@dataclass(frozen=True)
class Proportional:
    """Output = GAIN * input."""

    offset: object = 0.0
    inputs = (Signal(name="a", unit="m", nominal=1e-3, description="input"),)
    outputs = (Signal(name="b", unit="N", nominal=2.0, description="output"),)
    states = ()

    def output(self, t, x, u):
        return np.array([GAIN * u[0]])

    def linearization(self, t, x, u) -> Linearization:
        return static_linearization(np.array([[GAIN]]))
'''


@pytest.fixture
def own_source():
    """Return the source of a module with the model Proportional."""
    return PROPORTIONAL


@pytest.fixture
def write_module(tmp_path, monkeypatch):
    """Return a function that writes a module and imports it."""
    monkeypatch.syspath_prepend(str(tmp_path))
    # A module written twice within a second would be read from the bytecode of the first.
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    written = []

    def write(name, text=PROPORTIONAL):
        (tmp_path / f"{name}.py").write_text(text)
        written.append(name)
        sys.modules.pop(name, None)
        importlib.invalidate_caches()
        return importlib.import_module(name)

    yield write
    for name in written:
        sys.modules.pop(name, None)


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
