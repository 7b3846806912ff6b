"""Questions that a scene may ask: one file per family, each with its rungs and their error estimates."""

from .registry import ask, ladder_of

__all__ = ["ask", "ladder_of"]
