"""Scene files: a question in TOML, and its answer."""

from typing import TYPE_CHECKING

from ..core.sources import show

if TYPE_CHECKING:
    from ..bearings.damper.answer import run_damper
    from .export_scene import (
        export_machine_fmu as export_machine_fmu,
        export_rotor_fmu as export_rotor_fmu,
    )
    from .film_answer import Answer as Answer
    from .ross import (
        RossRotor as RossRotor,
        read_ross as read_ross,
        read_ross_bearings as read_ross_bearings,
        to_ross as to_ross,
        to_ross_force as to_ross_force,
    )
    from .save_scene import scene_of as scene_of
    from .scene import (
        QuestionTable,
        Scene as Scene,
        bundled_scene as bundled_scene,
        json_schema,
        parse_scene,
        read_scene,
        varied,
    )
    from .shared_tables import Lubricant
else:
    show(__name__)
