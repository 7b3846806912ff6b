"""Export of a model as an FMU: checks, the choice of the backend, the archive."""

from __future__ import annotations

import re
import uuid
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np

from ..errors import FmuError, InputError, require_finite, require_positive
from ..files import write_whole
from ..inputs.kinds import arguments
from ..model import Array, Dynamic, Model, Stepped
from ..native.spec import HasKernel, NativeSpec
from ..warming import in_time
from .archive import to_zip
from .description.dependencies import delayed_dependencies, dependencies
from .description.model_description import Description, to_xml
from .description.variables import fmi_variables
from .description.xml2 import Dialect2
from .description.xml3 import Dialect3
from .linear_system import from_state_space
from .narrow import as_exported
from .native.native_backend import (
    CATEGORIES,
    INTERFACES,
    Export,
    copyright_line,
    native_files,
    native_model_variables,
    native_tool,
    resource,
    source_names,
)
from .python.bundle import content_hash
from .python.python_backend import (
    CATEGORIES as PYTHON_CATEGORIES,
    INTERFACES as PYTHON_INTERFACES,
    python_files,
    python_tool,
)

if TYPE_CHECKING:
    import control

NAMESPACE = uuid.UUID("6f0f6a52-9c0e-5d6b-8a53-3f5f1d7b2c11")
"""Namespace of the guids, which are uuid5 of an FMU's content."""

VERSIONS = ("2.0", "3.0")
BACKENDS = ("native", "python")
PLATFORMS = ("host", "all")


@arguments
def export_fmu(
    model: Model | Stepped | control.StateSpace,
    path: str | Path,
    version: str = "2.0",
    backend: str | None = None,
    *,
    platforms: str = "host",
    component: str | None = None,
    start: Mapping[str, float] | None = None,
    stop_time: float = 0.1,
    step_size: float = 1e-4,
) -> Path:
    """Write `model` as an FMU.

    A model with a kernel in the C library becomes a native FMU: Model Exchange and Co-Simulation in one,
    with exact directional derivatives, its own sources, tunable parameters and a reference trajectory, and
    without need of Python. Any other becomes an FMI 2.0 Co-Simulation FMU that carries its Python source;
    a Stepped model one whose outputs belong to the end of the last step.

    Equal models give byte-identical files. Each signal is a structured variable `component.signal`, each
    state a local `component.state_signal`, settable before the simulation starts.

    Parameters
    ----------
    model : Model, Stepped or control.StateSpace
        A continuous python-control system is a model whose signals are its labels. For the python backend
        a dataclass (of this package or from a module of the user) whose fields are numbers, bools, strings,
        None, tuples, lists, numpy arrays, functions from the top of such a module, or such dataclasses.
    path : str or Path
        File to write, ending in `.fmu`; its folder is made if need be.
    version : str
        FMI version, "2.0" or "3.0"; the python backend knows "2.0" only.
    backend : str, optional
        What runs the model inside the FMU: "native", the C library, or "python", PythonFMU. By default
        "native" for a model with a kernel, else "python".
    platforms : str
        "host", the platform of this machine, or "all": Linux on x86_64 and aarch64, Windows on x86_64,
        macOS on both, compiled by zig (`pip install 'rotorfilm[platforms]'`). For the native backend.
    component : str, optional
        Identifier in front of the dot of each variable's name, and name of the FMU; by default that of
        a bearing by `as_reaction`, or of the model's class in snake case.
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
        If the model cannot be exported, has no kernel for the native backend, zig is needed and not
        installed, or the installed pythonfmu is not the verified version.
    """
    target = Path(path)
    for argument, value in (("stop_time", stop_time), ("step_size", step_size)):
        require_positive(argument, value)
    subject = in_time(_subject(model))
    spec = subject.native() if isinstance(subject, HasKernel) else None
    native = _is_native(subject, spec, backend)
    _require_supported(target, version, native, platforms)
    name = _component(model) if component is None else component
    _require_component(name)
    title = _title(subject)
    subject = as_exported(subject) if native and isinstance(subject, Model) else subject
    inputs = np.array(list(_start_values(subject, start or {}).values()))
    _require_output(subject, inputs)
    if native and spec is not None and isinstance(subject, Model):
        export = Export(subject, spec, name, title, inputs, stop_time, version, platforms)
        contents = _native_contents(export, step_size)
    else:
        contents = _python_contents(subject, name, inputs, stop_time, step_size)
    target.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(target, to_zip(contents))


def _native_contents(export: Export, step_size: float) -> dict[str, bytes]:
    """Return all files of a native FMU by path."""
    variables = native_model_variables(export)
    times = np.linspace(0.0, export.stop_time, 7).tolist()
    description = Description(
        identifier=export.component,
        title=export.title,
        tool=native_tool(),
        copyright=copyright_line(),
        interfaces=INTERFACES[export.version],
        categories=CATEGORIES,
        variables=variables,
        dependencies=dependencies(export.model, export.inputs, times),
        stop_time=float(export.stop_time),
        step_size=float(step_size),
        sources=source_names(),
    )
    dialect = Dialect2() if export.version == "2.0" else Dialect3()
    contents = native_files(export, variables)
    token = _guid({**contents, **resource(export, variables, ""), "xml": to_xml(description, dialect, "")})
    contents |= resource(export, variables, token)
    return {**contents, "modelDescription.xml": to_xml(description, dialect, token)}


def _python_contents(
    model: Model | Stepped, component: str, inputs: Array, stop_time: float, step_size: float
) -> dict[str, bytes]:
    """Return all files of an FMU of the python backend by path."""
    start = {signal.name: float(value) for signal, value in zip(model.inputs, inputs, strict=True)}
    variables = fmi_variables(model, component, start)
    contents = python_files(model, component, _title(model), start, variables)
    description = Description(
        identifier=component,
        title=_title(model),
        tool=python_tool(),
        copyright=copyright_line(),
        interfaces=PYTHON_INTERFACES,
        categories=PYTHON_CATEGORIES,
        variables=variables,
        dependencies=dependencies(model, inputs) if isinstance(model, Model) else delayed_dependencies(model),
        stop_time=float(stop_time),
        step_size=float(step_size),
    )
    guid = _guid({**contents, "xml": to_xml(description, Dialect2(), "")})
    return {**contents, "modelDescription.xml": to_xml(description, Dialect2(), guid)}


def _subject(model: Any) -> Model | Stepped:
    """Return the model; a python-control system as one."""
    from control import StateSpace

    subject = from_state_space(model) if isinstance(model, StateSpace) else model
    if isinstance(subject, Stepped):
        return subject
    if not isinstance(subject, Model):
        raise FmuError(
            "model must have inputs, outputs, states, output and linearization (a Model) or be a "
            f"control.StateSpace, got {model!r} of type {type(model).__qualname__}"
        )
    if subject.states and not isinstance(subject, Dynamic):
        raise FmuError(f"model must have initial_state and derivative, as it has states, got {model!r}")
    return subject


def _is_native(model: Model | Stepped, spec: NativeSpec | None, backend: str | None) -> bool:
    if backend is None:
        return spec is not None
    if backend not in BACKENDS:
        raise InputError(f"backend must be one of {list(BACKENDS)} or None, got {backend!r}")
    if backend == "native" and spec is None:
        raise FmuError(
            f"model must have a kernel in the C library for backend='native', got {model!r}; "
            "use backend='python'"
        )
    return backend == "native"


def _require_supported(path: Path, version: str, native: bool, platforms: str) -> None:
    if path.suffix != ".fmu":
        raise InputError(f"path must end in .fmu, got {str(path)!r}")
    if version not in VERSIONS:
        meant = next((f": as text, version={one!r}" for one in VERSIONS if str(version) in (one, one[0])), "")
        raise InputError(f"version must be one of {list(VERSIONS)}, got {version!r}{meant}")
    if version == "3.0" and not native:
        raise FmuError("version must be '2.0' for the python backend: PythonFMU has no FMI 3.0, got '3.0'")
    if platforms not in PLATFORMS:
        raise InputError(f"platforms must be one of {list(PLATFORMS)}, got {platforms!r}")
    if platforms == "all" and not native:
        raise FmuError("platforms must be 'host' for the python backend, which brings its own, got 'all'")


def _title(model: Model | Stepped) -> str:
    return (type(model).__doc__ or type(model).__name__).strip().splitlines()[0]


@runtime_checkable
class NamedModel(Protocol):
    """What a model may add: the name of its FMU, where the caller gives none."""

    @property
    def component(self) -> str:
        """An ASCII identifier."""


def _component(model: Any) -> str:
    if isinstance(model, NamedModel):
        return model.component
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", type(model).__name__).lower()


def _require_component(component: str) -> None:
    if not (component.isidentifier() and component.isascii()):
        raise InputError(f"component must be an ASCII identifier without dots, got {component!r}")


def _require_output(model: Model | Stepped, inputs: Array) -> None:
    """Raise unless the model has an output at its start values."""
    try:
        output = require_finite("output", _first_output(model, inputs))
    except Exception as error:
        raise InputError(
            f"start must be values at which the model has an output, got {inputs.tolist()}: {error}"
        ) from error
    if output.shape != (len(model.outputs),):
        raise FmuError(f"output must have shape ({len(model.outputs)},), got {output.shape}")


def _first_output(model: Model | Stepped, inputs: Array) -> Array:
    if isinstance(model, Stepped):
        return model.answer(model.start(inputs))
    state = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
    return model.output(0.0, state, inputs)


def _start_values(model: Model | Stepped, start: Mapping[str, float]) -> dict[str, float]:
    names = [signal.name for signal in model.inputs]
    for name, value in start.items():
        if name not in names:
            raise InputError(
                f"start must have keys from the inputs {names}, got {name!r}{_state_hint(model, name)}"
            )
        require_finite(f"start[{name!r}]", value)
    return {name: float(start.get(name, 0.0)) for name in names}


def _state_hint(model: Model | Stepped, name: str) -> str:
    """Return how a state is given its start, where a name is that of one."""
    if isinstance(model, Stepped) or name not in {signal.name for signal in model.states}:
        return ""
    argument = f"start_{name}"
    given = f"{argument} of {type(model).__name__}" if hasattr(model, argument) else "the model"
    return (
        f", a state: {given} says where it starts, and who runs the FMU may set its variable "
        f"state_{name} before the simulation starts"
    )


def _guid(contents: Mapping[str, bytes]) -> str:
    return str(uuid.uuid5(NAMESPACE, content_hash(contents)))
