"""FMU of a flexible rotor, in as few states as a tolerance allows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..linear import rotor_equilibrium
from ..model import Reaction
from ..reduce import Reduction, reduce_rotor
from ..rotors import FlexibleRotor, SteadyRotor
from ..rotors.structure import station_names


def export_rotor_fmu(
    rotor: FlexibleRotor,
    path: str | Path,
    version: str = "2.0",
    *,
    frequency: float,
    tolerance: float = 1e-3,
    bearings: Mapping[str, Reaction] | None = None,
    platforms: str = "host",
    component: str = "rotor",
) -> Reduction:
    """Write a rotor at constant speed as a native FMU, reduced as far as a tolerance allows.

    Parameters
    ----------
    rotor : FlexibleRotor
        With a constant speed; held by its stations, whose signals are those of the FMU.
    path, version, platforms, component
        As in `export_fmu`.
    frequency : float [rad/s]
        Highest frequency of interest, as in `reduce_rotor`.
    tolerance : float [1]
        Largest error of the reduction.
    bearings : mapping of str to Reaction, optional
        By station: the FMU begins at rest in them, under their forces; without, straight and without forces.

    Returns
    -------
    Reduction
        The rotor in the FMU, with its error.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    ConvergenceError
        If no reduction is within the tolerance.
    EquilibriumError
        If there is no equilibrium in the bearings.
    """
    from ..fmu import export_fmu  # slow to load, and not needed to read a scene

    reduction = reduce_rotor(rotor, frequency=frequency, tolerance=tolerance)
    start = {}
    if bearings is not None:
        at = rotor_equilibrium(reduction.rotor, bearings, float(reduction.rotor.profile.speed(0.0)))
        state = np.concatenate([at.displacement, np.zeros(len(at.displacement))])
        reduction = replace(reduction, rotor=replace(reduction.rotor, initial=tuple(state.tolist())))
        forces = [
            (name, -value)
            for station, load in at.loads.items()
            for name, value in zip(station_names(station)[1], load.tolist(), strict=True)
        ]
        start = dict(forces)
    model = SteadyRotor(rotor=reduction.rotor)
    export_fmu(model, path, version, platforms=platforms, component=component, start=start)
    return reduction
