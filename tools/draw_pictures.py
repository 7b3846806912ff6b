"""Draw every picture of the README and of the documentation anew, from the current tree.

    python tools/draw_pictures.py [PICTURE ...]

Without names it draws all but `chart_ross.png`, which `benchmarks/beside_ross.py` draws, for it needs ROSS.
Charts of cost are to be drawn while nothing else runs.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PHYSICS = ("journal", "supply", "heat", "rotor", "damper", "contact", "bush")
DRAWN = {
    "rotorfilm demo --out .": ["demo"],
    "rotorfilm chart journal --out .": ["chart_journal"],
    "rotorfilm chart stability --out .": ["chart_stability"],
    "rotorfilm chart bearings --out .": ["chart_bearings", "chart_whirl"],
    "rotorfilm chart pads --out .": ["chart_pads"],
    "rotorfilm chart rolling --out .": ["chart_rolling", "chart_rolling_ladder"],
    "rotorfilm chart contact --out .": ["chart_contact"],
    "python benchmarks/studies/contact_cases.py --out .": ["chart_contact_cases"],
    "rotorfilm chart limits --out .": ["chart_limits", *(f"chart_limits_{name}" for name in PHYSICS)],
    "rotorfilm chart heat --out .": ["chart_heat", "chart_heat_film"],
    "rotorfilm chart damper --out .": ["chart_damper"],
    "rotorfilm chart cosim --out .": ["chart_cosim_limits", "chart_cosim_cost"],
    "python docs/draw_pads.py pads.png": ["pads"],
    "python benchmarks/bush.py bush.png": ["bush"],
    "python benchmarks/damper.py damper_ladder.png": ["damper_ladder"],
    "python benchmarks/studies/damper_paper.py": ["damper_paper"],
    "python benchmarks/studies/journal_paper.py": ["journal_paper"],
    "python benchmarks/conserved_damper.py damper_turn.png": ["damper_turn"],
    "python benchmarks/open/compare.py chart_open.png": ["chart_open"],
    "python benchmarks/turbulence.py --scenes 0 --out .": ["chart_turbulence"],
    "python benchmarks/periodic_orbits.py orbits_cost.png": ["orbits_cost"],
    "python benchmarks/rotor_size.py rotor_size.png": ["rotor_size"],
    "python benchmarks/rotor_transient.py rotor_transient.png": ["rotor_transient"],
    "python examples/api617.py": ["api617"],
    "python examples/contact_film.py": ["contact"],
    "python examples/cracked_shaft.py": ["cracked_shaft"],
    "python examples/flexible_rotor.py": ["campbell", "rotor", "unbalance_response"],
    "python examples/rub.py": ["rub"],
    "python examples/thrust_bearing.py": ["thrust"],
    "python benchmarks/thrust_models.py": ["thrust_models"],
    "python examples/whirl_and_whip.py": ["whirl_and_whip", "waterfall", "orbits_run_up"],
    "python examples/whirl_bifurcation.py": ["whirl_bifurcation"],
}
"""The pictures of each command, which it writes into the folder where it runs."""


def program(command: str) -> list[str]:
    """Return a command as this Python starts it: its scripts by their place in the tree."""
    words = [str(ROOT / word) if word.endswith(".py") else word for word in shlex.split(command)]
    return [sys.executable, *(("-m", *words) if words[0] == "rotorfilm" else words[1:])]


def draw(command: str) -> int:
    """Run a command in a folder of its own and take its pictures over; return its exit status."""
    with tempfile.TemporaryDirectory() as folder:
        told = Path(folder, "told.txt")
        with told.open("w", encoding="utf-8") as out:
            ran = subprocess.run(
                program(command),
                cwd=folder,
                env={**os.environ, "MPLBACKEND": "Agg"},
                stdout=out,
                stderr=subprocess.STDOUT,
            )
        if ran.returncode:
            print(told.read_text(encoding="utf-8"), flush=True)
            return ran.returncode
        for name in DRAWN[command]:
            shutil.copy(Path(folder, f"{name}.png"), ROOT / "docs")
    return 0


def main(names: Iterable[str]) -> int:
    """Draw these pictures, all without one; return how many commands failed."""
    wanted, failed = set(names), 0
    for command, pictures in DRAWN.items():
        if wanted and wanted.isdisjoint(pictures):
            continue
        print(f"=== {command}: {' '.join(pictures)}", flush=True)
        failed += draw(command) != 0
    return failed


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
