"""Scene files: a question in TOML, and its answer."""

from .ross import RossRotor, read_ross
from .ross_bearing import to_ross
from .scene import Scene, bundled_scene, parse_scene
from .solve import Answer

__all__ = ["Answer", "RossRotor", "Scene", "bundled_scene", "parse_scene", "read_ross", "to_ross"]
