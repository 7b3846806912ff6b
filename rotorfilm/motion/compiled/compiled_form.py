"""What of the rotors and films that anybody may bring the compiled integration takes."""

from __future__ import annotations

from collections.abc import Iterable

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
    if not _is_linear(rotor) or not _is_compiled(reaction):
        return None
    mounted = mount(rotor, {"": reaction})
    if not all(map(_is_compiled, mounted.all_bearings.values())):
        return None
    try:
        take_apart(mounted)
    except InputError:
        return None
    return mounted


def takes_forces(rotor: Dynamic, bearings: Iterable[Reaction]) -> bool:
    """Return whether `simulate_rotor` takes a rotor on bearings by station, those in Python too.

    It takes the linear rotors of `compiled_form`, on bearings without states and added mass.
    """
    mounted = rotor.all_bearings.values() if isinstance(rotor, MountedRotor) else ()
    every = (*bearings, *mounted)
    return _is_linear(rotor) and not any(film.states or inertial(film) is not None for film in every)


def _is_compiled(bearing: Reaction) -> bool:
    return inertial(bearing) is None and kernel_call(bearing) is not None


def _is_linear(rotor: Dynamic) -> bool:
    """Return whether a rotor, in bearings or not, has the equations of its matrices."""
    bare = rotor.bare if isinstance(rotor, MountedRotor) else rotor
    bare = bare.rotor if isinstance(bare, ShakenBaseRotor) else bare
    base = next((kind for kind in (RigidRotor, FlexibleRotor) if isinstance(bare, kind)), None)
    return base is not None and all(getattr(type(bare), name) is getattr(base, name) for name in EQUATIONS)
