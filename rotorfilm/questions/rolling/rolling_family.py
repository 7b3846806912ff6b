"""What ball bearings by their dimensions bring to scenes and questions."""

from __future__ import annotations

from ...scenes.export_scene import film_models
from ...scenes.families import Family
from ...scenes.rolling.ball_table import BallTable
from .ball_question import UNITS
from .ball_rungs import ball_ladder

FAMILY = Family(table=BallTable, ladders=dict.fromkeys(UNITS, ball_ladder), models=film_models)
