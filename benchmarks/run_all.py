"""Run every benchmark of this folder and keep what it prints: all measured tables in one command.

    python benchmarks/run_all.py [NAME ...]

The outputs go to benchmarks/results/NAME.txt. A benchmark that fails keeps its old output, and the run ends
with 1.
"""

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent


def main(names: list[str]) -> int:
    """Run the benchmarks of these names, all without one; return how many failed."""
    every = sorted(path.stem for path in HERE.glob("*.py") if path != Path(__file__))
    failed = 0
    for name in names or every:
        print(f"=== {name}", flush=True)
        ran = subprocess.run([sys.executable, str(HERE / f"{name}.py")], capture_output=True, text=True)
        print(ran.stdout if ran.returncode == 0 else ran.stderr, flush=True)
        failed += ran.returncode != 0
        if ran.returncode == 0:
            (HERE / "results" / f"{name}.txt").write_text(ran.stdout, encoding="utf-8")
    return failed


if __name__ == "__main__":
    sys.exit(1 if main(sys.argv[1:]) else 0)
