"""Native FMUs as folders, without their description, and a compiler for C test programs."""

import fcntl
import os
import shutil
import subprocess
from ctypes import c_double
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from fmpy.fmi3 import FMU3Model, FMU3Slave

from rotorfilm.fmu.export import as_exported
from rotorfilm.fmu.native.native_backend import Export, native_model_variables
from rotorfilm.native.library import library_path
from rotorfilm.native.resource import FILE_NAME, carried_library, pack

TOKEN = "{8c4e810f-3df3-4a00-8276-176fa3c9f000}"
NATIVE = Path(__file__).parents[2] / "rotorfilm" / "native"
FOLDERS = ("binaries/linux64", "binaries/x86_64-linux", "resources")


class Client:
    """An instance behind fmpy, with one face for both versions of FMI and names without component."""

    def __init__(self, fmu, references):
        self.fmu, self.references = fmu, references
        self.third = isinstance(fmu, FMU3Slave | FMU3Model)

    def of(self, names):
        return [self.references[name if name in self.references else f"m.{name}"] for name in names]

    def start(self, **experiment):
        if not self.third:
            self.fmu.setupExperiment(**experiment)
            experiment = {}
        self.fmu.enterInitializationMode(**experiment)
        self.fmu.exitInitializationMode()
        return self

    def get(self, *names):
        return np.array((self.fmu.getFloat64 if self.third else self.fmu.getReal)(self.of(names)))

    def set(self, **values):
        put = self.fmu.setFloat64 if self.third else self.fmu.setReal
        put(self.of(values), list(values.values()))

    def step(self, t, dt):
        return self.fmu.doStep(t, dt)

    def pass_event(self):
        """Return the time of the next event, None if there is none."""
        event = self.fmu.updateDiscreteStates() if self.third else self.fmu.newDiscreteStates()
        assert not any(event[:4])
        return event[5] if event[4] else None

    def set_states(self, x):
        self.fmu.setContinuousStates((c_double * len(x))(*x), len(x))

    def derivatives(self, count):
        dx = (c_double * count)()
        (self.fmu.getContinuousStateDerivatives if self.third else self.fmu.getDerivatives)(dx, count)
        return np.array(dx)

    def differentiate(self, unknowns, knowns, seed):
        return np.array(self.fmu.getDirectionalDerivative(self.of(unknowns), self.of(knowns), list(seed)))


class Folder(NamedTuple):
    """An unzipped FMU, and the value references of its variables."""

    root: Path
    references: dict
    clients: list

    @property
    def library(self):
        return self.root / FOLDERS[0] / "m.so"

    @property
    def resource(self):
        return self.root / "resources" / FILE_NAME

    def open(self, kind, **options):
        """Return a client in an instance of FMU2Slave, FMU2Model, FMU3Slave or FMU3Model."""
        fmu = kind(guid=TOKEN, modelIdentifier="m", unzipDirectory=str(self.root), instanceName="one")
        fmu.instantiate(**options)
        self.clients.append(Client(fmu, self.references))
        return self.clients[-1]


def native_variables(model, spec, start):
    """Return time, parameters, inputs, outputs, states and derivatives of a model that is called m."""
    model = as_exported(model)
    inputs = np.array([float(start.get(s.name, 0.0)) for s in model.inputs])
    return native_model_variables(Export(model, spec, "m", "", inputs, 1.0, "2.0", "host", "m"))


@pytest.fixture
def unzipped(tmp_path):
    """Return a function that writes the folder of a model with a kernel."""
    clients = []

    def write(model, start=None, folder="an fmu", token=TOKEN):
        root = tmp_path / folder
        spec = model.native()
        variables = native_variables(model, spec, start or {})
        for name in FOLDERS:
            (root / name).mkdir(parents=True, exist_ok=True)
        for name in FOLDERS[:2]:
            shutil.copy(library_path(carried_library(spec)), root / name / "m.so")
        (root / "resources" / FILE_NAME).write_bytes(pack(spec, token, variables))
        references = {variable.name: reference for reference, variable in enumerate(variables)}
        return Folder(root, references, clients)

    yield write
    for client in clients:
        client.fmu.freeInstance()


@pytest.fixture(scope="session")
def compiled(tmp_path_factory):
    """Return a function that compiles C sources to a program with gcc or clang, once for all workers."""
    compiler = next((name for name in ("gcc", "clang", "cc") if shutil.which(name)), None)
    if compiler is None:
        pytest.skip("no C compiler")
    own = tmp_path_factory.getbasetemp()
    shared = own.parent if os.environ.get("PYTEST_XDIST_WORKER") else own

    def build(sources, *options):
        named = " ".join([*map(str, sources), *options])
        program = shared / f"program_{sha256(named.encode()).hexdigest()[:16]}"
        with program.with_suffix(".lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not program.exists():
                make(program, sources, options)
        return program

    def make(program, sources, options):
        strict = ["-std=c99", "-D_POSIX_C_SOURCE=200809L", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
        command = [compiler, *strict, f"-I{NATIVE}", *options, *map(str, sources), "-o", str(program)]
        ran = subprocess.run([*command, "-lm", "-ldl"], capture_output=True, text=True, check=False)
        if "asan" in ran.stderr and "cannot find" in ran.stderr:
            pytest.skip("the C compiler has no sanitizers")
        assert ran.returncode == 0, ran.stderr

    build.native, build.here = NATIVE, Path(__file__).parent
    return build
