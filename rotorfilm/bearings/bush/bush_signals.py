"""The signals of bushes that wear, and their typical magnitudes."""

from __future__ import annotations

from ...signals import Signal, force_outputs, journal_inputs, signals_of
from .bearing import MeltingBush

NOMINAL_LOAD = 1e-2
"""Typical load in units of `MeltingBush.force_unit`."""

NOMINAL_PRESSURE = 4e-2
"""Typical largest contact pressure in shear moduli."""

NOMINAL_SPEED = 10.0
"""Typical angular speed [rad/s]."""


def load_inputs(bush: MeltingBush) -> tuple[Signal, ...]:
    """Return the signals load, speed."""
    return signals_of(
        ("load", "N", NOMINAL_LOAD * bush.force_unit, "radial load, not negative"),
        ("speed", "rad/s", NOMINAL_SPEED, "angular speed about +z"),
    )


def moved_inputs(bush: MeltingBush) -> tuple[Signal, ...]:
    """Return the signals of a journal that is moved."""
    return journal_inputs(nominal_depth(bush), NOMINAL_SPEED)


def moment_outputs(bush: MeltingBush, melting_heat: float) -> tuple[Signal, ...]:
    """Return the outputs of a loaded bush with one moment of wear."""
    depth = bush.geometry.radius * bush.clearance_ratio
    rate = bush.law.losses(0.1) / melting_heat
    return signals_of(
        ("contact_angle", "rad", 0.1, "half the contact angle"),
        ("settlement", "m", depth, "displacement of the shaft beyond the clearance"),
        ("temperature", "K", bush.liner.melting_point, "contact temperature above ambient"),
        ("maximum_pressure", "Pa", NOMINAL_LOAD * bush.liner.shear_modulus, "pressure on the load line"),
        _torque(bush, float(bush.friction.at(bush.liner.melting_point))),
        ("melt_rate", "m/s", rate, "mean rate of wear over the contact"),
        ("speed_ratio", "1", 1.0, "speed / critical speed at the present contact angle"),
    )


def profile_outputs(bush: MeltingBush, friction: float) -> tuple[Signal, ...]:
    """Return the outputs of a bush with a worn profile."""
    pressure = NOMINAL_PRESSURE * bush.liner.shear_modulus
    rows = signals_of(
        _torque(bush, friction),
        ("contact_angle", "rad", 0.1, "half the angle in contact"),
        ("maximum_pressure", "Pa", pressure, "largest contact pressure at a node"),
    )
    return (*force_outputs(NOMINAL_LOAD * bush.force_unit), *rows)


def profile_states(bush: MeltingBush, nodes: int) -> tuple[Signal, ...]:
    """Return the wear depths at the nodes."""
    depth = nominal_depth(bush)
    return signals_of(*((f"wear_{i}", "m", depth, f"wear depth at node {i}") for i in range(nodes)))


def nominal_depth(bush: MeltingBush) -> float:
    """Return a typical depth of the shaft in the liner [m]."""
    return bush.geometry.radius * bush.compliance * NOMINAL_PRESSURE


def _torque(bush: MeltingBush, friction: float) -> tuple[str, str, float, str]:
    unit = NOMINAL_LOAD * bush.force_unit * bush.geometry.shaft_radius
    return "friction_torque", "N.m", friction * unit, "torque about +z that keeps the shaft turning"
