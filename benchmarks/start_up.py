"""Start-up: CPU time until a first answer, in those of `import numpy` in a fresh Python of the same run.

The goals are what a user of a script or a shell would not notice. Byte code is kept, as it is of what is
installed, even where the environment forbids it. Unix only.
"""

import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

FORCE = """
from rotorfilm import JournalBearing
bearing = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
bearing.force([3e-5, 0.0], [0.0, 0.0], 100.0)
"""
SCENE = Path(__file__).parents[1] / "examples" / "friswell.toml"
PATHS = {
    "import numpy": (["-c", "import numpy"], 1.0),
    "rotorfilm --version": (["-m", "rotorfilm", "--version"], 1.2),
    "rotorfilm --help": (["-m", "rotorfilm", "--help"], 2.0),
    "one force of a map film": (["-c", FORCE], 1.75),
    "rotorfilm solve": (["-m", "rotorfilm", "solve", str(SCENE)], 3.0),
}
ROUNDS = 7


def cpu_time(arguments: list[str], byte_code: str) -> float:
    """Return the CPU time [s] of a fresh Python with these arguments, and byte code in a folder."""
    settings = {**os.environ, "PYTHONPYCACHEPREFIX": byte_code, "PYTHONDONTWRITEBYTECODE": ""}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([sys.executable, *arguments], capture_output=True, check=True, env=settings)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print the table; the first round, which writes byte code, does not count."""
    with tempfile.TemporaryDirectory() as folder:
        rounds = [
            {name: cpu_time(words, folder) for name, (words, _) in PATHS.items()} for _ in range(ROUNDS + 1)
        ]
    medians = {name: statistics.median(one[name] for one in rounds[1:]) for name in PATHS}
    print(f"{'':24}  CPU [ms]  times numpy  goal")
    for name, (_, goal) in PATHS.items():
        ratio = medians[name] / medians["import numpy"]
        print(f"{name:24}  {1e3 * medians[name]:8.0f}  {ratio:11.2f}  {goal:4.2f}")


if __name__ == "__main__":
    main()
