"""What a modelDescription.xml says, and the parts of it that FMI 2.0 and 3.0 share."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from itertools import pairwise
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

import numpy as np
from numpy.typing import NDArray

from ..core.errors import FmuError, InputError
from ..core.model import Array, Dynamic, Model, Stepped
from ..core.signals import (
    FREEDOMS,
    Scalar,
    Variable,
    elements_of,
    force_names,
    names,
    place_names,
    to_fmi_name,
)
from ..core.units import DISPLAY_UNITS, UNITS

# Which inputs, states and parameters each output and derivative depends on, for the FMI ModelStructure.


SAMPLES = 8
"""Generic points at which a derivative must vanish exactly before an output counts as independent."""

Flags = NDArray[np.bool_]


class Dependencies(NamedTuple):
    """What the unknowns of a model, first its outputs, then the derivatives of its states, depend on.

    Attributes
    ----------
    on_inputs : ndarray of bool, shape (n_unknowns, n_inputs)
    on_states : ndarray of bool, shape (n_unknowns, n_states)
    on_time : ndarray of bool, shape (n_unknowns,)
    bent : ndarray of bool, shape (n_unknowns, n_inputs + n_states)
        Where the dependence is not linear.
    delayed : bool
        Whether inputs act in the next step only: outputs follow from them during initialization alone.
    """

    on_inputs: Flags
    on_states: Flags
    on_time: Flags
    bent: Flags
    delayed: bool = False


Unknown = tuple[int, list[tuple[int, str]]]
"""One entry of a ModelStructure: its value reference, and what it depends on, and how, as FMI spells it."""


def dependencies(model: Model | Stepped, start: Array, times: Sequence[float] = (0.0,)) -> Dependencies:
    """Return the dependencies of `model` from its exact derivatives.

    The derivatives are taken at the start values and at `SAMPLES` generic points about them. An unknown
    counts as independent of an input or state only if this derivative is exactly zero at all of them, and as
    linear only if it is the same at all of them. If a point has no derivatives, as a film at rest, the other
    points decide. If no point has derivatives, all may depend. Of a model with its own integrator all outputs
    follow from all inputs.

    Parameters
    ----------
    model : Model or Stepped
    start : ndarray, shape (n_inputs,)
        Start values of the inputs.
    times : sequence of float [s]
        An unknown with the same value at all of them counts as independent of time.
    """
    if isinstance(model, Stepped):
        every = np.ones((len(model.outputs), len(model.inputs)), dtype=bool)
        return Dependencies(every, every[:, :0], np.zeros(len(every), dtype=bool), every, delayed=True)
    points = _points(model, start)
    found = [matrix for x, u in points if (matrix := _matrix(model, x, u)) is not None]
    shape = (len(model.outputs) + len(model.states), len(model.inputs) + len(model.states))
    nonzero, bent = np.ones(shape, dtype=bool), np.ones(shape, dtype=bool)
    if found:
        stack = np.array(found)
        # NaN is not zero: it counts as a dependency.
        nonzero = np.any(stack != 0.0, axis=0)
        bent = nonzero & (np.any(stack != stack[0], axis=0) | (len(found) < SAMPLES))
    count = len(model.inputs)
    return Dependencies(nonzero[:, :count], nonzero[:, count:], _on_time(model, points[-1], times), bent)


def running_unknowns(variables: Sequence[Variable], found: Dependencies, tunable: bool) -> list[Unknown]:
    """Return outputs and derivatives with what they depend on while the simulation runs.

    States are among it only where the description shows their derivatives too.

    Parameters
    ----------
    variables : sequence of Variable
    found : Dependencies
    tunable : bool
        Whether the model has tunable parameters, which then may be in every linear factor.
    """
    if found.delayed:
        found = found._replace(on_inputs=np.zeros_like(found.on_inputs))
    linear = "tunable" if tunable else "constant"
    hidden = set() if derivative_references(variables) else set(references(variables, "local"))
    rows = _rows(variables, found, linear)
    return [(k, [pair for pair in pairs if pair[0] not in hidden]) for k, pairs in rows]


def initial_unknowns(variables: Sequence[Variable], found: Dependencies) -> list[Unknown]:
    """Return outputs and derivatives with what they depend on during initialization, parameters included."""
    parameters = [(k, "dependent") for k in references(variables, "parameter")]
    linear = "dependent" if parameters else "constant"
    return [(k, parameters + pairs) for k, pairs in _rows(variables, found, linear)]


def _rows(variables: Sequence[Variable], found: Dependencies, linear: str) -> list[Unknown]:
    """Return outputs and derivatives with the time, inputs and states that they depend on."""
    unknowns = [*references(variables, "output"), *derivative_references(variables)]
    knowns = np.array([*references(variables, "input"), *references(variables, "local")])
    times = [(known, "dependent") for known in references(variables, "independent")]
    # A description without derivatives, for co-simulation only, has no use for their rows.
    depends = np.concatenate([found.on_inputs, found.on_states], axis=1)[: len(unknowns)]
    kinds = np.where(found.bent, "dependent", linear)
    return [
        (
            unknown,
            times * bool(found.on_time[k])
            + list(zip(knowns[depends[k]].tolist(), kinds[k][depends[k]].tolist(), strict=True)),
        )
        for k, unknown in enumerate(unknowns)
    ]


def _points(model: Model, start: Array) -> list[tuple[Array, Array]]:
    state = model.initial_state if isinstance(model, Dynamic) else np.zeros(0)
    generator = np.random.default_rng(0)
    points = [(np.asarray(state, dtype=float), start)]
    for _ in range(SAMPLES):
        points.append(
            (
                state + generator.uniform(-0.5, 0.5, len(model.states)) * _nominal(model.states),
                start + generator.uniform(-0.5, 0.5, len(model.inputs)) * _nominal(model.inputs),
            )
        )
    return points


def _matrix(model: Model, x: Array, u: Array) -> Array | None:
    """Return d(output, derivative)/d(input, state), or None where there is no such thing."""
    try:
        at = model.linearization(0.0, x, u)
    except Exception:
        # Whatever a model raises where it has no derivatives, the point says nothing.
        return None
    return np.block([[at.D, at.C], [at.B, at.A]])


def _on_time(model: Model, point: tuple[Array, Array], times: Sequence[float]) -> Flags:
    try:
        values = np.array([_unknowns(model, t, *point) for t in times])
    except Exception:
        return np.ones(len(model.outputs) + len(model.states), dtype=bool)
    return np.any(values != values[0], axis=0)


def _unknowns(model: Model, t: float, x: Array, u: Array) -> Array:
    slopes = model.derivative(t, x, u) if isinstance(model, Dynamic) else np.zeros(0)
    return np.concatenate([model.output(t, x, u), slopes])


def _nominal(signals: Sequence[Scalar]) -> Array:
    return np.array([signal.nominal for signal in signals])


# What a modelDescription.xml says, and the parts of it that FMI 2.0 and 3.0 share.


QUANTITIES = {
    "m": "Length",
    "s": "Time",
    "kg": "Mass",
    "rad": "Angle",
    "m/s": "Velocity",
    "m/s2": "Acceleration",
    "rad/s": "AngularVelocity",
    "rad/s2": "AngularAcceleration",
    "N": "Force",
    "N/m": "Stiffness",
    "N.s/m": "Damping",
    "Pa": "Pressure",
    "Pa.s": "DynamicViscosity",
    "kg.m": "Unbalance",
}
"""Names of the types, by unit; a unit that is not here has a type without a name."""

SHOWN = {"m": "um", "rad": "deg", "rad/s": "rpm", "N": "kN", "Pa.s": "mPa s", "kg.m": "g mm"}
"""The unit in which a tool should show values of a unit."""


class Description(NamedTuple):
    """What the XML says.

    Attributes
    ----------
    identifier : str
        C identifier; name of the binary.
    title : str
        One line on the model.
    tool : str
        Generation tool with versions.
    copyright : str
    interfaces : mapping of str to mapping
        Attributes of ModelExchange and CoSimulation, as the FMI version spells them.
    categories : mapping of str to str
        Log categories and what they log.
    variables : tuple of Variable
    dependencies : Dependencies
    stop_time, step_size : float [s]
        Default experiment.
    sources : tuple of str
        C files below `sources/` that make the binary.
    author : str
        Who made the model; empty where nobody is named.
    structured : bool
        Whether names are `component.signal`.
    """

    identifier: str
    title: str
    tool: str
    copyright: str
    interfaces: Mapping[str, Mapping[str, str]]
    categories: Mapping[str, str]
    variables: tuple[Variable, ...]
    dependencies: Dependencies
    stop_time: float
    step_size: float
    sources: tuple[str, ...] = ()
    author: str = ""
    structured: bool = True

    @property
    def tunable(self) -> bool:
        """Whether a parameter may change while the simulation runs."""
        return any(variable.variability == "tunable" for variable in self.variables)


def to_xml(description: Description, version: str) -> bytes:
    """Return modelDescription.xml with an empty token; equal arguments give equal bytes.

    Parameters
    ----------
    description : Description
    version : str
        Version of FMI, "2.0" or "3.0".
    """
    second = version == "2.0"
    root = Element(
        "fmiModelDescription",
        {
            "fmiVersion": version,
            "modelName": description.identifier,
            _TOKENS[version]: "",
            "description": description.title,
            **({"author": description.author} if description.author else {}),
            "copyright": description.copyright,
            "license": "MIT, see documentation/licenses",
            "generationTool": description.tool,
            **_generated(),
            "variableNamingConvention": "structured" if description.structured else "flat",
        },
    )
    for name in description.interfaces:
        _add_interface(root, name, description, second)
    _add_units(root, description.variables)
    types = SubElement(root, "TypeDefinitions")
    for attributes in _type_attributes(description.variables):
        _add_type(types, attributes, second)
    categories = SubElement(root, "LogCategories")
    for name, text in description.categories.items():
        SubElement(categories, "Category", name=name, description=text)
    experiment = {"stopTime": repr(description.stop_time), "stepSize": repr(description.step_size)}
    SubElement(root, "DefaultExperiment", {"startTime": "0.0", **experiment})
    variables = SubElement(root, "ModelVariables")
    for reference in heads_of(description.variables):
        _add_variable(variables, reference, elements_of(description.variables, reference), second)
    (_add_structure2 if second else _add_structure3)(SubElement(root, "ModelStructure"), description)
    return to_bytes(root)


_TOKENS = {"2.0": "guid", "3.0": "instantiationToken"}


def with_token(xml: bytes, version: str, token: str) -> bytes:
    """Return a description of `to_xml` with its token, which FMI 2.0 calls guid."""
    return xml.replace(f'{_TOKENS[version]}=""'.encode(), f'{_TOKENS[version]}="{token}"'.encode(), 1)


def _generated() -> dict[str, str]:
    """Return when the FMU was made, as SOURCE_DATE_EPOCH says, so that equal builds are equal to the byte."""
    seconds = os.environ.get("SOURCE_DATE_EPOCH", "")
    if not seconds:
        return {}
    try:
        made = datetime.fromtimestamp(int(seconds), tz=UTC)
    except (ValueError, OverflowError, OSError):
        raise InputError(
            f"SOURCE_DATE_EPOCH must be a whole number of seconds since 1970, got {seconds!r}"
        ) from None
    return {"generationDateAndTime": made.strftime("%Y-%m-%dT%H:%M:%SZ")}


def _add_units(root: Element, variables: tuple[Variable, ...]) -> None:
    """Add the units in use, each with its SI base units and the unit to show it in."""
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({variable.unit for variable in variables if variable.unit is not None}):
        unit = SubElement(definitions, "Unit", name=name)
        exponents = UNITS[name].exponents
        SubElement(unit, "BaseUnit", {base: str(power) for base, power in exponents.items()})
        if name in SHOWN:
            factor = UNITS[name].factor / DISPLAY_UNITS[SHOWN[name]].factor
            SubElement(unit, "DisplayUnit", name=SHOWN[name], factor=repr(factor))


def _type_attributes(variables: tuple[Variable, ...]) -> list[dict[str, str]]:
    """Return the attributes of the types in use: quantity, unit and display unit, sorted by name."""
    units = {v.unit for v in variables if v.unit in QUANTITIES}
    types = [{"quantity": QUANTITIES[unit], "unit": unit, **_shown(unit)} for unit in units if unit]
    return sorted(types, key=lambda attributes: attributes["quantity"])


def _add_interface(root: Element, name: str, description: Description, second: bool) -> None:
    """Add an interface; in FMI 2.0 with its sources, and the number of event indicators at the root."""
    attributes = {"modelIdentifier": description.identifier, **description.interfaces[name]}
    interface = SubElement(root, name, attributes)
    if second and (switches := switch_references(description.variables)):
        root.set("numberOfEventIndicators", str(len(switches)))
    if second and description.sources:
        files = SubElement(interface, "SourceFiles")
        for source in description.sources:
            SubElement(files, "File", name=source)


def _add_type(parent: Element, attributes: Mapping[str, str], second: bool) -> None:
    name = attributes["quantity"]
    if second:
        SubElement(SubElement(parent, "SimpleType", name=name), "Real", dict(attributes))
    else:
        SubElement(parent, "Float64Type", {"name": name, **attributes})


def _add_variable(parent: Element, reference: int, elements: Sequence[Variable], second: bool) -> None:
    variable = elements[0]
    described, values = variable_attributes(variable, reference), value_attributes(variable)
    if variable.state is not None:
        values["derivative"] = str(variable.state + second)
    if second:
        SubElement(SubElement(parent, "ScalarVariable", described), "Real", values)
    else:
        if variable.array:
            text = "; ".join(dict.fromkeys(v.description for v in elements))
            described |= {"name": variable.array, "description": text}
        if variable.array and variable.start is not None:
            values["start"] = " ".join(repr(float(v.start or 0.0)) for v in elements)
        element = SubElement(parent, "Float64", described | values)
        if variable.array:
            SubElement(element, "Dimension", start=str(len(elements)))


def _add_structure2(structure: Element, description: Description) -> None:
    """Add outputs, derivatives and initial unknowns, by places that count from 1."""
    variables, slopes = description.variables, set(derivative_references(description.variables))
    running = running_unknowns(variables, description.dependencies, description.tunable)
    _add_unknowns(structure, "Outputs", [u for u in running if u[0] not in slopes])
    if slopes:
        _add_unknowns(structure, "Derivatives", [u for u in running if u[0] in slopes])
    _add_unknowns(structure, "InitialUnknowns", initial_unknowns(variables, description.dependencies))


def _add_unknowns(structure: Element, name: str, unknowns: Sequence[Unknown]) -> None:
    parent = SubElement(structure, name)
    for unknown in unknowns:
        SubElement(parent, "Unknown", {"index": str(unknown[0] + 1), **unknown_attributes(unknown, 1)})


def _add_structure3(structure: Element, description: Description) -> None:
    """Add outputs, derivatives, initial unknowns and event indicators."""
    variables, slopes = description.variables, set(derivative_references(description.variables))
    running = running_unknowns(variables, description.dependencies, description.tunable)
    unknowns = [("ContinuousStateDerivative" if u[0] in slopes else "Output", u) for u in running]
    initial = initial_unknowns(variables, description.dependencies)
    for name, unknown in _folded(variables, [*unknowns, *(("InitialUnknown", u) for u in initial)]):
        attributes = {"valueReference": str(unknown[0]), **unknown_attributes(unknown, 0)}
        SubElement(structure, name, attributes)
    for reference in switch_references(variables):
        SubElement(structure, "EventIndicator", valueReference=str(reference))


def _folded(variables: Sequence[Variable], unknowns: list[tuple[str, Unknown]]) -> list[tuple[str, Unknown]]:
    """Return what arrays depend on, from what their elements depend on."""
    head = {k: first for first in heads_of(variables) for k in range(first, first + _size(variables, first))}
    found: dict[tuple[str, int], dict[int, str]] = {}
    for name, (reference, knowns) in unknowns:
        kinds = found.setdefault((name, head[reference]), {})
        for known, kind in knowns:
            same = kinds.setdefault(head[known], kind) == kind
            kinds[head[known]] = kind if same else "dependent"
    return [(name, (reference, list(kinds.items()))) for (name, reference), kinds in found.items()]


def _size(variables: Sequence[Variable], reference: int) -> int:
    return len(elements_of(variables, reference))


def heads_of(variables: Sequence[Variable]) -> list[int]:
    """Return the value references of scalars and of arrays, which have that of their first element."""
    return [k for k, v in enumerate(variables) if not (v.array and k and variables[k - 1].array == v.array)]


VECTORS = {
    ("x", "y"): "position",
    ("vx", "vy"): "velocity",
    ("tilt_x", "tilt_y"): "tilt",
    ("tilt_rate_x", "tilt_rate_y"): "tilt_rate",
    ("force_x", "force_y"): "force",
    ("moment_x", "moment_y"): "moment",
}
"""Signals that are the elements of an array where an FMU has arrays, and its name."""


def in_arrays(variables: Sequence[Variable], prefix: str) -> tuple[Variable, ...]:
    """Return the variables with inputs and outputs that are elements of a vector marked so."""
    marked, before = list(variables), f"{prefix}." if prefix else ""
    for k, pair in enumerate(pairwise(variables)):
        labels = [variable.name.removeprefix(before) for variable in pair]
        for ends, vector in VECTORS.items():
            station = labels[0].removesuffix(ends[0])
            matches = labels == [station + end for end in ends] and station[-1:] in ("", "_")
            if matches and {variable.causality for variable in pair} in ({"input"}, {"output"}):
                name = structured_name(prefix, station + vector)
                marked[k : k + 2] = [replace(variable, array=name) for variable in pair]
    return tuple(marked)


def in_maps(variables: Sequence[Variable]) -> tuple[Variable, ...]:
    """Return the variables with numbered parameters, as `kxx_1`, `kxx_2`, marked as elements of an array."""
    return tuple(
        replace(variable, array=variable.name.rpartition("_")[0])
        if variable.causality == "parameter"
        else variable
        for variable in variables
    )


def build_description(identifier: str, sources: tuple[str, ...]) -> bytes:
    """Return buildDescription.xml of FMI 3.0: which files below `sources/` make the binary."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    files = SubElement(configuration, "SourceFileSet", language="C99")
    for name in sources:
        SubElement(files, "SourceFile", name=name)
    return to_bytes(root)


def value_attributes(variable: Variable) -> dict[str, str]:
    """Return type, unit, bounds, nominal and start value of a variable."""
    attributes = {} if variable.unit not in QUANTITIES else {"declaredType": QUANTITIES[variable.unit]}
    if variable.unit is not None:
        attributes |= {"unit": variable.unit, **_shown(variable.unit)}
    bounds = {"min": variable.minimum, "max": variable.maximum}
    numbers = {name: bound for name, bound in bounds.items() if math.isfinite(bound)}
    rest = {"nominal": variable.nominal, "start": variable.start}
    numbers |= {name: value for name, value in rest.items() if value is not None}
    return attributes | {name: repr(float(value)) for name, value in numbers.items()}


def variable_attributes(variable: Variable, reference: int) -> dict[str, str]:
    """Return what is said of a variable besides its values."""
    attributes = {
        "name": variable.name,
        "valueReference": str(reference),
        "description": variable.description,
        "causality": variable.causality,
        "variability": variable.variability,
    }
    if variable.causality in ("input", "independent"):  # where FMI fixes `initial`
        return attributes
    return {**attributes, "initial": "calculated" if variable.start is None else "exact"}


def unknown_attributes(unknown: Unknown, first: int) -> dict[str, str]:
    """Return what an unknown depends on, by places among the variables that count from `first`."""
    return {
        "dependencies": " ".join([str(known + first) for known, _ in unknown[1]]),
        "dependenciesKind": " ".join([kind for _, kind in unknown[1]]),
    }


def to_bytes(root: Element) -> bytes:
    """Return the document, indented."""
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True) + b"\n"


def _shown(unit: str) -> dict[str, str]:
    return {"displayUnit": SHOWN[unit]} if unit in SHOWN else {}


# The FMI variables of a model: one list, from which the description, the slave and the tables follow.


ELEMENT = re.compile(r"[A-Za-z_]\w*\[\d+\]", re.ASCII)
"""An element of an array, as FMI spells it: python-control's default labels."""

QUOTABLE = re.compile(r"[\w!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]+", re.ASCII)
"""What may stand between the quotes of an FMI name."""


def fmi_variables(model: Model | Stepped, component: str, start: Mapping[str, float]) -> tuple[Variable, ...]:
    """Return the inputs, outputs and states of `model` as FMI variables, in this order.

    Parameters
    ----------
    model : Model or Stepped
        A Stepped model shows no states.
    component : str
        Identifier in front of the dot of every name; empty for flat names.
    start : mapping of str to float
        Start values of inputs by signal name, in their units; 0 where none is given.

    Raises
    ------
    FmuError
        If two variables would have the same name.
    """
    initial = model.initial_state if isinstance(model, Dynamic) else ()
    states = model.states if isinstance(model, Model) else ()
    variables = (
        *(labelled(component, "input", s, float(start.get(s.name, 0.0))) for s in model.inputs),
        *(labelled(component, "output", s) for s in model.outputs),
        *(labelled(component, "local", s, float(value)) for s, value in zip(states, initial, strict=True)),
    )
    require_unique(variables)
    return variables


def labelled(component: str, causality: str, signal: Scalar, start: float | None = None) -> Variable:
    """Return the variable of a signal of `component`; the name of a state begins with `state_`."""
    prefix = "state_" if causality == "local" else ""
    return Variable(
        name=structured_name(component, prefix + signal.name),
        causality=causality,
        unit=signal.unit,
        nominal=signal.nominal,
        description=signal.description,
        minimum=signal.minimum,
        maximum=signal.maximum,
        start=start,
    )


def structured_name(component: str, label: str) -> str:
    """Return `component.label`, the label quoted where FMI wants it; without a component the label alone.

    Raises
    ------
    FmuError
        If the label has characters that no FMI name may have.
    """
    if label.isidentifier() and label.isascii():
        return to_fmi_name(component, label) if component else label
    before = f"{component}." if component else ""
    if ELEMENT.fullmatch(label):
        return f"{before}{label}"
    if not QUOTABLE.fullmatch(label):
        raise FmuError(
            f"signal names must be of ASCII letters, digits and !#$%&()*+,-./:;<>=?@[]^{{}}|~, got {label!r}"
        )
    return f"{before}'{label}'"


def require_unique(variables: Sequence[Variable]) -> None:
    """Raise FmuError where two variables have the same name."""
    names = [variable.name for variable in variables]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise FmuError(f"model must have signals of different names in an FMU, got {twice} twice")


def references(variables: Sequence[Variable], causality: str) -> list[int]:
    """Return the value references of a causality; of "local" those of the states."""
    return [
        k for k, v in enumerate(variables) if v.causality == causality and v.state is None and not v.switch
    ]


def derivative_references(variables: Sequence[Variable]) -> list[int]:
    """Return the value references of the derivatives of the states."""
    return [k for k, v in enumerate(variables) if v.state is not None]


def switch_references(variables: Sequence[Variable]) -> list[int]:
    """Return the value references of the event indicators."""
    return [k for k, v in enumerate(variables) if v.switch]


# Terminals of FMI 3.0, section 2.4.9: the signals of a journal as one plug, for bearing and rotor
# alike.
#
# A bearing and a rotor have a terminal for each journal with the same members: position, velocity,
# speed and force, each an input of the one and an output of the other. The force is that on the
# journal on both sides, so all members are signals, which are equal in connected terminals.


MOTION = tuple(place_names(list(FREEDOMS)))
FORCES = tuple(force_names(list(FREEDOMS)))
MEMBERS = (*MOTION, "speed", *FORCES)
"""Signals of a journal, whichever of its freedoms a model has."""

FORCE = re.compile(rf"(?:(\w+?)_)?(?:{'|'.join(FORCES)})", re.ASCII)
"""A force or moment at a station, which has a name or none."""

KIND = "_rotorfilm.Mechanical.Translational.Journal"
"""Kinds that a tool defines begin with its name."""

RULE = "bus"
"""Members are matched by name; a damper has no speed, and connects all the same."""

FMI = "3.0"
"""The version whose schema the file follows. FMI 2.0.4 and later take it too."""


Terminals = dict[str, dict[str, str]]
"""By their names, the variables by the names that they have in every terminal, as `force_x`.

A terminal has the name of its station; that of an FMU with one journal is that of the component.
"""


def terminals(component: str, prefix: str, inputs: Sequence[str], outputs: Sequence[str]) -> Terminals:
    """Return the terminals of a model: a station has force and motion, the one as input, the other as output.

    Parameters
    ----------
    component : str
        Name of the FMU.
    prefix : str
        What stands before the dot of its variables; empty where their names are flat.
    inputs, outputs : sequence of str
        Names of the signals.
    """
    found: Terminals = {}
    known = {*inputs, *outputs}
    for station in _stations((*inputs, *outputs)):
        own = {member: f"{station}_{member}" if station else member for member in MEMBERS}
        if own["speed"] not in known:
            own["speed"] = "speed"
        given = {member: name for member, name in own.items() if name in known}
        # A motion that comes in and a force that goes out are one side of a journal, the reverse the other.
        sides = {
            (name in inputs) == (member in MOTION) for member, name in given.items() if member != "speed"
        }
        if len(sides) == 1 and not set(MOTION).isdisjoint(given):
            named = {member: structured_name(prefix, name) for member, name in given.items()}
            found[station or component] = named
    return found


def terminal_files(
    model: Model | Stepped,
    component: str,
    variables: Sequence[Variable],
    prefix: str,
    icon: bool,
    sampled: tuple[str, str] | None = None,
) -> dict[str, bytes]:
    """Return terminalsAndIcons.xml by its path; nothing where there are neither terminals nor an icon.

    With `sampled`, as in a `NativeSpec`, it has a terminal of the map, and FMI-LS-STRUCT a manifest.
    """
    found = terminals(component, prefix, names(model.inputs), names(model.outputs))
    arrays = {v.name: v.array for v in variables if v.array}
    found = {name: _vectors(members, arrays) for name, members in found.items()}
    members = _map_members(variables, prefix, sampled) if sampled else []
    files = {f"{STRUCT}/fmi-ls-manifest.xml": struct_manifest()} if members else {}
    if found or icon or members:
        files["terminalsAndIcons/terminalsAndIcons.xml"] = terminals_and_icons(
            found, icon, members, f"{component}_map"
        )
    return files


STRUCT = "extra/org.fmi-standard.fmi-ls-struct"
"""Folder of the layered standard FMI-LS-STRUCT 1.0.0-rc.1, whose terminals are sampled maps."""

STRUCT_KIND = "org.fmi-standard.fmi-ls-struct.map"


def struct_manifest() -> bytes:
    """Return fmi-ls-manifest.xml of FMI-LS-STRUCT."""
    told = {
        "name": "org.fmi-standard.fmi-ls-struct",
        "version": "1.0.0-rc.1",
        "description": "Layered standard for structuring of variables",
    }
    return to_bytes(Element("fmiLayeredStandardManifest", manifest_attributes(told)))


def manifest_attributes(told: Mapping[str, str]) -> dict[str, str]:
    """Return the attributes of the manifest of a layered standard: its name, version and description."""
    attributes = {f"fmi-ls:fmi-ls-{name}": value for name, value in told.items()}
    return {"xmlns:fmi-ls": "http://fmi-standard.org/fmi-ls-manifest", **attributes}


def _map_members(
    variables: Sequence[Variable], prefix: str, sampled: tuple[str, str]
) -> list[tuple[str, str, str]]:
    """Return name, variable and kind of the members of a map: sampling points, the input there, values."""
    arrays = dict.fromkeys(v.array for v in variables if v.array and v.causality == "parameter")
    before = f"{prefix}." if prefix else ""
    points, place = sampled
    kinds = {f"{before}{points}": "domain", f"{before}{place}": "domainInput"}
    kinds |= {array: "codomain" for array in arrays if array not in kinds}
    return [(name.removeprefix(before), name, kind) for name, kind in kinds.items()] if arrays else []


def _vectors(members: dict[str, str], arrays: Mapping[str, str]) -> dict[str, str]:
    """Return the members of a terminal with arrays in place of their elements."""
    vector = {element: name for pair, name in VECTORS.items() for element in pair}
    return {
        vector[member] if variable in arrays else member: arrays.get(variable, variable)
        for member, variable in members.items()
    }


def _stations(labels: Sequence[str]) -> list[str]:
    """Return the stations with a force, in order; the empty name is that of the only one."""
    matches = [FORCE.fullmatch(label) for label in labels]
    return list(dict.fromkeys(match[1] or "" for match in matches if match))


def terminals_and_icons(
    found: Terminals, icon: bool, map_members: Sequence[tuple[str, str, str]] = (), map_name: str = ""
) -> bytes:
    """Return terminalsAndIcons.xml: the size of icon.png on a diagram, if there is one, and the terminals."""
    root = Element("fmiTerminalsAndIcons", fmiVersion=FMI)
    if icon:
        corners = {"x1": "-100", "y1": "-100", "x2": "100", "y2": "100"}
        graphics = SubElement(root, "GraphicalRepresentation")
        SubElement(graphics, "CoordinateSystem", {**corners, "suggestedScalingFactorTo_mm": "0.1"})
        SubElement(graphics, "Icon", corners)
    if found or map_members:
        parent = SubElement(root, "Terminals")
        described = {"terminalKind": KIND, "description": "motion of the journal and force on it"}
        for name, members in found.items():
            element = SubElement(parent, "Terminal", {"name": name, "matchingRule": RULE, **described})
            for member, variable in members.items():
                own = {"variableName": variable, "memberName": member}
                SubElement(element, "TerminalMemberVariable", {**own, "variableKind": "signal"})
        if map_members:
            kind = {"terminalKind": f"{STRUCT_KIND}.rectilinearGrid", "matchingRule": STRUCT_KIND}
            element = SubElement(parent, "Terminal", {"name": map_name, **kind})
            for member, variable, role in map_members:
                own = {"variableName": variable, "memberName": member}
                SubElement(
                    element, "TerminalMemberVariable", {**own, "variableKind": f"{STRUCT_KIND}.{role}"}
                )
    return to_bytes(root)
