"""Rotors saved by ROSS: `rotor.save("rotor.toml")` there, `read_ross("rotor.toml")` here.

For the TOML and JSON files of ROSS 1 to 3 (https://github.com/petrobras/ross); tested with 2.3.0 and 3.1.0.
Its axes and its sense of rotation are those used here: x to the right, y up, rotation from x to y.
"""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from inspect import signature
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from .. import rotors
from ..analysis import coefficients
from ..bearings.linear import LinearBearing, TabulatedBearing
from ..bearings.linear_system import FrequencyDependentReaction
from ..bearings.seal import AnnularSeal
from ..core.errors import InputError
from ..core.files import read_text
from ..core.inputs import arguments
from ..core.model import Array
from ..core.port import PlanarReaction, require_massless, require_reaction
from ..core.results import Coefficients, added_mass

if TYPE_CHECKING:
    from ross import BearingElement, Rotor

MODAL = ("modal_damping_ratio", "default_damping_ratio")
"""Damping ratios that ROSS 3 gives the modes of a rotor, among its parameters."""

PRESENT = ("rotary_inertia", "gyroscopic")
"""Effects that a ShaftRotor always has."""

ANISOTROPIC = (
    "a part that turns and is not the same in all directions has coefficients that vary with the angle of "
    "the shaft, and those of a ShaftRotor are constant; give it the mean of both directions, or describe an "
    "anisotropic shaft as a CrackedRotor with an OpenCrack"
)
"""Why read_ross refuses such parts, and how to go on."""


@dataclass(frozen=True, kw_only=True)
class RossRotor:
    """Rotor and bearings from a file of ROSS.

    Attributes
    ----------
    rotor : ShaftRotor
        Rotor with a station for each bearing, in the order of the file, and the classical beam element.
    bearings : dict of str to PlanarReaction
        Bearings by station: LinearBearing, TabulatedBearing where the file has a table over speed, or a
        reaction with an added mass where it has mxx to myy.
    """

    rotor: rotors.ShaftRotor
    bearings: dict[str, LinearBearing | TabulatedBearing | FrequencyDependentReaction]


@arguments
def read_ross(path: str | Path, *, speed: float | rotors.SpeedProfile = 0.0) -> RossRotor:
    """Return the rotor in a TOML or JSON file that ROSS saved.

    Parameters
    ----------
    path : str or Path
        File to read; JSON if it ends in `.json`, otherwise TOML.
    speed : float or SpeedProfile [rad/s]
        Speed of the rotor; the file has none.

    Raises
    ------
    InputError
        If the file is no such file, or has something that a ShaftRotor cannot represent. This is modal
        damping, no rotary inertia, masses of bearings over speed, supports over speed, and damping by the
        stiffness of an axial force or a torque. It is also couplings that damp, couplings and disks that are
        anisotropic, and point masses with two masses.

    Notes
    -----
    A bearing with `n_link`, the point mass and the bearing on that node become a `Support` in series. Two
    shaft elements between the same nodes become one `LayeredElement`, whose layers stay together along their
    whole length; those of ROSS are tied at the nodes only, which is a little softer on a coarse mesh.

    Proportional damping `alpha`, `beta` of the whole rotor becomes that of the `ShaftRotor`, and of its
    supports; damping of shaft elements stays with the elements and excludes the disks. As in ROSS, damping of
    the whole rotor replaces that of the elements.
    """
    return _from_file(Path(path), partial(_read, speed=speed))


@arguments
def read_ross_bearings(
    path: str | Path,
) -> dict[str, LinearBearing | TabulatedBearing | FrequencyDependentReaction]:
    """Return the bearings in a TOML or JSON file of ROSS, as `bearing.save("bearing.toml")` writes it there.

    Parameters
    ----------
    path : str or Path
        File of one bearing or several, or of a rotor, whose bearings alone are read.

    Returns
    -------
    dict of str to PlanarReaction
        As `RossRotor.bearings`.

    Raises
    ------
    InputError
        If the file is no such file, has no bearing, or has one as `read_ross` refuses it.
    """
    return _from_file(Path(path), _bearings)


Found = TypeVar("Found")


def _from_file(file: Path, take: Callable[[Path, dict[str, Any]], Found]) -> Found:
    """Return what is taken from the tables of a file."""
    form, read = ("JSON", json.loads) if file.suffix.lower() == ".json" else ("TOML", tomllib.loads)
    try:
        data = read(read_text(file))
    except (tomllib.TOMLDecodeError, json.JSONDecodeError) as wrong:
        raise InputError(f"{file} must be {form}, got {wrong}") from None
    if not isinstance(data, dict):
        raise InputError(f"{file} must have named elements, got a {type(data).__name__}")
    try:
        return take(file, data)
    except KeyError as missing:
        raise InputError(f"{file} must have the key {missing} in each of its elements") from None
    except InputError:
        raise
    except (TypeError, ValueError) as wrong:
        raise InputError(
            f"{file} must have numbers, and as many coefficients as speeds, got {wrong}"
        ) from wrong


def _bearings(
    file: Path, data: RossTable
) -> dict[str, LinearBearing | TabulatedBearing | FrequencyDependentReaction]:
    tables = {name: table for name, table in data.items() if isinstance(table, dict) and "kxx" in table}
    if not tables:
        raise InputError(f"{file} must have a bearing with the coefficient kxx, got {list(data)}")
    found = enumerate(over_speed(data, tables).items())
    return {_identifier(name, k): read_bearing(name, table) for k, (name, table) in found}


def _read(file: Path, data: RossTable, speed: float | rotors.SpeedProfile) -> RossRotor:
    tables = {name: table for name, table in data.items() if isinstance(table, dict) and name != "parameters"}
    alpha, beta = _whole_damping(file, data.get("parameters", {}))
    couplings = _of(tables, "CouplingElement")
    pieces: list[tuple[int, rotors.ShaftElement | rotors.Coupling]] = [
        *(
            (table["n"], _element(name, table, beta, own=not (alpha or beta)))
            for name, table in _of(tables, "ShaftElement").items()
        ),
        *((table["n"], _coupling(name, table)) for name, table in couplings.items()),
    ]
    chain = _chain(file, pieces)
    known = ("ShaftElement_", "CouplingElement_", "DiskElement_", "PointMass_")
    rest = {n: t for n, t in over_speed(data, tables).items() if not n.startswith(known)}
    housings = _supports(chain, _of(tables, "PointMass"), rest, alpha)
    stations = {
        _identifier(name, k): (name, table)
        for k, (name, table) in enumerate(rest.items())
        if table.get("n") not in housings
    }
    bearings = {label: read_bearing(name, table) for label, (name, table) in stations.items()}
    rotor = rotors.ShaftRotor(
        elements=chain,
        disks=_disks(_of(tables, "DiskElement"), couplings),
        stations=tuple(
            rotors.Station(node=table["n"], name=label, support=_support_of(name, table, housings))
            for label, (name, table) in stations.items()
        ),
        speed=speed,
        beam=rotors.ClassicalBeam(),
        mass_damping=alpha,
        stiffness_damping=beta,
    )
    return RossRotor(rotor=rotor, bearings=bearings)


def _whole_damping(file: Path, parameters: RossTable) -> tuple[float, float]:
    """Return alpha [1/s] and beta [s] of the whole rotor; raise where its modes have ratios instead."""
    for key in MODAL:
        if np.any(parameters.get(key) or 0.0):
            raise InputError(f"{key} must be 0, got {parameters[key]!r} among the parameters of {file}")
    return float(parameters.get("alpha", 0.0)), float(parameters.get("beta", 0.0))


def _of(tables: Mapping[str, dict[str, Any]], kind: str) -> dict[str, dict[str, Any]]:
    return {name: table for name, table in tables.items() if name.startswith(f"{kind}_")}


def _disks(disks: Mapping[str, RossTable], couplings: Mapping[str, RossTable]) -> tuple[rotors.Disk, ...]:
    """Return the disks, and both sides of each coupling as disks."""
    for name, table in disks.items():
        others = [key for key in table if key.startswith("I") and key not in ("Id", "Ip")]
        if others or np.ndim(table.get("Id", 0.0)):
            key = others[0] if others else "Id"
            raise InputError(
                f"Id and Ip must be numbers and alone, got {key} = {table[key]!r} in {name!r}: {ANISOTROPIC}"
            )
    sides = ((side, f"_{end}", t) for t in couplings.values() for side, end in enumerate("lr"))
    return tuple(
        rotors.Disk(
            node=int(t["n"]) + side,
            mass=t[f"m{end}"],
            diametral_inertia=t[f"Id{end}"],
            polar_inertia=t[f"Ip{end}"],
        )
        for side, end, t in (*((0, "", t) for t in disks.values()), *sides)
    )


def _coupling(name: str, table: RossTable) -> rotors.Coupling:
    for kind in ("kt", "kr"):
        x, y = table[f"{kind}_x"], table[f"{kind}_y"]
        if x != y:
            raise InputError(f"{kind}_x must be {kind}_y, got {x!r} and {y!r} in {name!r}: {ANISOTROPIC}")
    damped = [key for key in ("ct_x", "ct_y", "cr_x", "cr_y") if table.get(key)]
    if damped:
        raise InputError(f"{damped[0]} must be 0, got {table[damped[0]]!r} in {name!r}")
    return rotors.Coupling(stiffness=table["kt_x"], tilt_stiffness=table["kr_x"])


def _element(name: str, table: RossTable, beta: float, *, own: bool) -> rotors.ShaftElement:
    """Return an element with its own proportional damping, or beside beta [s] of the whole rotor."""
    alpha, beta = (table.get("alpha", 0.0), table.get("beta", 0.0)) if own else (0.0, beta)
    if beta and (table.get("axial_force") or table.get("torque")):
        raise InputError(
            f"beta must be 0 beside an axial force or a torque, whose stiffness ROSS damps too, got {beta!r} "
            f"in {name!r}"
        )
    for key in PRESENT:
        if not table.get(key, True):
            raise InputError(f"{key} must be true, got {table[key]!r} in {name!r}")
    shears = table.get("shear_effects", True)
    if shears and table.get("shear_method_calc", "cowper") != "cowper":
        raise InputError(
            f"shear_method_calc must be 'cowper', got {table['shear_method_calc']!r} in {name!r}"
        )
    material = table["material"]
    return rotors.ShaftElement(
        length=table["L"],
        outer_diameter=table["odl"],
        inner_diameter=table["idl"],
        end_outer_diameter=table["odr"],
        end_inner_diameter=table["idr"],
        material=rotors.ElasticMaterial(
            young_modulus=material["E"], shear_modulus=material["G_s"], density=material["rho"]
        ),
        shear_coefficient=None if shears else math.inf,
        axial_force=table.get("axial_force", 0.0),
        torque=table.get("torque", 0.0),
        mass_damping=alpha if own else 0.0,
        stiffness_damping=beta if own else 0.0,
    )


def _chain(
    file: Path, pieces: list[tuple[int, rotors.ShaftElement | rotors.Coupling]]
) -> tuple[rotors.ShaftElement | rotors.LayeredElement | rotors.Coupling, ...]:
    """Return the elements from node to node; those between the same two nodes are layers of one."""
    ordered = sorted(pieces, key=lambda item: item[0])
    chain: list[rotors.ShaftElement | rotors.LayeredElement | rotors.Coupling] = []
    for node, group in groupby(ordered, key=lambda item: item[0]):
        between = [piece for _, piece in group]
        layers = tuple(piece for piece in between if isinstance(piece, rotors.ShaftElement))
        if node != len(chain):
            raise InputError(f"{file} must have a ShaftElement at every node, got none at node {len(chain)}")
        if len(between) > 1 and len(layers) < len(between):
            raise InputError(f"{file} must have no shaft element beside a coupling, got one at node {node}")
        chain.append(rotors.LayeredElement(layers=layers) if len(layers) > 1 else between[0])
    if not chain:
        raise InputError(f"{file} must have a ShaftElement, got none")
    return tuple(chain)


def _supports(
    chain: tuple[rotors.ShaftElement | rotors.LayeredElement | rotors.Coupling, ...],
    masses: Mapping[str, RossTable],
    bearings: Mapping[str, RossTable],
    alpha: float,
) -> dict[int, rotors.Support]:
    """Return the housings that carry bearings, by the node that ROSS gives them beyond the shaft's.

    Their masses have the proportional damping alpha [1/s] of the whole rotor.
    """
    found = {}
    for mass_name, mass in masses.items():
        node = mass["n"]
        if node <= len(chain):
            raise InputError(
                f"n must be beyond the shaft's nodes for a point mass, got {node!r} in {mass_name!r}"
            )
        if mass["mx"] != mass["my"]:
            raise InputError(
                f"mx must be my, got {mass['mx']!r} and {mass['my']!r} in {mass_name!r}: a Support has one "
                "mass; put the bearing into a Series whose outer reaction has the difference as an added mass"
            )
        below = [(name, table) for name, table in bearings.items() if table.get("n") == node]
        if len(below) != 1:
            raise InputError(
                f"n of one bearing to the ground must be that of {mass_name!r}, got {len(below)}"
            )
        spring = read_bearing(*below[0])
        if not isinstance(spring, LinearBearing):
            raise InputError(f"frequency must be absent for a support, got a table in {below[0][0]!r}")
        damping = np.asarray(spring.damping) + alpha * mass["mx"] * np.eye(2)
        found[node] = rotors.Support(
            mass=mass["mx"], stiffness=np.asarray(spring.stiffness).tolist(), damping=damping.tolist()
        )
    return found


def _support_of(name: str, table: RossTable, supports: Mapping[int, rotors.Support]) -> rotors.Support | None:
    link = table.get("n_link")
    if link is None:
        return None
    if link not in supports:
        raise InputError(
            f"n_link must be the node of a point mass {sorted(supports)}, got {link!r} in {name!r}"
        )
    return supports[link]


def _identifier(name: str, number: int) -> str:
    """Return the name of a station for `BearingElement_Drive end`: `drive_end`."""
    tag = re.sub(r"\W+", "_", name.partition("_")[2]).strip("_").lower()
    return tag if tag.isidentifier() else f"bearing_{number}"


# Bearings of rotorfilm as elements of ROSS (https://github.com/petrobras/ross), the optional extra `ross`.
#
# Tested with ROSS 2.3.0 and 3.1.0.


ENTRIES = {"xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1)}


@arguments
def to_ross(
    bearing: LinearBearing | TabulatedBearing | AnnularSeal | FrequencyDependentReaction,
    node: int,
    *,
    speed: float | None = None,
    tag: str | None = None,
) -> BearingElement:
    """Return stiffness and damping of a bearing, over speed if it has a table, as a bearing of ROSS.

    Both have the same axes: x to the right, y up, rotation from x to y; a load of [0, -W] is a weight. Give a
    film as `coefficient_table(film, load, speeds)`.

    Parameters
    ----------
    bearing : LinearBearing, TabulatedBearing, or one with an added mass
        As an `AnnularSeal`, which is taken with its added mass at the speed.
    node : int
        Node of the rotor of ROSS.
    speed : float [rad/s]
        Speed of the shaft, for an `AnnularSeal`.
    tag : str, optional
        Name of the element.

    Returns
    -------
    ross.BearingElement
        ROSS interpolates with its own spline and may extrapolate, where `TabulatedBearing` raises an error.

    Raises
    ------
    InputError
        If ROSS cannot be imported, the bearing has no such coefficients, or its table has too few speeds.
    """
    require_reaction("bearing", bearing, planar=True, heavy=True)
    tables = _terms(bearing, speed)
    values: dict[str, Any] = {
        f"{letter}{entry}": table[..., row, column].tolist()
        for letter, table in tables.items()
        for entry, (row, column) in ENTRIES.items()
    }
    speeds = np.asarray(bearing.speeds) if isinstance(bearing, TabulatedBearing) else None
    if speeds is not None and len(speeds) < 4:
        raise InputError(
            f"speeds must be at least 4 numbers, which ROSS needs to interpolate, got {len(speeds)}"
        )
    element = _ross().BearingElement
    if speeds is not None:
        # From 3 on what ROSS calls frequency is that of the whirl.
        values["speed" if "speed" in signature(element).parameters else "frequency"] = speeds
    return element(n=node, tag=tag, **values)


def _terms(bearing: Any, speed: float | None) -> dict[str, Array]:
    """Return stiffness k, damping c and, where there is one, added mass m of a bearing."""
    if isinstance(bearing, LinearBearing | TabulatedBearing):
        return {"k": np.asarray(bearing.stiffness), "c": np.asarray(bearing.damping)}
    if isinstance(bearing, AnnularSeal):
        if speed is None:
            raise InputError("speed is required for an AnnularSeal, got none")
        found = coefficients(bearing, np.zeros(2), speed)
        return {"k": found.stiffness, "c": found.damping, "m": added_mass(found)}
    if isinstance(bearing, FrequencyDependentReaction) and not (bearing.states or np.size(bearing.speeds)):
        held = {"k": -np.asarray(bearing.D), "c": bearing.damping, "m": bearing.added_mass}
        return {letter: np.asarray(table) for letter, table in held.items()}
    raise InputError(f"bearing must be a LinearBearing, a TabulatedBearing or a seal, got {bearing!r}")


@arguments
def to_ross_force(
    rotor: Rotor, films: Mapping[int, PlanarReaction], rests: Mapping[int, Coefficients]
) -> Callable[..., Array]:
    """Return the nonlinear part of film forces, for `add_to_RHS` of ROSS's time response.

    The rotor of ROSS has a bearing `to_ross(LinearBearing(...))` of the film's stiffness K and damping C at
    each of these nodes, and its motion counts from the equilibrium, where ROSS starts, so that no weight is
    given. The force is F(q0 + d, v) - F(q0, 0) + K d + C v: together with the linear part in the matrices of
    ROSS it is the film force at any displacement d. ROSS takes it at the start of a step, or iterates it
    (`newmark_type="robust"`). The speed is that of the coefficients.

    Parameters
    ----------
    rotor : ross.Rotor
    films : mapping of int to PlanarReaction
        Films by node.
    rests : mapping of int to Coefficients
        Equilibrium of each journal with its K and C, as `coefficients` or a `RotorEquilibrium` has them.

    Returns
    -------
    callable
        `rotor.run_time_response(speed, F, t, method="newmark", add_to_RHS=...)`.

    Raises
    ------
    InputError
        If a film has no place of rest.
    FilmContactError
        From ROSS's run, where a journal meets the wall.
    """
    if set(films) != set(rests):
        raise InputError(f"rests must have the nodes of the films {sorted(films)}, got {sorted(rests)}")
    for node, film in films.items():
        require_massless(f"films[{node}]", film)
    places = {node: int(node) * int(rotor.number_dof) for node in films}
    static = {
        node: film.force(rests[node].position, np.zeros(2), rests[node].speed) for node, film in films.items()
    }

    def beyond(step: int, *, disp_resp: Array, velc_resp: Array, **state: object) -> Array:
        added = np.zeros(int(rotor.ndof))
        for node, film in films.items():
            at, where = rests[node], slice(places[node], places[node] + 2)
            moved, moving = disp_resp[where], velc_resp[where]
            force = film.force(at.position + moved, moving, at.speed)
            added[where] = force - static[node] + at.stiffness @ moved + at.damping @ moving
        return added

    return beyond


def _ross() -> Any:
    try:
        import ross
    except ImportError as missing:
        raise InputError(f"ross must be installed, `pip install 'rotorfilm[ross]'`, got {missing}") from None
    return ross


# Bearings in files of ROSS: coefficients, constant or over speed.


RossTable = Mapping[str, Any]


def over_speed(data: RossTable, tables: Mapping[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Return the tables with one axis, named as in ROSS 1 and 2, whose `frequency` is the speed.

    From 3 on `frequency` is that of the whirl, which no table over speed has.
    """
    found = {}
    for name, table in tables.items():
        speed, whirl = table.get("speed"), table.get("frequency")
        if whirl is not None and (speed is not None or str(data.get("ross_version", "2")) >= "3"):
            raise InputError(f"speed must be the only axis of the coefficients, got frequency in {name!r}")
        found[name] = table if speed is None else {**table, "frequency": speed}
    return found


def read_bearing(
    name: str, table: RossTable
) -> LinearBearing | TabulatedBearing | FrequencyDependentReaction:
    """Return the bearing of a table, whose `frequency` is the speed; see `over_speed`."""
    if "kxx" not in table:
        raise InputError(
            f"{name!r} must be a shaft element, a disk or have the coefficient kxx, got {list(table)}"
        )
    stiffness, damping = (_entries(table, letter) for letter in "kc")
    masses = np.array([np.asarray(table.get(f"m{entry}", 0.0)).ravel()[0] for entry in ENTRIES])
    uneven = any(np.ptp(np.asarray(table.get(f"m{entry}", 0.0))) for entry in ENTRIES)
    if masses.any() and (uneven or len(stiffness) > 1 or len(damping) > 1):
        raise InputError(f"mxx, mxy, myx, myy must be 0 beside coefficients over speed, got {name!r}")
    if masses.any():
        return FrequencyDependentReaction(
            A=np.zeros((0, 0)),
            B=np.zeros((0, 2)),
            C=np.zeros((2, 0)),
            D=-stiffness[0],
            damping=damping[0],
            added_mass=masses.reshape(2, 2),
        )
    if len(stiffness) == len(damping) == 1:
        return LinearBearing(stiffness=stiffness[0], damping=damping[0])
    speeds = np.asarray(table.get("frequency", ()), dtype=float)
    if len(speeds) < 2:
        raise InputError(
            f"frequency must go with the coefficients, got {table.get('frequency')!r} in {name!r}"
        )
    whole = [np.broadcast_to(t, (len(speeds), 2, 2)) for t in (stiffness, damping)]
    return TabulatedBearing(speeds=speeds, stiffness=whole[0], damping=whole[1])


def _entries(table: RossTable, letter: str) -> np.ndarray:
    """Return the coefficients k or c, shape (n, 2, 2); ROSS leaves out what it can guess."""
    main = table[f"{letter}xx"]
    cross = np.zeros_like(np.atleast_1d(main))
    found = (table.get(f"{letter}{entry}", main if entry[0] == entry[1] else cross) for entry in ENTRIES)
    columns = np.broadcast_arrays(*(np.atleast_1d(np.asarray(entry, dtype=float)) for entry in found))
    return np.stack(columns, axis=-1).reshape(-1, 2, 2)
