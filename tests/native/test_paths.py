"""How the library reads the location of the resources."""

import subprocess

import pytest


@pytest.fixture
def paths(compiled):
    return compiled([compiled.here / "paths.c", *sorted(compiled.native.rglob("*.c"))])


@pytest.mark.long
def test_uris_and_paths_of_all_systems(paths):
    expected = {
        "file:///tmp/a/resources": "/tmp/a/resources/rotorfilm.bin",
        "file:/tmp/a/resources/": "/tmp/a/resources/rotorfilm.bin",
        "file://localhost/tmp/a": "/tmp/a/rotorfilm.bin",
        "file:///tmp/a%20b%2Fc%c3%A4/%23": "/tmp/a b/cä/#/rotorfilm.bin",
        "file:///C:/Users/a%20b/resources": "C:/Users/a b/resources/rotorfilm.bin",
        "file:/C:/resources": "C:/resources/rotorfilm.bin",
        "file://C:/resources": "C:/resources/rotorfilm.bin",
        "file://server/share/resources": "//server/share/resources/rotorfilm.bin",
        "/tmp/a b%20/resources": "/tmp/a b%20/resources/rotorfilm.bin",
        "/tmp/resources/": "/tmp/resources/rotorfilm.bin",
        "C:\\temp\\resources\\": "C:\\temp\\resources\\rotorfilm.bin",
        "relative": "relative/rotorfilm.bin",
    }
    refused = ["", "file:", "file://", "file:///a%2", "file:///a%zz", "file:///a%00b"]
    ran = subprocess.run([paths, *expected, *refused], capture_output=True, check=True)
    answers = ran.stdout.decode().splitlines()
    assert dict(zip(expected, answers, strict=False)) == expected
    for text, answer in zip(refused, answers[len(expected) :], strict=True):
        assert answer == f"the resources of the FMU must be a file URI or a path, got '{text}'"
