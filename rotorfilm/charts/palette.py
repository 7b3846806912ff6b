"""Colors of the charts: one for each family of films, the same in every chart."""

from __future__ import annotations

FAMILY_COLORS = {
    "short film": "#8c564b",
    "published": "#e377c2",
    "fixed arc": "#d62728",
    "rotating arc": "#ff7f0e",
    "Reynolds arc": "#a08000",
    "free arc": "#2ca02c",
    "2-D": "#17a0b8",
    "2-D extrapolated": "#1f4fb4",
    "map": "#000000",
}
"""Colors by the family of a rung."""

FAMILY_WIDTHS = {
    "short film": 9.0,
    "2-D": 6.5,
    "2-D extrapolated": 5.0,
    "Reynolds arc": 3.6,
    "free arc": 2.8,
    "map": 1.1,
}
"""Widths of lines that may coincide [points]: the wider lies below, showing on both sides of the other."""

USUAL_WIDTH = 1.6
"""Width of the lines of all other families [points]."""

FRONT = "#7030a0"
"""Color of a Pareto front."""

BAD, DOUBTFUL, GOOD = "#f4b6b0", "#fbe3a8", "#cfe8cf"
"""Backgrounds of verdicts."""
