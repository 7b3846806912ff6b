"""What the physics of all rungs leaves out of a flexible rotor."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ...answers import ISOTHERMAL
from ...bearings.journal import JournalBearing
from ...bearings.linear import LinearBearing
from ...errors import RotorfilmError
from ...linear import rotor_equilibrium, rotor_modes
from ...model import Reaction
from ...rotors import ShaftElement, ShaftRotor
from ..journal.journal_remarks import film_remarks

if TYPE_CHECKING:
    from ..scene import Scene

STIFF = 1e10
"""Stiffness of bearings [N/m] by which the weight is shared out."""

SLENDER = 4.0
"""Length of a shaft / its largest diameter below which its cross sections may not stay plane."""

GROWTH = 1e-6
"""Growth rate / frequency from which a whirl counts as unstable."""

STEPPED = 2.0
"""Ratio of neighboring diameters from which the material in the corner of a step does not carry."""


def shaft_remarks(scene: Scene, speed: float) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, for the shaft of a scene at a speed."""
    assert scene.shaft is not None
    rotor, bearings = scene.shaft.build(), scene.shaft.build_bearings()
    stiff = {name: LinearBearing(stiffness=STIFF) for name in bearings}
    loads = rotor_equilibrium(rotor, stiff, speed).loads
    lines = list(beam_remarks(rotor))
    for name, bearing in bearings.items():
        if isinstance(bearing, JournalBearing):
            x, y = loads[name].tolist()
            found = film_remarks(bearing, scene.lubricant, speed, (x, y))
            lines += [f"{name}, at {speed:.4g} rad/s: {line}" for line in found]
    return tuple(lines)


def shaft_physics(scene: Scene) -> str:
    """Return the physics in which the answers of a shaft are meant: that of its films, if it has some."""
    assert scene.shaft is not None
    bearings = scene.shaft.build_bearings().values()
    return ISOTHERMAL if any(isinstance(bearing, JournalBearing) for bearing in bearings) else ""


def beam_remarks(rotor: ShaftRotor) -> tuple[str, ...]:
    """Return where a shaft is no beam, one line each."""
    pieces = [element for element in rotor.elements if isinstance(element, ShaftElement)]
    if not pieces:
        return ()
    length, thickest = sum(piece.length for piece in pieces), max(piece.outer_diameter for piece in pieces)
    diameters = [piece.outer_diameter for piece in pieces]
    largest = max((max(a, b) / min(a, b) for a, b in pairwise(diameters)), default=1.0)
    lines = {
        f"beam theory: {length / thickest:.2g} diameters long, cross sections may not stay plane": (
            length < SLENDER * thickest
        ),
        f"beam theory: diameters change by {largest:.2g} in a step, whose corner does not carry": (
            largest > STEPPED
        ),
    }
    return tuple(line for line, applies in lines.items() if applies)


def stability_remark(rotor: ShaftRotor, bearings: dict[str, Reaction], speed: float) -> tuple[str, ...]:
    """Return that a rotor whirls by itself, if the model of the file does: no orbit is steady then."""
    try:
        modes = rotor_modes(rotor, bearings, speed)
    except RotorfilmError:
        return ()  # the rungs say what is wrong
    growth = modes.eigenvalues.real / np.abs(modes.eigenvalues)
    if not growth.size or growth.max() <= GROWTH:
        return ()
    k = int(np.argmax(growth))
    return (
        f"stability: the rotor whirls by itself at {modes.frequency[k] / abs(speed):.2f} of the speed; "
        "orbits that repeat with each turn do not last",
    )
