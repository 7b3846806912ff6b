"""Scene files: a question in TOML, and its answer."""

from .journal.solve_journal import Answer
from .scene import Scene, bundled_scene, parse_scene, read_scene
from .shaft.export_rotor import export_rotor_fmu
from .shaft.ross import RossRotor, read_ross
from .shaft.ross_bearing import to_ross
