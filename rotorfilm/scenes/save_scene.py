"""A rotor with its bearings as a scene, and scenes as files."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..bearings.journal import JournalBearing
from ..bearings.journal.table import FILMS
from ..bearings.linear import LinearBearing
from ..bearings.oil.oil import DENSITY
from ..bearings.seal import AnnularSeal
from ..core.errors import InputError, SceneError, brief
from ..core.inputs import arguments
from ..core.port import Bearings
from ..rotors import ShaftRotor
from .oil_film_tables import NONE
from .reading import keyed
from .scene import Scene, read_scene
from .shaft_table import BEAMS, OTHERS, SEAL_KEYS
from .shared_tables import SCHEMA

TABLES = {JournalBearing: "journal", AnnularSeal: "seal"}
"""Keys of bearings in an entry of `shaft.bearings`."""


@arguments
def scene_of(rotor: ShaftRotor, bearings: Bearings, speeds: ArrayLike, title: str = "rotor") -> Scene:
    """Return a rotor with its bearings as a scene, of which `save("rotor.toml")` makes a file.

    Parameters
    ----------
    rotor : ShaftRotor
        Its speed becomes that of `[operation]`.
    bearings : mapping of str to Reaction
        By station: `JournalBearing`, `LinearBearing` or `AnnularSeal`.
    speeds : array_like, shape (n,) [rad/s]
        Range that is looked at, at equal distances.
    title : str

    Raises
    ------
    InputError
        If a scene file has no such element, bearing or number.
    """
    grid = np.asarray(speeds, dtype=float)
    if grid.ndim != 1 or grid.size < 2 or not np.allclose(grid, np.linspace(grid[0], grid[-1], grid.size)):
        raise InputError(f"speeds must be an even list of two or more, got {brief(speeds)}")
    if {*bearings} != {one.name for one in rotor.stations}:
        raise InputError(f"bearings must be one for each station of the rotor, got {list(bearings)}")
    pieces = [one for one in rotor.elements if hasattr(one, "material")]
    if not pieces:
        raise InputError("rotor must have a ShaftElement for a scene, got none")
    material = pieces[0].material
    shaft = _plain(rotor, without=("elements", "stations", "disks", "speed", "beam"))
    shaft |= {
        "material": _plain(material),
        "elements": [
            _plain(one, without=("material",) if getattr(one, "material", None) == material else ())
            for one in rotor.elements
        ],
        "disks": [{"mass": one.mass, **_plain(one)} for one in rotor.disks],
        "bearings": [
            {**_plain(station), **_bearing(bearings[station.name], station.name)}
            for station in rotor.stations
        ],
        "speeds": {"first": float(grid[0]), "last": float(grid[-1]), "count": grid.size},
        "beam": next(name for name, kind in BEAMS.items() if type(rotor.beam) is kind),
    }
    tables = {
        "schema": SCHEMA,
        "title": title,
        "operation": {"speed": rotor.profile.speed(0.0)},
        "shaft": shaft,
    }
    if any(getattr(one, "turbulence", None) is not None for one in bearings.values()):
        tables["lubricant"] = {"density": DENSITY}  # that of a turbulence which names none
    try:
        found = read_scene(tables, "scene")
    except SceneError as error:
        raise InputError(f"rotor must be one that a scene file can describe: {error}") from None
    if found.shaft.build(speed=rotor.profile.speed(0.0)) != rotor:
        raise InputError("rotor must be one that a scene file can describe, got one with further properties")
    for name, one in found.shaft.build_bearings().items():
        if one != bearings[name]:
            raise InputError(
                f"bearings[{name!r}] must be one that a scene file can describe, got {bearings[name]!r}"
            )
    return found


def _bearing(bearing: Any, name: str) -> dict[str, Any]:
    if isinstance(bearing, LinearBearing):
        return {key: np.asarray(getattr(bearing, key)).tolist() for key in ("stiffness", "damping")}
    key = TABLES.get(type(bearing))
    if key is None:
        raise InputError(
            f"bearings[{name!r}] must be a JournalBearing, an AnnularSeal or a LinearBearing for [shaft] of "
            f"a scene, got {type(bearing).__name__}; {OTHERS}"
        )
    found = _plain(bearing)
    if key == "seal":
        found = {one: value for one, value in found.items() if one in SEAL_KEYS}
    elif getattr(bearing, "turbulence", found) is None:
        found["turbulence"] = NONE
    if "film" in found:
        laws = {keyed(table).makes: (law, keyed(table).readers) for law, table in FILMS.items()}
        law, known = laws.get(type(bearing.film), ("", {}))
        found["film"] = {"name": law, **{one: value for one, value in found["film"].items() if one in known}}
    return {key: found}


def _plain(thing: Any, without: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return what a dataclass holds besides its defaults, as TOML has it."""
    found = {}
    for one in fields(thing):
        usual = one.default if one.default_factory is MISSING else one.default_factory()
        value = getattr(thing, one.name)
        if one.init and one.name not in without and (usual is MISSING or repr(value) != repr(usual)):
            found[one.name] = _toml(value)
    return found


def _toml(value: Any) -> Any:
    if is_dataclass(value):
        return _plain(value)
    if isinstance(value, tuple | list | np.ndarray):
        return [_toml(one) for one in value]
    if isinstance(value, Mapping):
        return {key: _toml(one) for key, one in value.items()}
    return value.item() if isinstance(value, np.generic) else value


def save_scene(scene: Scene, path: Path | str) -> Path:
    """Write a scene as a file; return the path."""
    from ..core.files import write_atomically
    from .new_scene import scene_text

    if not scene.given:
        raise InputError(
            "scene must come from Scene.load or scene_of to be saved, got one that was built from tables"
        )
    return write_atomically(path, scene_text(scene.given).encode())
