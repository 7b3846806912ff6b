"""Scene files: a question in TOML, and its answer."""

from typing import TYPE_CHECKING

from ..sources import show

if TYPE_CHECKING:
    from .journal.solve_journal import Answer as Answer
    from .scene import Scene as Scene, bundled_scene as bundled_scene, parse_scene, read_scene
    from .shaft.export_rotor import export_rotor_fmu as export_rotor_fmu
    from .shaft.ross import RossRotor as RossRotor, read_ross as read_ross
    from .shaft.ross_bearing import to_ross as to_ross, to_ross_force as to_ross_force
else:
    show(__name__)
