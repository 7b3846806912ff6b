"""An FMU taken out of its archive, and an instance of it."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from os import PathLike
from typing import Any

import fmpy
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

from ...errors import FmuError, FmuFileError
from ..binaries import host_libraries, require_whole
from ..reading import read_description
from .calls import Instance, Instance2, Instance3, let_go


@contextmanager
def extracted(path: str | PathLike[str]) -> Iterator[tuple[Any, str]]:
    """Yield fmpy's description of an FMU and the folder with its files, which goes at the end.

    Raises
    ------
    FmuFileError
        If the file cannot be read, or is of another FMI version.
    """
    description = read_description(str(path))
    folder = tempfile.mkdtemp(prefix="rotorfilm-")
    try:
        try:
            fmpy.extract(str(path), unzipdir=folder)
        except Exception as error:
            raise FmuFileError(f"fmu must be a readable FMU, got {str(path)!r}: {error}") from error
        yield description, folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def instantiated(description: Any, folder: str, exchange: bool) -> Instance:
    """Return an instance of an extracted FMU, for Model Exchange if `exchange`, else for Co-Simulation.

    Raises
    ------
    FmuError
        If it lacks this interface, its library is not whole, or it does not instantiate.
    """
    interface = description.modelExchange if exchange else description.coSimulation
    wanted = "Model Exchange" if exchange else "Co-Simulation"
    if interface is None:
        raise FmuError(f"fmu must have the interface {wanted}, got {description.modelName!r} without")
    kind, wrap = {
        (True, True): (FMU2Model, Instance2),
        (True, False): (FMU2Slave, Instance2),
        (False, True): (FMU3Model, Instance3),
        (False, False): (FMU3Slave, Instance3),
    }[description.fmiVersion == "2.0", exchange]
    for library in host_libraries(folder, interface.modelIdentifier):
        require_whole(library)
    try:
        # fmpy stays in the library's folder where it cannot load the library.
        with chdir("."):
            fmu = kind(
                guid=description.guid,
                unzipDirectory=folder,
                modelIdentifier=interface.modelIdentifier,
                instanceName=description.modelName,
            )
    except Exception as error:
        raise FmuError(f"FMU {description.modelName!r} cannot be instantiated: {error}") from error
    instance = wrap(fmu, exchange)
    try:
        instance.instantiate()
    except Exception as error:
        let_go(fmu)
        fmu.freeLibrary()
        raise FmuError(
            " ".join([f"FMU {description.modelName!r} cannot be instantiated: {error}", *instance.log])
        ) from error
    return instance
