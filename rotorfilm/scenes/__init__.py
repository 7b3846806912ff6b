"""Scene files: a question in TOML, and its answer."""

from .scene import Scene, bundled_scene, parse_scene
from .solve import Answer

__all__ = ["Answer", "Scene", "bundled_scene", "parse_scene"]
