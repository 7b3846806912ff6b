"""Rotors saved by ROSS: `rotor.save("rotor.toml")` there, `read_ross("rotor.toml")` here.

For the TOML and JSON files of ROSS 1 to 3 (https://github.com/petrobras/ross); tested with 2.3.0 and 3.1.0.
Its axes and its sense of rotation are those used here: x to the right, y up, rotation from x to y.
"""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from ...bearings.linear import LinearBearing
from ...bearings.tabulated import TabulatedBearing
from ...errors import InputError
from ...files import read_text
from ...inputs.kinds import arguments
from ...rotors import (
    ClassicalBeam,
    Coupling,
    Disk,
    ElasticMaterial,
    LayeredElement,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
    Support,
)
from .ross_coefficients import RossTable, over_speed, read_bearing

MODAL = ("modal_damping_ratio", "default_damping_ratio")
"""Damping ratios that ROSS 3 gives the modes of a rotor, among its parameters."""

PRESENT = ("rotary_inertia", "gyroscopic")
"""Effects that a ShaftRotor always has."""


@dataclass(frozen=True, kw_only=True)
class RossRotor:
    """What a file of ROSS holds.

    Attributes
    ----------
    rotor : ShaftRotor
        With a station for each bearing, in the order of the file, and the classical beam element.
    bearings : dict of str to Reaction
        By station: LinearBearing, or TabulatedBearing where the file has a table over speed.
    """

    rotor: ShaftRotor
    bearings: dict[str, LinearBearing | TabulatedBearing]


@arguments
def read_ross(path: str | Path, *, speed: float | SpeedProfile = 0.0) -> RossRotor:
    """Return the rotor in a TOML or JSON file that ROSS saved.

    Parameters
    ----------
    path : str or Path
        JSON if it ends in `.json`, as for ROSS.
    speed : float or SpeedProfile [rad/s]
        Of the rotor; the file has none.

    Raises
    ------
    InputError
        If the file is no such file, or has something that a ShaftRotor cannot represent: modal damping, no
        rotary inertia, bearing masses, couplings that damp, supports over speed, damping by the stiffness of
        an axial force or a torque.

    Notes
    -----
    A bearing with `n_link`, the point mass and the bearing on that node become a `Support` in series. Two
    shaft elements between the same nodes become one `LayeredElement`, whose layers stay together along their
    whole length; those of ROSS are tied at the nodes only, which is a little softer on a coarse mesh.

    Proportional damping `alpha`, `beta` of the whole rotor becomes that of the `ShaftRotor`, and of its
    supports; that of shaft elements is theirs, without disks. As in ROSS, that of the rotor is instead of
    theirs.
    """
    file = Path(path)
    form, read = ("JSON", json.loads) if file.suffix.lower() == ".json" else ("TOML", tomllib.loads)
    try:
        data = read(read_text(file))
    except (tomllib.TOMLDecodeError, json.JSONDecodeError) as wrong:
        raise InputError(f"{file} must be {form}, got {wrong}") from None
    try:
        return _read(file, data, speed)
    except KeyError as missing:
        raise InputError(f"{file} must have the key {missing} in each of its elements") from None


def _read(file: Path, data: RossTable, speed: float | SpeedProfile) -> RossRotor:
    tables = {name: table for name, table in data.items() if isinstance(table, dict) and name != "parameters"}
    alpha, beta = _whole_damping(file, data.get("parameters", {}))
    couplings = _of(tables, "CouplingElement")
    pieces: list[tuple[int, ShaftElement | Coupling]] = [
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
    rotor = ShaftRotor(
        elements=chain,
        disks=(*_disks(_of(tables, "DiskElement")), *_flanges(couplings)),
        stations=tuple(
            Station(node=table["n"], name=label, support=_support_of(name, table, housings))
            for label, (name, table) in stations.items()
        ),
        speed=speed,
        beam=ClassicalBeam(),
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


def _disks(tables: Mapping[str, RossTable]) -> list[Disk]:
    return [
        Disk(node=int(t["n"]), mass=t["m"], diametral_inertia=t["Id"], polar_inertia=t["Ip"])
        for t in tables.values()
    ]


def _flanges(tables: Mapping[str, RossTable]) -> list[Disk]:
    """Return both sides of each coupling as disks."""
    return [
        Disk(
            node=t["n"] + side,
            mass=t[f"m_{end}"],
            diametral_inertia=t[f"Id_{end}"],
            polar_inertia=t[f"Ip_{end}"],
        )
        for t in tables.values()
        for side, end in enumerate("lr")
    ]


def _coupling(name: str, table: RossTable) -> Coupling:
    for kind in ("kt", "kr"):
        if table[f"{kind}_x"] != table[f"{kind}_y"]:
            raise InputError(f"{kind}_x must be {kind}_y, got {table[f'{kind}_x']!r} in {name!r}")
    damped = [key for key in ("ct_x", "ct_y", "cr_x", "cr_y") if table.get(key)]
    if damped:
        raise InputError(f"{damped[0]} must be 0, got {table[damped[0]]!r} in {name!r}")
    return Coupling(stiffness=table["kt_x"], tilt_stiffness=table["kr_x"])


def _element(name: str, table: RossTable, beta: float, *, own: bool) -> ShaftElement:
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
    return ShaftElement(
        length=table["L"],
        outer_diameter=table["odl"],
        inner_diameter=table["idl"],
        end_outer_diameter=table["odr"],
        end_inner_diameter=table["idr"],
        material=ElasticMaterial(
            young_modulus=material["E"], shear_modulus=material["G_s"], density=material["rho"]
        ),
        shear_coefficient=None if shears else math.inf,
        axial_force=table.get("axial_force", 0.0),
        torque=table.get("torque", 0.0),
        mass_damping=alpha if own else 0.0,
        stiffness_damping=beta if own else 0.0,
    )


def _chain(
    file: Path, pieces: list[tuple[int, ShaftElement | Coupling]]
) -> tuple[ShaftElement | LayeredElement | Coupling, ...]:
    """Return the elements from node to node; those between the same two nodes are layers of one."""
    ordered = sorted(pieces, key=lambda item: item[0])
    chain: list[ShaftElement | LayeredElement | Coupling] = []
    for node, group in groupby(ordered, key=lambda item: item[0]):
        between = [piece for _, piece in group]
        layers = tuple(piece for piece in between if isinstance(piece, ShaftElement))
        if node != len(chain):
            raise InputError(f"{file} must have a ShaftElement at every node, got none at node {len(chain)}")
        if len(between) > 1 and len(layers) < len(between):
            raise InputError(f"{file} must have a coupling alone between its nodes, got more at node {node}")
        chain.append(LayeredElement(layers=layers) if len(layers) > 1 else between[0])
    if not chain:
        raise InputError(f"{file} must have a ShaftElement, got none")
    return tuple(chain)


def _supports(
    chain: tuple[ShaftElement | LayeredElement | Coupling, ...],
    masses: Mapping[str, RossTable],
    bearings: Mapping[str, RossTable],
    alpha: float,
) -> dict[int, Support]:
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
            raise InputError(f"mx must be my, got {mass['mx']!r} and {mass['my']!r} in {mass_name!r}")
        below = [(name, table) for name, table in bearings.items() if table.get("n") == node]
        if len(below) != 1:
            raise InputError(
                f"n of one bearing to the ground must be that of {mass_name!r}, got {len(below)}"
            )
        spring = read_bearing(*below[0])
        if not isinstance(spring, LinearBearing):
            raise InputError(f"frequency must be absent for a support, got a table in {below[0][0]!r}")
        damping = np.asarray(spring.damping) + alpha * mass["mx"] * np.eye(2)
        found[node] = Support(mass=mass["mx"], stiffness=spring.stiffness, damping=damping.tolist())
    return found


def _support_of(name: str, table: RossTable, supports: Mapping[int, Support]) -> Support | None:
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
