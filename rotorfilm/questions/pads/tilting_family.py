"""What tilting pads bring to scenes and questions."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ...scenes.export_scene import film_models
from ...scenes.families import Family, SceneModels
from ...scenes.pads.tilting_table import TiltingTable
from ..orbit_place import UNITS as ORBITS
from .fixed_ladders import PAD_STATICS
from .tilting_orbits import tilting_orbit_ladder
from .tilting_rungs import tilting_rest_ladder, tilting_whirl_ladder
from .warm_pads import settled_scene

if TYPE_CHECKING:
    from ...scenes.scene import Scene


def tilting_models(scene: Scene) -> SceneModels:
    """Return the tilting pads of a scene and its rotor, all at rest, the films as warm as there."""
    scene = settled_scene(scene)
    models = film_models(scene)
    bearing = scene.table("tilting_pad").build()
    rest = np.array([models.start["x"], models.start["y"]])
    pads = bearing.at_rest().pad_states(rest, scene.speed)
    places = pads.tilts if bearing.pivot_stiffness is None else [*pads.tilts, *pads.pivot_deflections]
    return models._replace(bearing=replace(bearing, start=tuple(float(place) for place in places)))


FAMILY = Family(
    table=TiltingTable,
    ladders={
        **dict.fromkeys(PAD_STATICS, tilting_rest_ladder),
        **dict.fromkeys(ORBITS, tilting_orbit_ladder),
        "whirl_threshold": tilting_whirl_ladder,
    },
    models=tilting_models,
)
