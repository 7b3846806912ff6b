"""A rotor with its bearings as a kernel of the C library, where all of them have one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from ..model import Array, Dynamic, Reaction
from ..native.spec import HasKernel, NativeSpec
from .profile import SpeedProfile
from .rigid import RigidRotor, native_parameter
from .stations import prefixed
from .structure import FlexibleRotor, Operators

KINDS = (
    "journal",
    "grooved_journal",
    "short_journal",
    "damper",
    "oil_damper",
    "reynolds_journal",
    "pressure_dam",
    "lobed_journal",
)
"""Kernels that may be a bearing of a system, in the order of `native/systems/mounted_tables.c`."""


def system_kernel(
    rotor: Dynamic,
    bearings: Mapping[str, Reaction],
    *,
    carried: Sequence[int],
    free: Sequence[int],
    motion: Sequence[int],
) -> NativeSpec | None:
    """Return the kernel of a rotor with bearings; None if a part of it has none.

    Parameters
    ----------
    rotor : Dynamic
        A `FlexibleRotor` or a `RigidRotor`.
    bearings : mapping of str to Reaction
        By station, at least one.
    carried, free : sequence of int
        Inputs of the rotor that are forces of the bearings, and the others.
    motion : sequence of int
        Outputs of the rotor that are x, y, vx, vy of the stations.
    """
    parts = [bearing.native() if isinstance(bearing, HasKernel) else None for bearing in bearings.values()]
    specs = [spec for spec in parts if spec is not None and spec.kernel in KINDS]
    matrices = _operators(rotor)
    if matrices is None or not specs or len(specs) < len(parts):
        return None
    operators, profile = matrices
    speed = () if len(profile.times) > 1 else (native_parameter("constant_speed", profile.speeds[0]),)
    own = [prefixed(name, p) for name, spec in zip(bearings, specs, strict=True) for p in spec.parameters]
    places, sets = _distinct(specs)
    kinds = [KINDS.index(spec.kernel) for spec in specs]
    return NativeSpec(
        kernel="rotor_system",
        parts=tuple(spec.kernel for spec in specs),
        parameters=(*own, *speed),
        tables={
            **_matrices(operators, list(carried), list(free), list(motion)),
            "times": np.array(profile.times),
            "speeds": np.array(profile.speeds),
            "bearings": np.column_stack([kinds, places]).astype(float),
            **{f"{k}.{name}": table for k, spec in enumerate(sets) for name, table in spec.tables.items()},
        },
    )


def _operators(rotor: Dynamic) -> tuple[Operators, SpeedProfile] | None:
    elastic = isinstance(rotor, FlexibleRotor) and rotor.structure.hysteresis is None
    if isinstance(rotor, FlexibleRotor | RigidRotor) and (elastic or type(rotor) is RigidRotor):
        return rotor.operators, rotor.profile
    return None


def _matrices(model: Operators, carried: list[int], free: list[int], motion: list[int]) -> dict[str, Array]:
    """Return the tables of the kernel; its rates of displacements are the states' second half already."""
    n = len(model.weight) // 2
    return {
        "steady": model.steady[n:],
        "spin": model.spin[n:],
        "push": model.push[n:, free],
        "carry": model.push[n:, carried],
        "weight": model.weight[n:, None],
        "unbalance": model.unbalance[n:],
        "sense": model.sense,
        "motion": model.sense[motion],
    }


def _distinct(specs: Sequence[NativeSpec]) -> tuple[list[int], list[NativeSpec]]:
    """Return for each kernel the number of its tables among those that differ, and one kernel for each."""
    places: list[int] = []
    different: list[NativeSpec] = []
    for spec in specs:
        same = (k for k, other in enumerate(different) if _equal(spec, other))
        places.append(next(same, len(different)))
        if places[-1] == len(different):
            different.append(spec)
    return places, different


def _equal(one: NativeSpec, other: NativeSpec) -> bool:
    return one.tables.keys() == other.tables.keys() and all(
        np.array_equal(table, other.tables[name]) for name, table in one.tables.items()
    )
