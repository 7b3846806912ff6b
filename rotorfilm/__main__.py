"""The program `rotorfilm`, which is `python -m rotorfilm`: the version at once, and else the command line."""

import os
import sys


def main() -> None:
    """Run the program with the arguments that it was started with.

    Matrices of rotors are small: threads of a BLAS wait for each other longer than they work. So there is
    one, unless the environment says otherwise; jobs of many scenes take processes.
    """
    for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ.setdefault(name, "1")
    if sys.argv[1:] == ["--version"]:
        from .core.sources import installed_version

        sys.stdout.write(f"rotorfilm {installed_version()}\n")
    else:
        from .cli.main import main as run

        run()


if __name__ == "__main__":
    main()
