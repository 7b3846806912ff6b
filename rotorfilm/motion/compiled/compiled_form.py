"""What of the rotors and films that anybody may bring the compiled integration takes."""

from __future__ import annotations

from ...errors import InputError
from ...model import Dynamic, Reaction
from ...reactions.added_mass import inertial
from ...rotors import FlexibleRotor, MountedRotor, RigidRotor, ShakenBaseRotor, mount
from .film_calls import kernel_call
from .modal import take_apart

EQUATIONS = ("derivative", "output", "operators")
"""Of a rotor, which a subclass may change."""


def compiled_form(rotor: Dynamic, reaction: Reaction) -> MountedRotor | None:
    """Return a rotor in all its bearings for `simulate_rotor`; None where that does not take it, or slowly.

    It takes it where

    - each bearing has no states and adds no mass, and a force in the C library: a journal bearing or a
      damper whose film has a kernel (map, short film, grooved map, two-dimensional film), a linear one, or
      one of these beside springs;
    - the rotor is a `RigidRotor` or a `FlexibleRotor`, mounted or not, whose equations no subclass has
      changed, without a loss factor; on ground that shakes too.

    Parameters
    ----------
    rotor : Dynamic
        With one station left, the one without a name.
    reaction : Reaction
        The bearing of that.
    """
    bare = rotor.bare if isinstance(rotor, MountedRotor) else rotor
    bare = bare.rotor if isinstance(bare, ShakenBaseRotor) else bare
    if not _is_linear(bare) or not _is_compiled(reaction):
        return None
    mounted = mount(rotor, {"": reaction})
    if not all(map(_is_compiled, mounted.all_bearings.values())):
        return None
    try:
        take_apart(mounted)
    except InputError:
        return None
    return mounted


def _is_compiled(bearing: Reaction) -> bool:
    return inertial(bearing) is None and kernel_call(bearing) is not None


def _is_linear(rotor: Dynamic) -> bool:
    """Return whether a rotor has the equations of its matrices."""
    base = next((kind for kind in (RigidRotor, FlexibleRotor) if isinstance(rotor, kind)), None)
    return base is not None and all(getattr(type(rotor), name) is getattr(base, name) for name in EQUATIONS)
