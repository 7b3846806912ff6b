"""The numbers of a melting bush that the kernels of the C library read (`native/bushes/bush.h`)."""

from __future__ import annotations

import numpy as np

from ...model import Array
from ...native.spec import NativeParameter, NativeSpec
from .bearing import MeltingBush
from .heat import ContactBalance, GlobalBalance

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
