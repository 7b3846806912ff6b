"""What the physics of all rungs leaves out of a flexible rotor."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from ...answers import ISOTHERMAL
from ...bearings.journal import JournalBearing
from ...bearings.linear import LinearBearing
from ...bearings.seal import AnnularSeal
from ...errors import RotorfilmError
from ...linear import rotor_equilibrium, rotor_modes
from ...model import Reaction
from ...rotors import ShaftElement, ShaftRotor
from ..journal.journal_remarks import film_remarks
from ..lubricant_table import Lubricant
from ..remarks import Remark, prefixed, said

STIFF = 1e10
"""Stiffness of bearings [N/m] by which the weight is shared out."""

SLENDER = 4.0
"""Length of a shaft / its largest diameter below which its cross sections may not stay plane."""

GROWTH = 1e-6
"""Growth rate / frequency from which a whirl counts as unstable."""

STEPPED = 2.0
"""Ratio of neighboring diameters from which the material in the corner of a step does not carry."""


BEAM = (
    Remark(
        "slenderness",
        SLENDER,
        "beam theory: {slenderness:.2g} diameters long, cross sections may not stay plane",
        below=True,
    ),
    Remark(
        "step",
        STEPPED,
        "beam theory: diameters change by {step:.2g} in a step, whose corner does not carry",
    ),
)
"""Where a shaft is no beam."""

UNSTABLE = Remark(
    "growth",
    GROWTH,
    "stability: the rotor whirls by itself at {whirl:.2f} of the speed; orbits that repeat with each turn do "
    "not last",
)


def shaft_remarks(
    rotor: ShaftRotor, bearings: Mapping[str, Reaction], oil: Lubricant, speed: float
) -> tuple[str, ...]:
    """Return what is left out and should not be, one line each, of a shaft in its bearings at a speed."""
    seals = {name: one for name, one in bearings.items() if isinstance(one, AnnularSeal)}
    stiff = {name: seals.get(name, LinearBearing(stiffness=STIFF)) for name in bearings}
    loads = rotor_equilibrium(rotor, stiff, speed).loads
    lines = list(beam_remarks(rotor))
    for name, bearing in bearings.items():
        if isinstance(bearing, JournalBearing):
            x, y = loads[name].tolist()
            found = film_remarks(bearing, oil, speed, (x, y))
            lines += prefixed(f"{name}, at {speed:.4g} rad/s: ", found)
    return tuple(lines)


def shaft_physics(bearings: Mapping[str, Reaction]) -> str:
    """Return the physics in which the answers of a shaft are meant: that of its films, if it has some."""
    return ISOTHERMAL if any(isinstance(bearing, JournalBearing) for bearing in bearings.values()) else ""


def beam_remarks(rotor: ShaftRotor) -> tuple[str, ...]:
    """Return where a shaft is no beam, one line each."""
    pieces = [element for element in rotor.elements if isinstance(element, ShaftElement)]
    if not pieces:
        return ()
    length, diameters = sum(piece.length for piece in pieces), [piece.outer_diameter for piece in pieces]
    largest = max((max(a, b) / min(a, b) for a, b in pairwise(diameters)), default=1.0)
    return said(BEAM, {"slenderness": length / max(diameters), "step": largest})


def stability_remark(rotor: ShaftRotor, bearings: Mapping[str, Reaction], speed: float) -> tuple[str, ...]:
    """Return that a rotor whirls by itself, if the model of the file does: no orbit is steady then."""
    try:
        modes = rotor_modes(rotor, bearings, speed)
    except RotorfilmError:
        return ()  # the rungs say what is wrong
    growth = modes.eigenvalues.real / np.abs(modes.eigenvalues)
    if not growth.size:
        return ()
    k = int(np.argmax(growth))
    return said([UNSTABLE], {"growth": growth[k], "whirl": modes.frequency[k] / abs(speed)})
