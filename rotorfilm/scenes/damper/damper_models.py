"""Rotor and damper of a scene, as they are run."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...bearings.damper import JFODamper, PorousDamper
from ...bearings.sprung import Sprung
from ...errors import InputError
from ...rotors import RigidRotor
from ..excitation_table import BladeLossTable, RunUpTable, UnbalanceTable, require_kind
from ..families import SceneModels
from ..schema import require_steps

if TYPE_CHECKING:
    from ..scene import Scene

OTHER_RUNS = dict.fromkeys(("motor", "ground"), "rotorfilm rotor-run")
"""Command for an excitation that is not of these models."""


class DamperScene(NamedTuple):
    """The models of a scene with a damper.

    Attributes
    ----------
    rotor : RigidRotor
        At the center of the damper, or its offset, at rest.
    support : PorousDamper, Sprung or JFODamper
    start : float [s]
        When the excitation begins: until then nothing moves, and the run counts from there.
    duration : float [s]
    step : float [s]
        Time between samples, or exchanges of a coupled run.
    """

    rotor: RigidRotor
    support: PorousDamper | Sprung | JFODamper
    start: float
    duration: float
    step: float


def damper_models(scene: Scene) -> DamperScene:
    """Return rotor and damper of a scene.

    An unbalance is that of `[rigid_rotor]`, there from the start, or that of the excitation: `unbalance`,
    `blade_loss` or `run_up`.

    Raises
    ------
    InputError
        If the scene lacks a damper or a rotor, has two unbalances, or another excitation.
    """
    excitation = scene.excitation
    if scene.damper is None or scene.rigid_rotor is None:
        raise InputError("damper and rigid_rotor are required for a run on a damper, got a scene without")
    rotor, start, duration = scene.rigid_rotor.build(scene.speed, scene.damper.load), 0.0, 0.0
    rotor = replace(rotor, position=scene.damper.offset)
    require_kind(excitation, ("unbalance", "blade_loss", "run_up"), OTHER_RUNS)
    if isinstance(excitation, UnbalanceTable):
        if rotor.unbalance:
            raise InputError(
                "rigid_rotor.unbalance must be 0 where [excitation] has the unbalance, "
                f"got {rotor.unbalance:g} beside {excitation.unbalance:g} kg m"
            )
        turned = excitation.unbalance_angle
        rotor = replace(rotor, unbalance=excitation.unbalance, unbalance_angle=turned)
    if isinstance(excitation, BladeLossTable):
        start, duration = excitation.start, scene.time_of(2.0 * np.pi * excitation.revolutions)
        rotor = replace(rotor, unbalance_angle=turned + scene.speed * start)
    if isinstance(excitation, RunUpTable):
        profile = excitation.profile(scene.speed)
        rotor, duration = replace(rotor, speed=profile), profile.times[-1]
    duration = duration or scene.duration
    require_steps("excitation", duration * abs(scene.speed), scene.cosimulation)
    return DamperScene(rotor, scene.damper.support(), start, duration, scene.macro_step)


def damper_fmus(scene: Scene) -> SceneModels:
    """Return the damper of a scene, springs included, and its rotor, at rest in the center.

    Raises
    ------
    InputError
        As `damper_models`, and if the oil of the damper has mass.
    """
    if scene.damper is not None and scene.damper.density:
        raise InputError(
            "damper.density must be 0 for a damper apart from its rotor: an exchange of accelerations "
            "diverges where the oil is heavier than the rotor; rotorfilm fmu build writes both as one "
            "system.fmu, got "
            f"{scene.damper.density!r}"
        )
    models = damper_models(scene)
    return SceneModels("damper", models.support, models.rotor, {}, models.step, models.duration)
