#!/usr/bin/env -S uv run --script
# /// script
# dependencies = ["nox>=2024.4.15"]
# ///
"""Tasks of developers: `nox` runs checks and tests, `nox -s docs` builds the site; `nox -l` lists them."""

import nox

nox.needs_version = ">=2024.4.15"
nox.options.default_venv_backend = "uv|virtualenv"


@nox.session
def lint(session: nox.Session) -> None:
    """Check form, spelling, pages and workflows, as before a commit."""
    session.install(".[dev]")
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")
    session.run("python", "tools/check_words.py")


@nox.session
def types(session: nox.Session) -> None:
    """Check types."""
    session.install(".[dev]")
    session.run("mypy")


@nox.session(python=["3.11", "3.12", "3.13"])
def tests(session: nox.Session) -> None:
    """Run the tests against the installed package: `nox -s tests-3.12 -- tests/fmi`."""
    session.install(".[test]")
    session.run("pytest", *session.posargs)


@nox.session(default=False)
def docs(session: nox.Session) -> None:
    """Build the site into docs/_build/html, with every example executed."""
    session.install(".[docs]")
    session.run("python", "-m", "sphinx", "-q", "-b", "html", "docs", "docs/_build/html")


@nox.session(default=False)
def packages(session: nox.Session) -> None:
    """Build the source distribution, and a wheel for each platform, into dist/."""
    session.install("build", "wheel", ".[platforms]")
    session.run("python", "-m", "build", "--sdist")
    session.run("python", "tools/build_wheels.py")


if __name__ == "__main__":
    nox.main()
