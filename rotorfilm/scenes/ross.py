"""Rotors saved by ROSS: `rotor.save("rotor.toml")` there, `read_ross("rotor.toml")` here.

Written for the files of ROSS 1 and 2 (https://github.com/petrobras/ross), whose axes are those used here.
"""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from ..bearings import LinearBearing, TabulatedBearing
from ..errors import InputError
from ..rotors import (
    ClassicalBeam,
    Disk,
    ElasticMaterial,
    LayeredElement,
    ShaftElement,
    ShaftRotor,
    SpeedProfile,
    Station,
)

ABSENT = ("axial_force", "torque", "alpha", "beta")
"""Numbers of a shaft element that must be zero: what a ShaftRotor cannot have."""

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


def read_ross(path: str | Path, *, speed: float | SpeedProfile = 0.0) -> RossRotor:
    """Return the rotor in a TOML file that ROSS saved.

    Parameters
    ----------
    path : str or Path
    speed : float or SpeedProfile [rad/s]
        Of the rotor; the file has none.

    Raises
    ------
    InputError
        If the file is no such file, or has something that a ShaftRotor cannot represent: taper, axial force,
        torque, proportional damping, links to other nodes, bearing masses.
    """
    file = Path(path)
    try:
        data = tomllib.loads(file.read_text(encoding="utf-8"))
    except tomllib.TOMLDecodeError as wrong:
        raise InputError(f"{file} must be TOML, got {wrong}") from None
    try:
        return _read(file, data, speed)
    except KeyError as missing:
        raise InputError(f"{file} must have the key {missing} in each of its elements") from None


def _read(file: Path, data: Mapping[str, Any], speed: float | SpeedProfile) -> RossRotor:
    tables = {name: table for name, table in data.items() if isinstance(table, dict) and name != "parameters"}
    shaft = [(table["n"], _element(name, table)) for name, table in _of(tables, "ShaftElement").items()]
    disks = tuple(
        Disk(node=t["n"], mass=t["m"], diametral_inertia=t["Id"], polar_inertia=t["Ip"])
        for t in _of(tables, "DiskElement").values()
    )
    rest = {n: t for n, t in tables.items() if not n.startswith(("ShaftElement_", "DiskElement_"))}
    stations = {_identifier(name, k): (name, table) for k, (name, table) in enumerate(rest.items())}
    rotor = ShaftRotor(
        elements=_chain(file, shaft),
        disks=disks,
        stations=tuple(Station(node=table["n"], name=label) for label, (_, table) in stations.items()),
        speed=speed,
        beam=ClassicalBeam(),
    )
    bearings = {label: _bearing(name, table) for label, (name, table) in stations.items()}
    return RossRotor(rotor=rotor, bearings=bearings)


def _of(tables: Mapping[str, dict[str, Any]], kind: str) -> dict[str, dict[str, Any]]:
    return {name: table for name, table in tables.items() if name.startswith(f"{kind}_")}


def _element(name: str, table: Mapping[str, Any]) -> ShaftElement:
    for key in ABSENT:
        if table.get(key, 0.0):
            raise InputError(f"{key} must be 0, got {table[key]!r} in {name!r}")
    for key in PRESENT:
        if not table.get(key, True):
            raise InputError(f"{key} must be true, got {table[key]!r} in {name!r}")
    if (table["idl"], table["odl"]) != (table["idr"], table["odr"]):
        raise InputError(f"idl, odl must be idr, odr: a cylinder, got a taper in {name!r}")
    material = table["material"]
    return ShaftElement(
        length=table["L"],
        outer_diameter=table["odl"],
        inner_diameter=table["idl"],
        material=ElasticMaterial(
            young_modulus=material["E"], shear_modulus=material["G_s"], density=material["rho"]
        ),
        shear_coefficient=None if table.get("shear_effects", True) else math.inf,
    )


def _chain(file: Path, shaft: list[tuple[int, ShaftElement]]) -> tuple[ShaftElement | LayeredElement, ...]:
    """Return the elements from node to node; those between the same two nodes are layers of one."""
    ordered = sorted(shaft, key=lambda item: item[0])
    chain: list[ShaftElement | LayeredElement] = []
    for node, group in groupby(ordered, key=lambda item: item[0]):
        layers = tuple(element for _, element in group)
        if node != len(chain):
            raise InputError(f"{file} must have a ShaftElement at every node, got none at node {len(chain)}")
        chain.append(layers[0] if len(layers) == 1 else LayeredElement(layers=layers))
    if not chain:
        raise InputError(f"{file} must have a ShaftElement, got none")
    return tuple(chain)


def _bearing(name: str, table: Mapping[str, Any]) -> LinearBearing | TabulatedBearing:
    if "kxx" not in table:
        raise InputError(
            f"{name!r} must be a shaft element, a disk or have the coefficient kxx, got {list(table)}"
        )
    if table.get("n_link") is not None:
        raise InputError(f"n_link must be absent, got {table['n_link']!r} in {name!r}")
    masses = [table.get(f"m{entry}", 0.0) for entry in ("xx", "xy", "yx", "yy")]
    if any(np.any(np.asarray(mass)) for mass in masses):
        raise InputError(f"mxx, mxy, myx, myy must be 0, got {masses} in {name!r}")
    stiffness, damping = (_entries(table, letter) for letter in "kc")
    if len(stiffness) == len(damping) == 1:
        return LinearBearing(stiffness=stiffness[0], damping=damping[0])
    speeds = np.asarray(table.get("frequency", ()), dtype=float)
    if len(speeds) < 2:
        raise InputError(
            f"frequency must go with the coefficients, got {table.get('frequency')!r} in {name!r}"
        )
    whole = [np.broadcast_to(t, (len(speeds), 2, 2)) for t in (stiffness, damping)]
    return TabulatedBearing(speeds=speeds, stiffness=whole[0], damping=whole[1])


def _entries(table: Mapping[str, Any], letter: str) -> np.ndarray:
    """Return the coefficients k or c, shape (n, 2, 2); ROSS leaves out what it can guess."""
    main = table[f"{letter}xx"]
    cross = np.zeros_like(np.atleast_1d(main))
    found = [
        table.get(f"{letter}xx"),
        table.get(f"{letter}xy", cross),
        table.get(f"{letter}yx", cross),
        table.get(f"{letter}yy", main),
    ]
    columns = np.broadcast_arrays(*(np.atleast_1d(np.asarray(entry, dtype=float)) for entry in found))
    return np.stack(columns, axis=-1).reshape(-1, 2, 2)


def _identifier(name: str, number: int) -> str:
    """Return the name of a station for `BearingElement_Drive end`: `drive_end`."""
    tag = re.sub(r"\W+", "_", name.partition("_")[2]).strip("_").lower()
    return tag if tag.isidentifier() else f"bearing_{number}"
