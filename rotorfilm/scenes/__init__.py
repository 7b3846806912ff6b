"""Scene files: a question in TOML, and its answer."""

from .ross import RossRotor, read_ross
from .scene import Scene, bundled_scene, parse_scene, read_scene
from .solve import Answer

__all__ = ["Answer", "RossRotor", "Scene", "bundled_scene", "parse_scene", "read_ross", "read_scene"]
