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
    "short film": 7.0,
    "published": 3.8,
    "fixed arc": 2.4,
    "rotating arc": 1.3,
    "Reynolds arc": 3.4,
    "free arc": 2.8,
    "2-D": 5.2,
    "2-D extrapolated": 4.2,
    "map": 1.1,
}
"""Widths of lines [points]: of curves that coincide the wider lies below and shows beside the other."""

DASHES = {"map": (0.0, (4.0, 3.0))}
"""Dashes of lines by family, in widths; of all others the first is solid."""

WITHIN = ("-", "--", ":", "-.")
"""Lines that tell the films of a family apart."""

FRONT = "#7030a0"
"""Color of a Pareto front."""

BAD, DOUBTFUL, GOOD = "#f4b6b0", "#fbe3a8", "#cfe8cf"
"""Backgrounds of verdicts."""
