"""Scene files: a question in TOML, and its answer."""

from .export_rotor import export_rotor_fmu
from .ross import RossRotor, read_ross
from .ross_bearing import to_ross
from .scene import Scene, bundled_scene, parse_scene, read_scene
from .solve import Answer

__all__ = [
    "Answer",
    "RossRotor",
    "Scene",
    "bundled_scene",
    "export_rotor_fmu",
    "parse_scene",
    "read_ross",
    "read_scene",
    "to_ross",
]
