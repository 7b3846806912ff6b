"""What is kept of a computation is known by the source of all that decides it."""

import pytest

from rotorfilm.core import sources

MAKERS = {
    "rotorfilm.bearings.contact.contact_law": (
        {"contact.film_newton", "contact.stationary", "contact.film_equations"},
        {"contact.contact_steps", "contact.ball_support", "journal.bearing"},
    ),
    "rotorfilm.bearings.journal.groove_map": (
        {"films.geometry", "films.finite_volumes", "films.map_fit"},
        {"journal.reynolds_film", "contact.film_newton"},
    ),
    "rotorfilm.bearings.damper.squeeze_map": (
        {"damper.squeeze_films", "films.map_table", "films.map_fit"},
        {"damper.bearing", "journal.bearing"},
    ),
}


def digest(module, monkeypatch, changed=""):
    """Return the digest of a module, as if the source of another had one line more."""
    source_of = sources.source_of
    with monkeypatch.context() as patch:
        patch.setattr(
            sources,
            "source_of",
            lambda name: source_of(name) + (b"# new\n" if name.endswith(changed) else b""),
        )
        return sources.source_digest.__wrapped__(module)


@pytest.mark.parametrize("module", MAKERS)
def test_the_digest_is_of_all_that_a_module_imports_from_its_physics(module, monkeypatch):
    deciding, others = MAKERS[module]
    here = digest(module, monkeypatch, "nothing")
    assert here == sources.source_digest(module)
    for name in deciding | {module.removeprefix("rotorfilm.bearings.")}:
        assert digest(module, monkeypatch, f"bearings.{name}") != here
    for name in others:
        assert digest(module, monkeypatch, f"bearings.{name}") == here


def test_a_package_that_only_gathers_names_decides_nothing(monkeypatch):
    module = "rotorfilm.bearings.damper.squeeze_map"
    assert digest(module, monkeypatch, "rotorfilm.bearings.damper") == sources.source_digest(module)


def test_the_closure_names_packages_too():
    closure = sources.import_closure(["rotorfilm.rotors.rigid"])
    assert {"rotorfilm", "rotorfilm.rotors", "rotorfilm.rotors.profile", "rotorfilm.core.errors"} <= set(
        closure
    )
    assert sources.import_closure(["rotorfilm.core.units"], shelves={"rotorfilm"})["rotorfilm"] == b""
