"""The signals between a rotor and its bearings: motion of a journal, force on it."""

from __future__ import annotations

from collections.abc import Sequence

from .signals import Signal

MOTION_NAMES = ("x", "y", "vx", "vy")
"""Signals of the journal's motion, which a rotor gives."""

JOURNAL_INPUTS = (*MOTION_NAMES, "speed")
"""Signals that the inputs of every Reaction begin with."""

FORCE_OUTPUTS = ("force_x", "force_y")
"""Signals that the outputs of every Reaction begin with; a rotor takes them as inputs."""


def journal_inputs(clearance: float, nominal_speed: float) -> tuple[Signal, ...]:
    """Return the signals JOURNAL_INPUTS that the inputs of every Reaction begin with.

    Parameters
    ----------
    clearance : float
        Radial clearance [m], the nominal value of positions.
    nominal_speed : float
        Typical angular speed [rad/s]; with the clearance it makes the nominal velocity.
    """
    velocity = clearance * nominal_speed
    rows = (
        ("m", clearance, "journal position along x"),
        ("m", clearance, "journal position along y"),
        ("m/s", velocity, "journal velocity along x"),
        ("m/s", velocity, "journal velocity along y"),
        ("rad/s", nominal_speed, "angular speed about +z"),
    )
    return _signals(JOURNAL_INPUTS, rows)


def force_outputs(nominal_force: float) -> tuple[Signal, ...]:
    """Return the signals FORCE_OUTPUTS that the outputs of every Reaction begin with (nominal force in N)."""
    return _signals(
        FORCE_OUTPUTS, [("N", nominal_force, f"force on the journal along {axis}") for axis in "xy"]
    )


def _signals(names: Sequence[str], rows: Sequence[tuple[str, float, str]]) -> tuple[Signal, ...]:
    pairs = zip(names, rows, strict=True)
    return tuple(Signal(name=name, unit=u, nominal=size, description=text) for name, (u, size, text) in pairs)
