"""The files of an FMU that runs its model in Python, through PythonFMU (FMI 2.0 Co-Simulation)."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping
from importlib.metadata import version as installed_version
from typing import Any, NamedTuple

from ...errors import FmuError
from ...model import Model, Stepped
from ...signals import Variable
from ..archive import binaries, licenses, require_verified_version
from ..description.documentation import PYTHON, PYTHON_STEPPED, to_html
from .bundle import API, PACKAGE, SLAVE, STEPPED_SLAVE, Bundle, bundle_source, content_hash
from .codec import class_modules, decode, encode, shortened

INTERFACES = {
    "CoSimulation": {
        # The binary is PythonFMU's: it runs the model in a Python interpreter that must be installed.
        "needsExecutionTool": "true",
        "canHandleVariableCommunicationStepSize": "true",
        "canInterpolateInputs": "false",
        "canBeInstantiatedOnlyOncePerProcess": "false",
        "canNotUseMemoryManagementFunctions": "true",
        "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true",
        "providesDirectionalDerivative": "false",
    }
}

CATEGORIES = {
    "logStatusDiscard": "A step that could not be made, with its values.",
    "logAll": "All messages.",
}

ENTRY = '''"""Entry point of the FMU: PythonFMU loads the class Slave."""

import importlib

from {api} import keep
from {slave} import {base}

# PythonFMU runs this file for each instance and then releases its globals, which it only borrowed.
keep(globals())

# All at once, because the folder may be gone when another instance of this FMU needs one of them.
for name in {modules}:
    importlib.import_module(name)


class Slave({base}):
    """{title}"""

    tag = "{tag}"
'''


class SlaveClass(NamedTuple):
    """The class that runs a model, and the module it is in."""

    module: str
    name: str


STEPPED = SlaveClass(STEPPED_SLAVE, "SteppedSlave")


def python_tool() -> str:
    """Return what made the FMU, with versions."""
    return f"{PACKAGE} {installed_version(PACKAGE)} (PythonFMU {installed_version('pythonfmu')})"


def python_files(
    model: Model | Stepped,
    component: str,
    title: str,
    start: Mapping[str, float],
    variables: tuple[Variable, ...],
    prefix: str,
) -> dict[str, bytes]:
    """Return all files of the FMU but the XML, by path.

    Raises
    ------
    FmuError
        If the model cannot be carried, or the installed pythonfmu is not the verified version.
    """
    require_verified_version()
    data = encode(model)
    slave = SlaveClass(SLAVE, "ModelSlave") if isinstance(model, Model) else STEPPED
    bundle = bundle_source(class_modules(data), slave.module)
    _require_rebuilt(data)
    texts = PYTHON if isinstance(model, Model) else PYTHON_STEPPED
    page = to_html(title, variables, texts, json.dumps(shortened(data), indent=2))
    return {
        **_resources(data, component, prefix, start, bundle, slave),
        **binaries(component, bundle.files),
        **licenses((PACKAGE, "pythonfmu")),
        "documentation/index.html": page,
    }


def _require_rebuilt(data: Any) -> None:
    """Raise unless the encoded model can be built again from its fields."""
    try:
        with warnings.catch_warnings(action="ignore"):
            again = encode(decode(data, {}))
    except Exception as error:
        raise FmuError(f"model must follow from its fields alone, got {error!r}") from error
    if again != data:
        raise FmuError(f"model must keep the fields it is built by, got {again!r} from {data!r}")


def _resources(
    data: Any, component: str, prefix: str, start: Mapping[str, float], bundle: Bundle, slave: SlaveClass
) -> dict[str, bytes]:
    """Return the files that PythonFMU reads: the entry module, the model as data, and the source."""
    settings = {"component": prefix, "start": dict(start), "modules": bundle.modules, "model": data}
    text = (json.dumps(settings, indent=2, sort_keys=True) + "\n").encode()
    tag = content_hash({**bundle.files, "model.json": text})
    entry = f"{component}_{tag}"
    modules = "".join(f"\n    {name!r}," for name in sorted(bundle.modules.values()))
    source = ENTRY.format(
        api=bundle.modules[API],
        slave=bundle.modules[slave.module],
        base=slave.name,
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
