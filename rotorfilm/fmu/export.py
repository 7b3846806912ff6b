"""Export of a model as an FMU."""

from __future__ import annotations

import json
import re
import uuid
import warnings
from collections.abc import Mapping
from importlib.metadata import version as installed_version
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import FmuError, InputError, require_finite, require_positive
from ..model import Array, Dynamic, Model
from .archive import binaries, licenses, require_verified_version, to_zip
from .bundle import API, PACKAGE, SLAVE, Bundle, bundle_source, content_hash
from .codec import class_modules, decode, encode
from .description import Description, to_xml
from .documentation import to_html
from .structure import dependencies
from .variables import fmi_variables

NAMESPACE = uuid.UUID("6f0f6a52-9c0e-5d6b-8a53-3f5f1d7b2c11")
"""Namespace of the guids, which are uuid5 of an FMU's content."""

ENTRY = '''"""Entry point of the FMU: PythonFMU loads the class Slave."""

import importlib

from {api} import keep
from {slave} import ModelSlave

# PythonFMU runs this file for each instance and then releases its globals, which it only borrowed.
keep(globals())

# All at once, because the folder may be gone when another instance of this FMU needs one of them.
for name in {modules}:
    importlib.import_module(name)


class Slave(ModelSlave):
    """{title}"""

    tag = "{tag}"
'''


def export_fmu(
    model: Model,
    path: str | Path,
    version: str = "2.0",
    backend: str = "python",
    *,
    component: str | None = None,
    start: Mapping[str, float] | None = None,
    stop_time: float = 0.1,
    step_size: float = 1e-4,
) -> Path:
    """Write `model` as an FMI 2.0 Co-Simulation FMU that carries its own copy of the source it needs.

    Equal models give byte-identical files. Each output is a structured variable `component.signal`, each
    state a local `component.state_signal`, settable before the simulation starts.

    Parameters
    ----------
    model : Model
        A dataclass (of this package or from a module of the user) whose fields are numbers, bools, strings,
        None, tuples, lists, numpy arrays or such dataclasses.
    path : str or Path
        File to write, ending in `.fmu`; its folder is made if need be.
    version : str
        FMI version; the python backend knows "2.0".
    backend : str
        What runs the model inside the FMU; "python" is PythonFMU.
    component : str, optional
        Identifier in front of the dot of each variable's name, and name of the FMU; by default the name of
        the model's class in snake case.
    start : mapping of str to float, optional
        Start values of inputs by signal name, in SI units; 0 where none is given.
    stop_time, step_size : float [s]
        Default experiment that the FMU suggests.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    InputError
        If another argument breaks its rule; the message names it.
    FmuError
        If the model cannot be exported, or the installed pythonfmu is not the verified version.
    """
    require_verified_version()
    target = Path(path)
    _require_supported(target, version, backend)
    _require_model(model)
    name = _snake_case(type(model).__name__) if component is None else component
    _require_component(name)
    values = _start_values(model, start or {})
    contents = _contents(model, name, values)
    description = _description(model, name, values, stop_time, step_size)
    contents["modelDescription.xml"] = to_xml(description, _guid(contents, description))
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(to_zip(contents))
    return target


def _contents(model: Model, component: str, start: Mapping[str, float]) -> dict[str, bytes]:
    """Return all files of the FMU but the XML, by path."""
    data = encode(model)
    bundle = bundle_source(class_modules(data))
    _require_rebuilt(data)
    return {
        **_resources(data, component, start, bundle),
        **binaries(component, bundle.files),
        **licenses((PACKAGE, "pythonfmu")),
        "documentation/index.html": to_html(_title(model), fmi_variables(model, component, start), data),
    }


def _description(
    model: Model, component: str, start: Mapping[str, float], stop_time: float, step_size: float
) -> Description:
    """Return what the XML says, once the model has an output at its start values."""
    for argument, value in (("stop_time", stop_time), ("step_size", step_size)):
        require_positive(argument, value)
    inputs = np.array([start[signal.name] for signal in model.inputs])
    _require_output(model, inputs, start)
    return Description(
        identifier=component,
        title=_title(model),
        tool=f"{PACKAGE} {installed_version(PACKAGE)} (PythonFMU {installed_version('pythonfmu')})",
        variables=fmi_variables(model, component, start),
        dependencies=dependencies(model, inputs),
        stop_time=float(stop_time),
        step_size=float(step_size),
    )


def _title(model: Model) -> str:
    return (type(model).__doc__ or type(model).__name__).strip().splitlines()[0]


def _require_supported(path: Path, version: str, backend: str) -> None:
    if path.suffix != ".fmu":
        raise InputError(f"path must end in .fmu, got {str(path)!r}")
    if version == "3.0":
        raise InputError("version must be '2.0' for the python backend: PythonFMU has no FMI 3.0, got '3.0'")
    if version != "2.0":
        raise InputError(f"version must be '2.0', got {version!r}")
    if backend != "python":
        raise InputError(f"backend must be 'python', got {backend!r}")


def _require_model(model: Any) -> None:
    if not isinstance(model, Model):
        raise FmuError(
            "model must have inputs, outputs, states, output and linearization (a Model), "
            f"got {model!r} of type {type(model).__qualname__}"
        )
    if model.states and not isinstance(model, Dynamic):
        raise FmuError(f"model must have initial_state and derivative, as it has states, got {model!r}")


def _require_component(component: str) -> None:
    if not (component.isidentifier() and component.isascii()):
        raise InputError(f"component must be an ASCII identifier without dots, got {component!r}")


def _require_rebuilt(data: Any) -> None:
    """Raise unless the encoded model can be built again from its fields."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            again = encode(decode(data, {}))
    except Exception as error:
        raise FmuError(f"model must follow from its fields alone, got {error!r}") from error
    if again != data:
        raise FmuError(f"model must keep the fields it is built by, got {again!r} from {data!r}")


def _require_output(model: Model, inputs: Array, start: Mapping[str, float]) -> None:
    """Raise unless the model has an output at its start values."""
    state = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
    try:
        output = require_finite("output", model.output(0.0, state, inputs))
    except Exception as error:
        raise InputError(
            f"start must be values at which the model has an output, got {dict(start)!r}: {error}"
        ) from error
    if output.shape != (len(model.outputs),):
        raise FmuError(f"output must have shape ({len(model.outputs)},), got {output.shape}")


def _start_values(model: Model, start: Mapping[str, float]) -> dict[str, float]:
    names = [signal.name for signal in model.inputs]
    for name, value in start.items():
        if name not in names:
            raise InputError(f"start must have keys from the inputs {names}, got {name!r}")
        require_finite(f"start[{name!r}]", value)
    return {name: float(start.get(name, 0.0)) for name in names}


def _resources(data: Any, component: str, start: Mapping[str, float], bundle: Bundle) -> dict[str, bytes]:
    """Return the files that PythonFMU reads: the entry module, the model as data, and the source."""
    settings = {"component": component, "start": dict(start), "modules": bundle.modules, "model": data}
    text = (json.dumps(settings, indent=2, sort_keys=True) + "\n").encode()
    tag = content_hash({**bundle.files, "model.json": text})
    entry = f"{component}_{tag}"
    modules = "".join(f"\n    {name!r}," for name in sorted(bundle.modules.values()))
    source = ENTRY.format(
        api=bundle.modules[API],
        slave=bundle.modules[SLAVE],
        modules=f"({modules}\n)",
        title=component,
        tag=tag,
    )
    files = {
        **bundle.files,
        "model.json": text,
        "slavemodule.txt": entry.encode(),
        f"{entry}.py": source.encode(),
    }
    return {f"resources/{name}": content for name, content in files.items()}


def _guid(contents: Mapping[str, bytes], description: Description) -> str:
    return str(uuid.uuid5(NAMESPACE, content_hash({**contents, "xml": to_xml(description, "")})))


def _snake_case(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
