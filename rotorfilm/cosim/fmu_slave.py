"""A Co-Simulation FMU of FMI 2.0 or 3.0 as a partner in a co-simulation, run by fmpy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from os import PathLike
from typing import Any

import numpy as np
from fmpy.fmi1 import FMICallException

from ..errors import FilmContactError, FmuError, InputError
from ..fmu.instance import extracted, instantiated
from ..model import Array
from ..signals import from_fmi_name

CONTACT = (FilmContactError.__name__, "inside the clearance")
"""What the log of a film FMU contains when its journal touched the wall, in Python and in C."""

REAL = ("Real", "Float64")


class FmuSlave:
    """An instantiated FMU; `open_fmu` makes one and frees it.

    Parameters
    ----------
    description : fmpy.model_description.ModelDescription
    folder : str
        Where the FMU was extracted.
    """

    def __init__(self, description: Any, folder: str) -> None:
        self._name = description.modelName
        self._failed = False
        self._references = {
            causality: _references(description, causality) for causality in ("input", "output")
        }
        self._instance = instantiated(description, folder, exchange=False)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Local names of the real inputs."""
        return tuple(self._references["input"])

    @property
    def outputs(self) -> tuple[str, ...]:
        """Local names of the real outputs."""
        return tuple(self._references["output"])

    def start(self, values: Mapping[str, float]) -> None:
        """Initialize at t = 0 with these inputs."""
        with self._reported("initialization"):
            self._instance.initialize(self._inputs(values), list(values.values()))

    def set(self, values: Mapping[str, float]) -> None:
        """Set inputs by their local names."""
        with self._reported("setting inputs"):
            self._instance.set(self._inputs(values), list(values.values()))

    def step(self, t: float, dt: float) -> None:
        """Advance from t to t + dt [s]."""
        with self._reported(f"the step from t = {t:.9g} s"):
            self._instance.step(t, dt)

    def get(self) -> dict[str, float]:
        """Return the outputs at the present time."""
        references = self._references["output"]
        with self._reported("reading outputs"):
            return dict(zip(references, self._instance.get(list(references.values())), strict=True))

    def jacobian(self, outputs: Sequence[str], inputs: Sequence[str]) -> Array:
        """Return d(outputs)/d(inputs), shape (n_outputs, n_inputs), now; native FMUs know it."""
        unknowns = [self._references["output"][name] for name in outputs]
        knowns = [self._references["input"][name] for name in inputs]
        with self._reported("reading derivatives"):
            columns = [self._instance.directional(unknowns, [known], [1.0]) for known in knowns]
        return np.array(columns).reshape(len(inputs), len(outputs)).T

    def close(self) -> None:
        """Terminate, free the instance and unload its library, whatever happened before."""
        # FMI forbids freeing after fmi2Fatal, but PythonFMU calls every exception fatal and its
        # instances can be freed; not freeing them would leak one for each run into the wall.
        with suppress(FMICallException):
            self._instance.close(terminate=not self._failed)

    def _inputs(self, values: Mapping[str, float]) -> list[int]:
        return [self._references["input"][name] for name in values]

    @contextmanager
    def _reported(self, doing: str) -> Iterator[None]:
        """Turn an error status into an FmuError, or FilmContactError, that quotes the log."""
        try:
            yield
        except FMICallException as error:
            self._failed = True
            text = " ".join([f"FMU {self._name!r} failed in {doing}: {error}", *self._instance.log])
            touched = any(phrase in text for phrase in CONTACT)
            raise (FilmContactError if touched else FmuError)(text) from error


@contextmanager
def open_fmu(path: str | PathLike[str]) -> Iterator[FmuSlave]:
    """Extract and instantiate an FMU; free it and delete the files at the end, in any case.

    Parameters
    ----------
    path : path of the .fmu file

    Raises
    ------
    FmuError
        If the file cannot be read, is no Co-Simulation FMU of FMI 2.0 or 3.0, or cannot be instantiated.
    """
    with extracted(path) as (description, folder):
        slave = FmuSlave(description, folder)
        try:
            yield slave
        finally:
            slave.close()


def _references(description: Any, causality: str) -> dict[str, int]:
    """Return the value references of the real inputs or outputs, by local name."""
    references: dict[str, int] = {}
    for variable in description.modelVariables:
        if variable.causality != causality or variable.type not in REAL:
            continue
        name = _local_name(variable.name)
        if name in references:
            raise InputError(f"{causality} names must differ without their component, got {name!r} twice")
        references[name] = variable.valueReference
    return references


def _local_name(name: str) -> str:
    """Return the signal of `component.signal`; other spellings stay as they are."""
    try:
        return from_fmi_name(name)[1]
    except InputError:
        return name
