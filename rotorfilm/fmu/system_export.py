"""A rotor and the films under it as one file of SSP: FMUs, their connections, and their parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement

from ..core.errors import InputError, require_positive
from ..core.files import write_atomically
from ..core.inputs import arguments, require_choice
from ..core.model import Dynamic, Model, Stepped
from ..core.port import require_massless
from ..core.units import UNITS
from .archive import read_description, to_zip
from .description import FORCES, Terminals, terminals, to_bytes
from .export import export_fmu

if TYPE_CHECKING:
    import control

ROTOR = "rotor"
FILM = "film"
"""Name of the only film; of several each has the name of its station."""


Connection = tuple[str, str, str, str]
"""An output that goes into an input: component and variable of the one, then those of the other."""


class Part(NamedTuple):
    """An FMU of the system: its name, its file, its variables by name, its terminals by name."""

    name: str
    content: bytes
    variables: dict[str, Any]
    terminals: Terminals

    @property
    def source(self) -> str:
        """Path of the FMU in the archive."""
        return f"resources/{self.name}.fmu"


@arguments
def export_ssp(
    rotor: Dynamic | control.StateSpace,
    films: Model | Stepped | Mapping[str, Model | Stepped],
    path: str | Path,
    version: str = "2.0",
    *,
    ssp: str = "1.0",
    platforms: str = "host",
    start: Mapping[str, Mapping[str, float]] | None = None,
    stop_time: float = 0.1,
    step_size: float = 1e-4,
) -> Path:
    """Write a rotor and the films under it as one system of SSP 1.0, which tools of SSP 2.0 read too.

    The file contains an FMU of each (in `resources/`), with variable names without the component. It also has
    the connections of each station (position, velocity and speed to the film, force to the rotor), and a
    parameter set with all parameter values. The components are called `rotor`, and `film` or by the names of
    the stations.

    Parameters
    ----------
    rotor : Dynamic or control.StateSpace
        Rotor with inputs `force_x`, `force_y` and outputs `x`, `y`, `vx`, `vy` of each station.
    films : Model or Stepped, or a mapping of stations to these
        Bearings or dampers.
    path : str or Path
        File to write, ending in `.ssp`; its folder is made if need be.
    ssp : str
        Version of SSP, "1.0" or "2.0". Tools of SSP 2.0 read both. Only 2.0 has `Float64`, the type of the
        numbers of FMI 3.0.
    version, platforms : str
        Version and platforms as in `export_fmu`.
    start : mapping of str to mapping of str to float, optional
        Start values of inputs [SI] by component and signal.
    stop_time, step_size : float [s]
        Default experiment.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    InputError
        If an argument breaks its rule, a film has no journal, or the rotor lacks a station or what a film
        takes.
    FmuError
        If a model cannot be exported.
    """
    target = Path(path)
    if target.suffix != ".ssp":
        raise InputError(f"path must end in .ssp, got {str(path)!r}")
    require_choice("ssp", ssp, VERSIONS)
    for argument, value in (("stop_time", stop_time), ("step_size", step_size)):
        require_positive(argument, value)
    stations = films if isinstance(films, Mapping) else {"": films}
    for station, film in stations.items():
        require_massless(f"films[{station!r}]" if station else "films", film)
    models: dict[str, Any] = {ROTOR: rotor, **{station or FILM: film for station, film in stations.items()}}
    starts = _starts(models, start or {})
    with TemporaryDirectory() as folder:
        parts = {}
        for name, model in models.items():
            file = Path(folder) / f"{name}.fmu"
            export_fmu(
                model,
                file,
                version,
                platforms=platforms,
                component=name,
                start=starts[name],
                stop_time=stop_time,
                step_size=step_size,
                flat_names=True,
            )
            parts[name] = _part(name, file)
    connections = [link for station in stations for link in _connected(parts, station)]
    target.parent.mkdir(parents=True, exist_ok=True)
    return write_atomically(
        target, to_zip(_contents(target.stem, parts, connections, float(stop_time), Format(ssp, version)))
    )


def _starts(
    models: Mapping[str, Any], start: Mapping[str, Mapping[str, float]]
) -> dict[str, Mapping[str, float]]:
    for name in start:
        if name not in models:
            raise InputError(f"start must have keys from the components {list(models)}, got {name!r}")
    return {name: start.get(name, {}) for name in models}


def _part(name: str, file: Path) -> Part:
    described = read_description(str(file)).modelVariables
    labels = {
        side: [variable.name for variable in described if variable.causality == side]
        for side in ("input", "output")
    }
    found = terminals(name, "", labels["input"], labels["output"])
    return Part(name, file.read_bytes(), {variable.name: variable for variable in described}, found)


def _connected(parts: Mapping[str, Part], station: str) -> list[Connection]:
    """Return the connections of a station: every member that one side gives and the other takes."""
    name = station or FILM
    rotor, film = parts[ROTOR].terminals.get(station or ROTOR), parts[name].terminals.get(name)
    given = {} if film is None else parts[name].variables
    forces = [label for member, label in (film or {}).items() if member in FORCES]
    if film is None or any(given[label].causality == "input" for label in forces):
        raise InputError(f"films must take the motion of a journal and give its force, got none in {name!r}")
    if rotor is None:
        stations = list(parts[ROTOR].terminals)
        raise InputError(f"rotor must have the station of each film, got {stations} without {name!r}")
    missing = [member for member in film if member not in rotor]
    if missing:
        raise InputError(f"rotor must have the signals of {name!r}, got {list(rotor)} without {missing}")
    return [
        (ROTOR, rotor[member], name, label)
        if given[label].causality == "input"
        else (name, label, ROTOR, rotor[member])
        for member, label in film.items()
    ]


def _contents(
    name: str, parts: Mapping[str, Part], connections: list[Connection], stop_time: float, form: Format
) -> dict[str, bytes]:
    """Return the files of the archive by path."""
    joined = {(end, label) for link in connections for end, label in (link[:2], link[2:])}
    components = [
        part._replace(
            variables={
                label: variable
                for label, variable in part.variables.items()
                if (part.name, label) in joined or variable.causality == "parameter"
            }
        )
        for part in parts.values()
    ]
    parameters = [
        (f"{part.name}.{variable.name}", variable)
        for part in components
        for variable in part.variables.values()
        if variable.causality == "parameter"
    ]
    return {
        "SystemStructure.ssd": system_structure(name, components, connections, stop_time, form),
        PARAMETERS: parameter_set(name, parameters, form),
        **{part.source: part.content for part in components},
    }


# SystemStructure.ssd and a parameter set of SSP: components, connections, parameters, units.


VERSIONS = ("1.0", "2.0")


class Format(NamedTuple):
    """Versions of SSP and of FMI."""

    ssp: str = "1.0"
    fmi: str = "2.0"

    @property
    def real(self) -> str:
        """What a number is called."""
        return "Real" if self.ssp == "1.0" or self.fmi == "2.0" else "Float64"


NAMESPACES = {
    f"xmlns:{short}": f"http://ssp-standard.org/SSP1/SystemStructure{name}"
    for short, name in (("ssc", "Common"), ("ssd", "Description"), ("ssv", "ParameterValues"))
}
PARAMETERS = "resources/parameters.ssv"


def system_structure(
    name: str,
    components: Sequence[Part],
    connections: Sequence[Connection],
    stop_time: float,
    form: Format,
) -> bytes:
    """Return SystemStructure.ssd.

    Parameters
    ----------
    name : str
        Name of the system.
    components : sequence of Part
        Components with the variables that are connected, and all parameters.
    connections : sequence of Connection
    stop_time : float [s]
        Stop time of the default experiment.
    form : Format
    """
    root = Element("ssd:SystemStructureDescription", {**NAMESPACES, "version": form.ssp, "name": name})
    system = SubElement(root, "ssd:System", name=name)
    bindings = SubElement(system, "ssd:ParameterBindings")
    SubElement(bindings, "ssd:ParameterBinding", source=PARAMETERS)
    elements = SubElement(system, "ssd:Elements")
    for component in components:
        _add_component(elements, component, form.real)
    parent = SubElement(system, "ssd:Connections")
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    for link in connections:
        SubElement(parent, "ssd:Connection", dict(zip(ends, link, strict=True)))
    used = [variable for component in components for variable in component.variables.values()]
    _add_units(SubElement(root, "ssd:Units"), used)
    SubElement(root, "ssd:DefaultExperiment", startTime="0.0", stopTime=repr(stop_time))
    return to_bytes(root)


def parameter_set(name: str, parameters: Sequence[tuple[str, Any]], form: Format) -> bytes:
    """Return the values of parameters: a file of SSP with their names and fmpy's variables."""
    root = Element("ssv:ParameterSet", {**NAMESPACES, "version": form.ssp, "name": name})
    parent = SubElement(root, "ssv:Parameters")
    for label, variable in parameters:
        parameter = SubElement(parent, "ssv:Parameter", name=label)
        SubElement(parameter, f"ssv:{form.real}", {"value": variable.start, **_unit(variable)})
    _add_units(SubElement(root, "ssv:Units"), [variable for _, variable in parameters])
    return to_bytes(root)


def _add_component(elements: Element, component: Part, real: str) -> None:
    kind = {"type": "application/x-fmu-sharedlibrary", "implementation": "CoSimulation"}
    attributes = {"name": component.name, "source": component.source, **kind}
    connectors = SubElement(SubElement(elements, "ssd:Component", attributes), "ssd:Connectors")
    for variable in component.variables.values():
        connector = SubElement(connectors, "ssd:Connector", name=variable.name, kind=variable.causality)
        SubElement(connector, f"ssc:{real}", _unit(variable))


def _add_units(parent: Element, variables: Iterable[Any]) -> None:
    for name in sorted({variable.unit for variable in variables if variable.unit}):
        unit = SubElement(parent, "ssc:Unit", name=name)
        powers = {base: str(power) for base, power in UNITS[name].exponents.items()}
        SubElement(unit, "ssc:BaseUnit", powers)


def _unit(variable: Any) -> dict[str, str]:
    return {"unit": variable.unit} if variable.unit else {}
