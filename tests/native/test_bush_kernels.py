"""The compiled bush models: those of Python to roundoff, steps against an accurate solution, events."""

import math
from ctypes import c_double
from dataclasses import replace

import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rotorfilm import Friction
from rotorfilm.bearings import ContactBalance, GlobalBalance, LocalMelting, SharedMelting
from rotorfilm.bearings.bush import BushReaction, BushWear, f4k20_bush

pytestmark = pytest.mark.filterwarnings(
    "ignore:(friction must cover the heat losses of|load and speed must keep) a worn contact"
    ":rotorfilm.core.errors.ValidityWarning"
)

BUSH = f4k20_bush()
LOAD = 3750.0
ONSET = float(BUSH.critical_speed(LOAD))
WEAR = BushWear(bush=BUSH, melting_heat=1e8)
FRICTIONS = (Friction(f0=0.1), Friction(f0=0.1, f1=2e-4, f2=-4e-7), Friction(f0=0.02, f1=1e-4, f2=5e-7))


def worn(**changes):
    model = BushReaction(bush=BUSH, melting_heat=1e8, nodes=40, extent=1.6, retardation=1e-3)
    depths = tuple(np.random.default_rng(1).uniform(0.0, 5e-6, 40))
    return replace(model, **{"wear_depth": depths, **changes})


def names(model):
    return [s.name for s in model.outputs]


def states(model):
    return [f"state_{s.name}" for s in model.states]


def indicators(client, count):
    values = (c_double * count)()
    client.fmu.getEventIndicators(values, count)
    return np.array(values)


def opened(unzipped, model, kind, u):
    inputs = dict(zip((s.name for s in model.inputs), map(float, u), strict=True))
    client = unzipped(model, inputs, folder=f"an fmu {np.random.default_rng().integers(2**40)}").open(kind)
    return client.start(), inputs


def compare(client, model, x, u, tolerance=1e-12):
    """Outputs, rates, events and derivatives of an instance in continuous-time mode are the model's."""
    n = len(x)
    client.set(**dict(zip((s.name for s in model.inputs), map(float, u), strict=True)))
    client.set_states(x)
    nominal = np.array([s.nominal for s in model.outputs])
    np.testing.assert_allclose(
        client.get(*names(model)) / nominal, model.output(0.0, x, u) / nominal, rtol=tolerance, atol=tolerance
    )
    rates = model.derivative(0.0, x, u)
    np.testing.assert_allclose(
        client.derivatives(n), rates, rtol=tolerance, atol=tolerance * rates.max(initial=0)
    )
    events = model.events(0.0, x, u)
    np.testing.assert_allclose(
        indicators(client, len(events)), events, rtol=tolerance, atol=tolerance * np.abs(events).max()
    )
    A, B, C, D = model.linearization(0.0, x, u)
    exact = np.block([[C, D], [A, B]])
    unknowns = [*names(model), *(f"der(m.{name})" for name in states(model))]
    knowns = [*states(model), *(s.name for s in model.inputs)]
    found = [client.differentiate(unknowns, [known], [1.0]) for known in knowns]
    # In changes of a nominal input or state, in nominal outputs: what hardly changes is a difference in both.
    by = np.array([s.nominal for s in (*model.states, *model.inputs)])
    size = np.array([*nominal, *np.full(n, max(rates.max(), 1e-12))])[:, None]
    scale = np.maximum(np.abs(exact * by / size).max(axis=1, keepdims=True), 1.0) * size / by
    np.testing.assert_allclose(np.array(found).T / scale, exact / scale, rtol=0, atol=tolerance)


@pytest.mark.parametrize(
    ("kind", "balance"),
    [
        (FMU2Model, ContactBalance()),
        (FMU3Model, GlobalBalance()),
        pytest.param(FMU3Model, ContactBalance(), marks=pytest.mark.long),
        pytest.param(FMU2Model, GlobalBalance(), marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize("friction", FRICTIONS)
def test_one_state_is_that_of_python(unzipped, kind, balance, friction):
    model = replace(WEAR, bush=replace(BUSH, friction=friction, balance=balance))
    client, _ = opened(unzipped, model, kind, (LOAD, 9.0))
    client.pass_event()
    client.fmu.enterContinuousTimeMode()
    rng = np.random.default_rng(0)
    faster = 10.0 if isinstance(balance, GlobalBalance) else 1.0
    melted = 0
    for load, speed, wear in zip(
        10.0 ** rng.uniform(0.5, 4.3, 60),
        rng.uniform(-30, 30, 60),
        10.0 ** rng.uniform(-6, -1.5, 60),
        strict=True,
    ):
        x, u = np.array([wear]), [load, faster * speed]
        compare(client, model, x, u)
        melted += model.derivative(0.0, x, u)[0] > 0.0
    assert 5 < melted < 55


@pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
@pytest.mark.parametrize("melting", [SharedMelting(), LocalMelting()])
@pytest.mark.parametrize(("balance", "speed"), [(ContactBalance(), 12.0), (GlobalBalance(), -200.0)])
@pytest.mark.parametrize("extent", [1.6, 2.0 * math.pi])
def test_the_profile_is_that_of_python(unzipped, kind, melting, balance, speed, extent):
    model = worn(bush=replace(BUSH, balance=balance), melting=melting, extent=extent)
    position = model.position([900.0, -4000.0], speed, model.initial_state)
    client, _ = opened(unzipped, model, kind, (*position, 0.0, 0.0, speed))
    client.pass_event()
    client.fmu.enterContinuousTimeMode()
    rng = np.random.default_rng(2)
    for factor in (0.2, 1.0, 2.0):
        u = [*(position + 2e-6 * rng.normal(size=2)), *(1e-4 * rng.normal(size=2)), factor * speed]
        compare(client, model, rng.uniform(0.0, 5e-6, 40), u)
    compare(client, model, model.initial_state, [*position, 0.0, 0.0, 0.0])
    compare(client, model, model.initial_state, [0.0, 0.0, 0.0, 0.0, speed])


@pytest.mark.parametrize("melting", [SharedMelting(), LocalMelting()])
def test_a_profile_that_is_held_cold_is_that_of_python(unzipped, melting):
    friction = Friction(f0=0.1, f1=2e-4, f2=-4e-7)
    model = worn(bush=replace(BUSH, friction=friction), melting=melting, temperature=190.0)
    position = model.position([0.0, -LOAD], 12.0, model.initial_state)
    u = [*position, 0.0, 0.0, 12.0]
    client, _ = opened(unzipped, worn(bush=model.bush, melting=melting), FMU3Model, u)
    client.pass_event()
    client.set(temperature=190.0)
    client.fmu.enterContinuousTimeMode()
    compare(client, model, model.initial_state, u)
    assert model.output(0.0, model.initial_state, u)[1] == pytest.approx(LOAD, rel=1e-9)


@pytest.mark.parametrize("melting", [SharedMelting(), LocalMelting()])
def test_a_worn_contact_that_is_held_hot_for_nothing_is_told_once(unzipped, capsys, melting):
    model = worn(melting=melting)
    u = [*model.position([0.0, -0.3 * LOAD], 1.0, model.initial_state), 0.0, 0.0, 1.0]
    client, _ = opened(unzipped, model, FMU2Slave, u)
    client.step(0.0, 1e-3)
    client.get(*names(model))
    assert capsys.readouterr().out.count("of them, so the contact cools") == 1
    for given in (249.0, 250.0):
        client, _ = opened(unzipped, replace(model, temperature=given), FMU2Slave, u)
        client.step(0.0, 1e-3)
        client.get(*names(model))
        assert "contact cools" not in capsys.readouterr().out


def accurate(model, u, duration):
    return solve_ivp(
        lambda t, x: model.derivative(t, x, u),
        (0.0, duration),
        model.initial_state,
        "DOP853",
        rtol=1e-12,
        atol=1e-19,
    ).y[:, -1]


@pytest.mark.parametrize("kind", [FMU2Slave, FMU3Slave])
@pytest.mark.parametrize(("speed", "duration"), [(12.0, 1e-4), (12.0, 0.3), (-5.0, 3.0), (25.0, 1.0)])
@pytest.mark.parametrize("steps", [1, 7])
def test_steps_of_one_state_follow_an_accurate_solution(unzipped, kind, speed, duration, steps):
    client, _ = opened(unzipped, WEAR, kind, (LOAD, speed))
    for k in range(steps):
        client.step(k * duration / steps, duration / steps)
    exact = accurate(WEAR, [LOAD, speed], duration)
    assert client.get("state_wear")[0] == pytest.approx(exact[0], rel=1e-10)
    assert exact[0] > 1e-6


@pytest.mark.closed_form
@pytest.mark.parametrize("speed", [5.0, 9.0])
def test_one_very_long_step_ends_where_the_critical_speed_is_the_speed(unzipped, speed):
    """Stiff by a factor of a million: an explicit method would take as many steps."""
    client, _ = opened(unzipped, WEAR, FMU2Slave, (LOAD, speed))
    client.step(0.0, 1e6)
    end = brentq(lambda a: BUSH.critical_speed(LOAD, a) - speed, BUSH.contact_angle(LOAD), 1.5, xtol=1e-15)
    assert client.get("contact_angle")[0] == pytest.approx(end, rel=1e-8)
    assert client.get("speed_ratio")[0] == pytest.approx(1.0, rel=1e-8)


def test_a_worn_bush_that_has_cooled_is_told_once(unzipped, capsys):
    client, _ = opened(unzipped, replace(WEAR, wear=2e-3), FMU3Slave, (0.3 * LOAD, 9.0))
    client.get(*names(WEAR))
    client.step(0.0, 1e-3)
    client.get(*names(WEAR))
    assert capsys.readouterr().out.count("takes it to end on unworn liner") == 1
    client, _ = opened(unzipped, WEAR, FMU3Slave, (0.3 * LOAD, 3.0))
    client.get(*names(WEAR))
    assert "unworn liner" not in capsys.readouterr().out


def test_a_step_below_the_critical_speed_wears_nothing(unzipped):
    client, _ = opened(unzipped, WEAR, FMU3Slave, (LOAD, 0.999 * ONSET))
    client.step(0.0, 100.0)
    assert client.get("state_wear")[0] == 0.0
    assert client.get("temperature")[0] < 250.0


@pytest.mark.parametrize(
    ("kind", "extent"),
    [
        (FMU2Slave, 1.6),
        (FMU3Slave, 2.0 * math.pi),
        pytest.param(FMU3Slave, 1.6, marks=pytest.mark.long),
        pytest.param(FMU2Slave, 2.0 * math.pi, marks=pytest.mark.long),
    ],
)
@pytest.mark.parametrize(
    ("melting", "tolerance"), [(SharedMelting(), 1e-7), (LocalMelting(), 1e-5)], ids=["shared", "local"]
)
@pytest.mark.parametrize(("speed", "duration", "steps"), [(12.0, 0.02, 10), (400.0, 0.02, 2)])
def test_steps_of_the_profile_follow_an_accurate_solution(
    unzipped, kind, melting, tolerance, speed, duration, steps, extent
):
    """On a rough profile, whose peaks leave the contact within the steps: kinks that end no step."""
    model = worn(melting=melting, extent=extent)
    u = [*model.position([0.0, -LOAD], speed, model.initial_state), 0.0, 0.0, speed]
    client, _ = opened(unzipped, model, kind, u)
    for k in range(steps):
        client.step(k * duration / steps, duration / steps)
    exact, found = accurate(model, u, duration), client.get(*states(model))
    assert np.max(exact - model.initial_state) > 2e-6
    np.testing.assert_allclose(found, exact, rtol=0, atol=tolerance * exact.max())
    assert np.all(found >= model.initial_state)


def test_steps_of_a_smooth_profile_are_accurate(unzipped):
    model = worn(wear_depth=())
    u = [*model.position([0.0, -LOAD], 12.0), 0.0, 0.0, 12.0]
    client, _ = opened(unzipped, model, FMU2Slave, u)
    for k in range(20):
        client.step(k * 1e-4, 1e-4)
    exact = accurate(model, u, 2e-3)
    np.testing.assert_allclose(client.get(*states(model)), exact, rtol=0, atol=1e-9 * exact.max())


@pytest.mark.parametrize("kind", [FMU2Model, FMU3Model])
def test_melting_begins_where_the_event_indicator_changes_its_sign(unzipped, kind):
    client, _ = opened(unzipped, WEAR, kind, (LOAD, 1.0))
    client.pass_event()
    client.fmu.enterContinuousTimeMode()

    def excess(speed):
        client.set(speed=speed)
        return indicators(client, 2)[0]

    assert brentq(excess, 1.0, 10.0, xtol=1e-14) == pytest.approx(ONSET, rel=1e-12)
    client.set(speed=-1.0)
    assert indicators(client, 2)[1] == -1.0
    assert client.get("event_0", "event_1").tolist() == indicators(client, 2).tolist()
    with pytest.raises(Exception, match="failed with status 3"):
        indicators(client, 3)


def test_the_number_of_event_indicators_is_told(unzipped):
    client, _ = opened(unzipped, worn(), FMU3Model, (0.0, 0.0, 0.0, 0.0, 1.0))
    count = (
        client.fmu.getNumberOfEventIndicators() if hasattr(client.fmu, "getNumberOfEventIndicators") else 42
    )
    assert count == 42


def test_parameters_are_those_of_the_model(unzipped):
    friction = Friction(f0=0.12, f1=1e-4, f2=-1e-7)
    changed = replace(
        WEAR, bush=replace(BUSH, friction=friction, outer_mean=200.0, outer_swing=9.0), melting_heat=3e8
    )
    client, _ = opened(unzipped, WEAR, FMU2Model, (LOAD, 9.0))
    client.pass_event()
    client.set(**{p.name: p.value for p in changed.native().parameters})
    client.fmu.enterContinuousTimeMode()
    compare(client, changed, np.array([1e-3]), [LOAD, 20.0])


@pytest.mark.parametrize(
    ("model", "values", "message"),
    [
        (WEAR, {"outer_mean": 249.0}, "outer_swing must be below the melting point 250, got 249 and 4"),
        (WEAR, {"f1": -1e-3}, "friction must be positive up to the melting point, got -0.15"),
        (WEAR, {"f2": 1e-5, "f1": -2.2e-3}, "friction must be positive up to the melting point"),
        (WEAR, {"melting_heat": 0.0}, "melting_heat must be finite and positive, got 0"),
        (WEAR, {"load": -1.0}, "load must be finite and not negative, got -1 N"),
        (worn(), {"temperature": 251.0}, "temperature must not exceed the melting point 250, got 251"),
        (worn(), {"x": 2.1e-3}, "inside the clearance 0.002 m, got an eccentricity of 0.0021 m"),
        (worn(), {"y": 4.9e-4}, "contact must stay on the arc of nodes"),
    ],
)
def test_what_cannot_be_is_an_error_with_values(unzipped, capsys, model, values, message):
    client, _ = opened(unzipped, model, FMU2Slave, np.zeros(len(model.inputs)))

    def set_and_get():
        client.set(**values)
        client.get(names(model)[0])

    with pytest.raises(Exception, match="failed with status 3"):
        set_and_get()
    assert message in capsys.readouterr().out


def test_a_liner_that_is_worn_through_ends_the_run(unzipped, capsys):
    client, _ = opened(unzipped, replace(WEAR, melting_heat=1e6), FMU2Slave, (2e4, 300.0))
    with pytest.raises(Exception, match="failed with status 2"):
        client.step(0.0, 1e5)
    assert "settlement must be below the thickness of the liner 0.0015 m" in capsys.readouterr().out


def test_without_load_and_wear_nothing_touches(unzipped):
    client, _ = opened(unzipped, WEAR, FMU2Slave, (0.0, 50.0))
    np.testing.assert_allclose(client.get(*names(WEAR)), WEAR.output(0.0, [0.0], [0.0, 50.0]), rtol=1e-12)
    with pytest.raises(Exception, match="failed with status 3"):
        client.differentiate(["contact_angle"], ["load"], [1.0])


def test_rules_of_others_have_no_kernel():
    class Mine(GlobalBalance):
        """A balance that the library does not know."""

    bush = replace(BUSH, balance=Mine())
    assert replace(WEAR, bush=bush).native() is None
    assert worn(bush=bush).native() is None
