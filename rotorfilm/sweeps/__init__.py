"""Many variants of a scene: a grid or samples of its keys, into one dataset."""

from .sweep_run import sweep

__all__ = [
    "sweep",
]
