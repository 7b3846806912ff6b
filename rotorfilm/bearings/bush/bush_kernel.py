"""The numbers of a melting bush that the kernels of the C library read (`native/bushes/bush.h`)."""

from __future__ import annotations

import numpy as np

from ...core.model import Array
from ...core.signals import Signal, force_outputs, journal_inputs, signals_of
from ...native.spec import NativeParameter, NativeSpec
from .bearing import MeltingBush
from .melting import ContactBalance, GlobalBalance

NOT_NEGATIVE = {"outer_swing", "melting_heat", "retardation"}
"""Parameters that have a lower bound."""


def has_kernel(bush: MeltingBush) -> bool:
    """Return whether the C library knows the heat balance of a bush."""
    return type(bush.balance) in (ContactBalance, GlobalBalance)


def bush_table(bush: MeltingBush) -> Array:
    """Return the numbers that are fixed, in the order of `rf_bush_numbers`."""
    law, geometry = bush.law, bush.geometry
    return np.array(
        [
            law.clearance,
            law.closing,
            law.compliance,
            law.pressure_work,
            law.shaft,
            law.liner,
            law.melting,
            float(isinstance(bush.balance, GlobalBalance)),
            geometry.radius,
            geometry.shaft_radius,
            geometry.outer_radius - geometry.radius,
            bush.force_unit,
            bush.liner.shear_modulus,
        ]
    )


def bush_parameters(bush: MeltingBush, melting_heat: float) -> tuple[NativeParameter, ...]:
    """Return friction, outer temperature and melting heat [J/m3], all tunable, in the order of bush.h."""
    friction = bush.friction
    rows = (
        ("f0", "1", friction.f0, 0.1, "coefficient of friction f0 + f1 T + f2 T^2, at ambient temperature"),
        ("f1", "1/K", friction.f1, 1e-4, "its part linear in the temperature above ambient"),
        ("f2", "1/K2", friction.f2, 1e-7, "its part quadratic in the temperature"),
        ("outer_mean", "K", bush.outer_mean, 100.0, "mean temperature of the outer surface above ambient"),
        ("outer_swing", "K", bush.outer_swing, 1.0, "by how much it is warmer on the load line"),
        ("melting_heat", "J/m3", melting_heat, melting_heat, "heat that melts a unit of volume"),
    )
    return _tunable(rows)


def reaction_spec(
    bush: MeltingBush, melting_heat: float, retardation: float, held: float, profile: list[float]
) -> NativeSpec:
    """Return the kernel of a bush with a worn profile.

    Parameters
    ----------
    bush : MeltingBush
    melting_heat : float [J/m3]
    retardation : float [s]
    held : float [K]
        Temperature of the contact.
    profile : list of float
        Number, center and extent of the nodes [rad], whether points melt by themselves, and whether the
        temperature is given.
    """
    melting = bush.liner.melting_point
    rows = (
        ("retardation", "s", retardation, 1e-3, "retardation time of the liner as a Kelvin-Voigt solid"),
        ("temperature", "K", held, melting, "temperature at which the contact is held, above ambient"),
    )
    return NativeSpec(
        kernel="bush_reaction",
        parameters=(*bush_parameters(bush, melting_heat), *_tunable(rows)),
        tables={"bush": bush_table(bush), "profile": np.array(profile, dtype=float)},
    )


def _tunable(rows: tuple[tuple[str, str, float, float, str], ...]) -> tuple[NativeParameter, ...]:
    """Return parameters of rows (name, unit, value, nominal value, description)."""
    return tuple(
        NativeParameter(
            name=name,
            unit=unit,
            value=float(value),
            tunable=True,
            minimum=0.0 if name in NOT_NEGATIVE else -np.inf,
            nominal=float(nominal),
            description=description,
        )
        for name, unit, value, nominal, description in rows
    )


# The signals of bushes that wear, and their typical magnitudes.


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
