"""Every example runs as a user runs it, is short, and ends in a number that is checked here."""

import os
import re
import runpy
import subprocess
import sys
import warnings
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from rotorfilm import ValidityWarning
from rotorfilm.scenes import Scene, bundled_scene
from rotorfilm.scenes.solve_shaft import solve_level_one, solve_rotor

EXAMPLES = Path(__file__).parents[1] / "examples"
STUDIES = EXAMPLES.parent / "benchmarks" / "studies"
SCRIPTS = [*sorted(EXAMPLES.glob("*.py")), STUDIES / "damper_paper.py", STUDIES / "journal_paper.py"]
SCENES = sorted(EXAMPLES.glob("*.toml"))
WARNS = {
    "turbine_bearing.toml": "left out: (turbulence|inertia of the film)",
    "rotor_questions.toml": "left out: (drive|impeller)_end, at 251.3 rad/s: (heat|cavitation)",
}
"""Scenes whose answer comes with a limit of the physics."""

LAST_NUMBER = {
    # Friswell et al. (2010), example 5.9.6
    "static_coefficients.py": pytest.approx(12807959, abs=1.0),
    # short bearing: omega sqrt(c/g) at the threshold, e = 0.5
    "whirl_threshold.py": pytest.approx(2.541731, abs=1e-6),
    # tan(attitude) = pi sqrt(1 - e^2) / (4 e) at e = 0.266297509
    "solve_scene.py": pytest.approx(70.62004, abs=1e-4),
    # K_xy = C_xx speed / 2, which the Reynolds equation forces as eccentricity goes to zero
    "native_fmu.py": pytest.approx(1.0, abs=1e-6),
    # symmetry of two opposite grooves
    "grooved_fmu.py": pytest.approx(1.0, abs=1e-10),
    # the force is held over a macro step: first order
    "cosimulation.py": pytest.approx(1.0, abs=0.08),
    # cos(alpha) = 1 - thermal closing / clearance: Evtushenko & Kovalenko (1993) print .521
    "melting_bush.py": pytest.approx(0.520632, abs=1e-6),
    # the friction carries a part of the load, 1 - 1/sqrt(1 + f^2), and samples are .6 % apart
    "worn_bush.py": pytest.approx(1.008, abs=0.005),
    # critical speed (2.16) of the part of the load that the pressure carries, on 36 nodes
    "bush_scene.py": pytest.approx(1.0, abs=3e-3),
    # Friswell et al. (2010), example 5.9.1 at 4000 rpm: first forward whirl
    "flexible_rotor.py": pytest.approx(87.80, abs=0.005),
    # the whip of a run-up locks onto the first critical speed; the film stiffens it by some per cent
    "whirl_and_whip.py": pytest.approx(1.0, abs=0.03),
    # torque of the motor = torque of steady whirl; the speed still swings a little
    "weak_motor.py": pytest.approx(1.0, abs=4e-3),
    # |H|^2 S; one record of eight seconds has some ten periods of the resonance's memory
    "shaken_rotor.py": pytest.approx(1.0, abs=0.15),
    # 219.1/218.2: the notes have the thresholds with and without moments about the sagged rest
    "sagging_shaft.py": pytest.approx(1.004, abs=0.015),
    # steady full annular rub: |Z r + k_c (1 + i mu) (r - gap)| = u w^2
    "rub.py": pytest.approx(1.0, abs=1e-6),
    # twice the speed is the critical speed of the sound shaft, which the crack lowers by .2 %; steps of .67 %
    "cracked_shaft.py": pytest.approx(1.0, abs=0.014),
    "critical_run_up.py": pytest.approx(0.609, abs=0.01),
    "earthquake.py": pytest.approx(1.089, abs=0.01),
    # the films carry the weight, in the mean over turns
    "rotor_system.py": pytest.approx(1.0, abs=2e-4),
    # the Sommerfeld number knows clearance and viscosity as viscosity / clearance^2 only
    "tolerances.py": pytest.approx(0.0, abs=1e-3),
    # the same by grids: the dam on 128 x 32 cells, the grooves on 192 x 16
    "which_bearing.py": pytest.approx(11.407, rel=5e-3),
    # the cross-coupling as a bearing of its own, in the modes of the rotor
    "api617.py": pytest.approx(1.0, abs=1e-6),
    # the synchronous coefficients are those of a small orbit
    "tilting_pads.py": pytest.approx(1.0, abs=3e-4),
    # whirl ratio of a lightly loaded full film: one half
    "python_control.py": pytest.approx(0.5, abs=2e-3),
    # the orbit of the new unbalance, in closed form
    "blade_loss.py": pytest.approx(1.0, abs=1e-5),
    # a run leaves an orbit later than it ends: 1 as it gets slower
    "run_up.py": pytest.approx(1.52, abs=0.03),
    # Panovko's case without the limits of grid and rectangle: 0.1749, of which this rectangle takes 0.0003
    "contact_film.py": pytest.approx(0.1746, rel=5e-3),
    # off the full film and ball as one system, relative: as good as the reduced law is
    "ball_on_contact.py": pytest.approx(0.0163, abs=0.004),
    # a free rotor on springs of the balls' static stiffness
    "ball_bearing.py": pytest.approx(1.0, abs=0.005),
    # the same with twice the elements: 4290.860 and 4793.408 rad/s
    "spindle.py": pytest.approx(4290.860 / 4793.408, abs=2e-4),
    # implicit Euler makes exp(s t) decay at ln|1 - s dt|/dt: 6.0 for s of the published case, dt = .2, W = 1
    "rolling_ball.py": pytest.approx(6.0, rel=0.03),
    # short bearing, eps .2 at the threshold: the small cycle folds 1 % above it
    "whirl_bifurcation.py": pytest.approx(1.01, abs=5e-4),
    # the same film on cells of a quarter of the size: 956.142; second order
    # another code, 144 x 10 cells: 63.0
    "turbine_bearing.py": pytest.approx(63.0, abs=0.1),
    "grooved_bearing.py": pytest.approx(956.14, rel=2e-4),
    # half-speed whirl
    "three_disks.py": pytest.approx(0.5, abs=0.005),
    # a run leaves the rest later than its threshold: 1 as it gets slower
    "film_run_up.py": pytest.approx(1.047, abs=0.01),
    "fmpy_loop.py": pytest.approx(1.0, abs=1e-9),
    # as first computed; the film, its heat and its loss are tested elsewhere
    "job_coefficients.py": pytest.approx(4920.0, rel=2e-3),
    # pads that tilt have no cross-coupling that drives a whirl
    "job_two_disks.py": pytest.approx(0.0, abs=0.1),
    # half-speed whirl beyond the onset
    "job_run_up.py": pytest.approx(0.5, abs=0.01),
    # the effect of the viscosity, 1.7 um to either side, over sqrt(3); the clearance is near its best
    "job_tolerances.py": pytest.approx(1.7 / 3.0**0.5, rel=0.05),
    # as first computed
    "job_foreign_bearing.py": pytest.approx(6585.9, rel=1e-3),
    # each film carries half of the weight
    "job_machine_fmu.py": pytest.approx(1.0, abs=1e-5),
    "job_absent_elements.py": pytest.approx(4.0, abs=0.1),
    # the clearance of the machine, within the noise of the sensors
    "job_fit.py": pytest.approx(1.0, abs=0.01),
    # up and down
    "job_damper_jump.py": pytest.approx(2.0, abs=0.1),
    # as first computed
    "job_spindle.py": pytest.approx(0.2696, abs=5e-4),
    # a compressor that API 617 accepts
    "reports.py": pytest.approx(0.0, abs=0.1),
    # closed form: |T| = 1 at sqrt(2 K/m) whatever the damping
    # |T| = 1 at omega^2 = 2 K/(m + 2 M)
    "turbocharger_damper.py": pytest.approx(1.0, abs=1e-6),
    "damper_bode.py": pytest.approx(1.0, abs=1e-12),
    # a film knows clearance and viscosity as viscosity / clearance^2 only
    "two_parameters.py": pytest.approx(0.0, abs=1e-12),
    # flat pads that follow: K = 2 F/h_p in slow motion
    "thrust_bearing.py": pytest.approx(1.0, abs=1e-6),
    # below 1, as it says itself
    "ask_to_a_tolerance.py": pytest.approx(0.5, abs=0.5),
    # temperatures of FMU and Python [K]: the FMU holds its inputs over a step, 2e-4 of the rise
    "cold_start.py": pytest.approx(0.0, abs=0.02),
    # the clearance of the machine, 1 % below to 1 % above with such sensors
    "fit_clearance.py": pytest.approx(1.0, abs=0.015),
    # fold of the response of a solid damper at Bs = .08, Omega_s = .4
    # Sussi & Fridman (1978): from the second approximation on damping is symmetric
    "journal_paper.py": pytest.approx(1.0, abs=1e-12),
    "damper_paper.py": pytest.approx(0.3931, abs=5e-5),
}


OURS = r"(rotorfilm|__main__)\b"
"""As in pyproject.toml: our own warnings are errors."""

STRICT = f"import warnings; warnings.filterwarnings('error', module=r'{OURS}')\n"
RUN = "import runpy, sys; runpy.run_path(sys.argv[1], run_name='__main__')"


def test_a_user_runs_an_example_in_a_process_of_its_own(tmp_path):
    path, environment = EXAMPLES / "static_coefficients.py", {**os.environ, "MPLBACKEND": "Agg"}
    command = [sys.executable, "-c", STRICT + RUN, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path, env=environment)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout.split()[-1]) == LAST_NUMBER[path.name]


MANY_SECONDS = {
    "ball_on_contact.py",
    "cold_start.py",
    "whirl_bifurcation.py",
    "worn_bush.py",
    "ball_bearing.py",
    "job_coefficients.py",
    "job_two_disks.py",
    "job_machine_fmu.py",
}
RUN_HERE = [pytest.param(path, marks=[pytest.mark.long] * (path.name in MANY_SECONDS)) for path in SCRIPTS]


@pytest.mark.parametrize("path", RUN_HERE, ids=lambda path: path.name)
def test_example_ends_in_its_number(path, tmp_path, monkeypatch, capsys):
    # In this process, where all is imported already.
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [str(path)])
    with warnings.catch_warnings():
        warnings.filterwarnings("error", module=OURS)
        warnings.filterwarnings("ignore", ".*beyond the Reynolds number", ValidityWarning)
        runpy.run_path(str(path), run_name="__main__")
    assert float(capsys.readouterr().out.split()[-1]) == LAST_NUMBER[path.name]
    for picture in re.findall(r'savefig\("(.*)"\)', path.read_text(encoding="utf-8")):
        assert len(np.unique(imread(tmp_path / picture))) > 20


@pytest.mark.parametrize("path", [*SCRIPTS, *SCENES], ids=lambda path: path.name)
def test_example_is_short(path):
    assert len(path.read_text(encoding="utf-8").splitlines()) < 80


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.name)
def test_scene_file_loads_and_solves(path):
    scene = Scene.load(path)
    if scene.question is not None:
        with pytest.warns(ValidityWarning, match=WARNS[path.name]) if path.name in WARNS else nullcontext():
            asked = scene.solve()
        assert asked.met
        assert asked.error_estimate <= asked.tolerance
    elif scene.shaft is not None and scene.shaft.compressor is not None:
        found = solve_level_one(scene)
        assert not found.level_two_required
        assert found.anticipated_decrement < min(curve.log_decrement.max() for curve in found.curves)
    elif scene.shaft is not None:
        found = solve_rotor(scene)
        assert found.residual < 1e-9
        assert found.threshold.whirl_ratio == pytest.approx(0.5, abs=0.02)
    elif scene.bush is not None:
        # Evtushenko & Kovalenko (1993) print .201 rad.
        assert scene.solve().contact.contact_angle == pytest.approx(0.201, abs=5e-4)
    elif scene.damper is not None or scene.contact is not None:
        named = path.with_suffix(".py") in SCRIPTS or path.name in (EXAMPLES / "reports.py").read_text()
        assert named  # that script runs it
    else:
        assert scene.solve().equilibrium.residual < 1e-10


def test_shown_scene_is_the_bundled_one():
    assert Scene.load(EXAMPLES / "friswell.toml") == bundled_scene()
