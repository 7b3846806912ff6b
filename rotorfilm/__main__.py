"""The program `rotorfilm`, which is `python -m rotorfilm`: the version at once, and else the command line."""

import sys


def main() -> None:
    """Run the program with the arguments that it was started with."""
    if sys.argv[1:] == ["--version"]:
        from .core.sources import installed_version

        sys.stdout.write(f"rotorfilm {installed_version()}\n")
    else:
        from .cli.main import main as run

        run()


if __name__ == "__main__":
    main()
