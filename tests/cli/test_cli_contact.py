"""The rolling ball at the command line: its numbers, responses, files, and one line for each mistake."""

import json
import signal
import subprocess
import sys

import numpy as np
import pytest

from rotorfilm import ContactGrid, PointContact, RollingBall, StepLoad, reduce_ball, reduce_contact
from rotorfilm.cli import main as cli

OPTIONS = {
    "--radius": "10 mm",
    "--mass": "33 g",
    "--modulus": "206 GPa",
    "--poisson-ratio": "0.3",
    "--viscosity": "8 mPa s",
    "--pressure-coefficient": "5 1/GPa",
    "--speed": "0.9 m/s",
    "--load": "10 N",
    "--cells": "20",
}
PLAIN = ["contact", "--v", "0.1", "--q0", "5", "--w", "1", "--cells", "20"]
BALL = RollingBall(
    radius=0.01, mass=0.033, modulus=206e9, poisson_ratio=0.3, viscosity=0.008,
    pressure_coefficient=5e-9, speed=0.9, load=10.0,
)  # fmt: skip


def ball(*flags, drop=()):
    return [
        "contact",
        *(w for name, value in OPTIONS.items() if name not in drop for w in (name, value)),
        *flags,
    ]


@pytest.fixture(autouse=True)
def _cache(tmp_path_factory, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path_factory.getbasetemp() / "contact-cache"))


@pytest.fixture
def run(capsys):
    def call(arguments):
        with pytest.raises(SystemExit) as exit_:
            cli.main([str(argument) for argument in arguments])
        out, err = capsys.readouterr()
        return exit_.value.code or 0, out, err

    return call


def test_numbers_are_those_of_the_library_in_si(run):
    code, out, _ = run(ball("--json"))
    assert code == 0
    answer = json.loads(out)
    contact = BALL.contact(ContactGrid(cells=(20, 20)))
    state, law = contact.stationary(), reduce_ball(BALL, contact)
    expected = {
        "V": BALL.V,
        "W": BALL.W,
        "approach": state.delta * BALL.film_scale,
        "central_film": state.central_film * BALL.film_scale,
        "maximum_pressure": state.pressure.max() * BALL.contact_pressure,
        "stiffness": law.stiffness,
        "damping": law.damping,
    }
    assert {name: answer[name] for name in expected} == pytest.approx(expected)
    assert answer["published"] == pytest.approx(BALL.published_films._asdict())
    assert answer["moes"]["M"] == pytest.approx(BALL.moes.M)
    assert answer["response"] is None


def test_a_response_by_the_reduced_law(run):
    code, out, _ = run(ball("--sine", "0.3", "--frequency", "12000 rad/s", "--duration", "1 ms", "--json"))
    assert code == 0
    response = json.loads(out)["response"]
    assert response["model"] == "reduced law"
    assert response["time"][-1] == pytest.approx(1e-3)
    assert 10.0 < max(response["force"]) < 30.0
    # Slow swings are static: stiffness times swing of the approach is that of the load.
    code, out, _ = run(ball("--sine", "0.01", "--frequency", "100 rad/s", "--duration", "63 ms", "--json"))
    answer = json.loads(out)
    swing = np.ptp(answer["response"]["approach"])
    assert swing * answer["stiffness"] == pytest.approx(2.0 * 0.01 * 10.0, rel=0.02)


def test_the_full_film_is_saved_and_resumed(run, tmp_path):
    path = tmp_path / "run.nc"
    first = run([*PLAIN, "--step", "0.2", "--duration", "0.5", "--save", path, "--json"])
    again = run([*PLAIN, "--step", "0.2", "--duration", "0.4", "--resume", path, "--json"])
    responses = [json.loads(out)["response"] for _, out, _ in (first, again)]
    assert [response["model"] for response in responses] == ["full film"] * 2
    assert responses[1]["approach"][0] == responses[0]["approach"][-1]
    assert responses[1]["time"][-1] == pytest.approx(0.9)
    contact = PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(20, 20)))
    whole = contact.simulate(contact.stationary(), duration=0.9, W=1.0, load=StepLoad(amplitude=0.2))
    assert responses[1]["approach"][-1] == pytest.approx(whole.delta[-1], abs=1e-3)


KILLED = """
import os, signal, sys
from rotorfilm.bearings.contact import PointContact
from rotorfilm.bearings.contact.motion import contact_run
from rotorfilm.cli.main import main
contact_run.EVERY = -1.0
save = PointContact.save
def save_and_die(self, run, path):
    save(self, run, path)
    if len(run.time) > 5:
        os.kill(os.getpid(), signal.SIGKILL)
PointContact.save = save_and_die
main(sys.argv[1:])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGKILL")
def test_a_killed_run_goes_on_to_the_last_bit(run, tmp_path):
    command = [*PLAIN, "--sine", "0.3", "--frequency", "3", "--duration", "4"]
    assert run([*command, "--save", tmp_path / "whole.nc"])[0] == 0
    part = tmp_path / "part.nc"
    # Not from the checkout, whose package would hide the installed one.
    killed = subprocess.run([sys.executable, "-c", KILLED, *command, "--save", str(part)], cwd=tmp_path)
    assert killed.returncode == -signal.SIGKILL
    code, out, _ = run([*command, "--save", part, "--resume", part, "--json"])
    response = json.loads(out)["response"]
    assert code == 0
    assert (response["complete"], response["time"][0], response["time"][-1]) == (True, 0.0, 4.0)
    assert part.read_bytes() == (tmp_path / "whole.nc").read_bytes()


def test_a_damaged_file_is_named(run, tmp_path):
    (tmp_path / "run.nc").write_bytes(b"CDF\x01" + bytes(200))
    code, out, err = run([*PLAIN, "--resume", tmp_path / "run.nc"])
    assert (code, out) == (2, "")
    assert "run.nc' must end with the seal of rotorfilm: it is cut off, or another file" in err


@pytest.mark.filterwarnings("default::rotorfilm.core.errors.FileWarning")
def test_a_spoiled_cache_and_a_run_that_could_not_be_saved_are_told(run, tmp_path, monkeypatch):
    monkeypatch.setenv("ROTORFILM_CACHE", str(tmp_path / "cache"))
    assert "warning" not in run(PLAIN)[2]
    (path,) = (tmp_path / "cache").glob("contact-*.npz")
    path.write_bytes(path.read_bytes()[:-1])
    code, _, err = run(PLAIN)
    assert code == 0
    assert "warning: the operating point is made again: " in " ".join(err.split())
    save = ["--save", tmp_path / "absent" / "run.nc"]
    _, _, err = run([*PLAIN, "--step", "0.2", "--duration", "0.1", *save])
    assert "warning: the run could not be saved: " in " ".join(err.split())


def test_tables_for_people(run):
    code, out, _ = run([*PLAIN, "--step", "0.2"])
    assert code == 0
    law = reduce_contact(PointContact(V=0.1, Q0=5.0, grid=ContactGrid(cells=(20, 20))))
    assert f"{law.stiffness:.5g}" in out
    assert "response by the reduced law" in out
    assert "nijenbanning venner moes" in out
    code, out, _ = run(ball())
    assert " nm" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["contact", "--v", "0.1"], "--v and --q0 must be given together"),
        (["contact", "--v", "-0.1", "--q0", "5"], "V must be finite and positive, got -0.1"),
        (["contact", "--radius", "1 mm"], "--modulus, --poisson-ratio, --viscosity"),
        ([*PLAIN, "--load", "10 N"], "give no option of these too"),
        ([*PLAIN, "--step", "1", "--sine", "1", "--frequency", "1"], "--step and --sine must not both"),
        ([*PLAIN, "--sine", "1"], "--sine and --frequency must be given together"),
        (ball("--step", "0.1", drop=("--mass",)), "--mass (or --w) must be positive for a response"),
        (ball("--sine", "0.1", "--frequency", "1 mm"), "--frequency: quantity must be measured in rad/s"),
        ([*PLAIN, "--cells", "3"], "cells must be two integers of at least 8"),
    ],
)
def test_one_line_for_each_mistake(run, arguments, message):
    code, out, err = run(arguments)
    assert (code, out) == (2, "")
    assert message in " ".join(err.split())
