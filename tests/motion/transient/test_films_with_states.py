"""Every bearing with states of its own under a rigid, a Jeffcott and a flexible rotor: all analyses agree.

The reference is the state space of `mount(rotor, bearings)`: its rest by Newton's method, its eigenvalues,
its response to unbalance and its matrix exponential.
"""

from dataclasses import replace
from itertools import product

import fmpy
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import block_diag, expm

from rotorfilm import (
    BallBearing,
    BallSupport,
    BushReaction,
    ClassicalBeam,
    ContactLaw,
    Cooling,
    Disk,
    ElasticMaterial,
    FrequencyDependentReaction,
    InputError,
    JeffcottRotor,
    JournalBearing,
    LinearBearing,
    LobedBearing,
    Oil,
    RigidRotor,
    ShaftElement,
    ShaftRotor,
    Station,
    TiltingPadBearing,
    Unbalance,
    VariableComplianceBalls,
    base_response,
    base_system,
    closed_loop,
    coefficients,
    equilibrium,
    even_pivots,
    export_fmu,
    lobe_set,
    mount,
    periodic_orbit,
    rotor_equilibrium,
    rotor_system,
    rotor_threshold,
    simulate,
    transmissibility,
    unbalance_response,
    whirl_threshold,
)
from rotorfilm.bearings import Body, PadMapFilm, PadResolution, Parallel, Series, f4k20_bush
from rotorfilm.core import names
from rotorfilm.core.dynamic_stiffness import rest_linearization, rest_state, states_rest
from rotorfilm.core.port import inertial, mass_of, rest_temperature
from rotorfilm.rotors import translations

SPEED = 300.0
STEEL = ElasticMaterial(density=7850.0, young_modulus=2.1e11, shear_modulus=8.1e10)
OIL = {"oil": Oil.iso_vg(32), "cooling": Cooling(supply_temperature=313.15, bush_heat_capacity=200.0)}
SIZE = {"radius": 0.05, "length": 0.05}
PADS = PadMapFilm(resolution=PadResolution(cells=(32, 4), nodes=(8, 9, 24)))
LIGHT = TiltingPadBearing(
    **SIZE,
    viscosity=0.02,
    pivots=even_pivots(5),
    extent=np.pi / 3.0,
    preload=0.3,
    pad_clearance=1e-4,
    film=PADS,
)
DAMPED = {
    "A": np.diag([-1.0, -4.0]),
    "B": np.ones((2, 1)),
    "C": np.array([[0.3, 2.0]]),
    "D": np.array([[-0.8]]),
}
LAW = ContactLaw(
    offset=0.3, span=2.1, exponent=1.5, operating=-1.8, **DAMPED, static_error=0.0, damping_error=0.0,
    film_scale=1e-6, time_scale=1e-4, force_scale=200.0,
)  # fmt: skip
SEAL = FrequencyDependentReaction(
    A=[[-400.0, 150.0, 0.0], [-90.0, -700.0, 40.0], [0.0, 0.0, -2000.0]],
    B=[[1.0, 0.5], [-0.4, 1.0], [0.3, 0.2]],
    C=[[2e9, -1e9, 4e8], [1e9, 3e9, 0.0]],
    D=[[-3e7, 4e6], [-5e6, -2.5e7]],
    damping=[[3e3, 0.0], [200.0, 4e3]],
)
EIGHT = tuple(np.pi / 4.0 * np.arange(8))

FILMS = {
    "tilting pads": LIGHT,
    "pads with inertia": replace(LIGHT, pad_inertia=2e-4, pivot_distance=0.01),
    "pads on springs": replace(LIGHT, pivot_stiffness=2e8),
    "warm journal": JournalBearing(**SIZE, clearance=1e-4, **OIL),
    "warm lobes": LobedBearing(
        **SIZE, pad_clearance=1e-4, lobes=lobe_set("three_lobe", preload=0.3), film=PADS, **OIL
    ),
    "lubricated balls": BallSupport(law=LAW, angles=EIGHT, gap=float(LAW.approach(120.0))),
    "turning balls": VariableComplianceBalls(
        bearing=BallBearing(
            balls=9, ball_diameter=8e-3, pitch_diameter=33e-3, contact_angle=0.35, axial_load=300.0
        )
    ),
    "worn bush": BushReaction(bush=f4k20_bush(), melting_heat=1e8, nodes=16, extent=1.4, retardation=2e-4),
    "frequency-dependent seal": SEAL,
    "seal with mass": replace(SEAL, added_mass=[[8.0, 1.0], [1.0, 5.0]]),
    "bearing in a support": Series(
        LinearBearing(stiffness=((3e7, 2e6), (0.0, 5e7)), damping=4e3),
        Body(3.0),
        JournalBearing(**SIZE, clearance=1e-4, viscosity=0.02),
    ),
    "pads in a support with memory": Series(
        replace(SEAL, added_mass=[[2.0, 0.0], [0.0, 1.0]]), Body(3.0), LIGHT
    ),
    "journal beside a seal": Parallel((JournalBearing(**SIZE, clearance=1e-4, viscosity=0.02), SEAL)),
    "pads beside a seal": Parallel((LIGHT, replace(SEAL, damping=[[90.0, 0.0], [0.0, 50.0]]))),
}
"""All kinds of bearings with states."""

IN_CONTACT, PUSH, DURATION, LINEAR = -4.55e-4, 1e-5, 1e-3, 3e-3
"""Place of a shaft on its bush [m], push in nominal velocities, time [s], and what is linear in it."""

WARMING, END = 1e-3, 1e-4
"""What the temperature of a film changes in an orbit, relative, and duration of an FMU [s]."""

NO_REST = {"turning balls", "worn bush"}
"""Whose states never rest: balls go round, and wear goes on."""

ROTORS = "rigid", "Jeffcott", "flexible"


def placed(kind, shape, unbalance=0.0, speed=SPEED):
    """Return a rotor and its bearings by station, under some 500 N each."""
    mass = 10.0 if kind in {"turning balls", "worn bush", "lubricated balls"} else 50.0
    if shape == "rigid":
        return RigidRotor(mass=mass, speed=speed, unbalance=unbalance), {"": FILMS[kind]}
    if shape == "Jeffcott":
        parts = {"mass": 0.8 * mass, "journal_mass": 0.2 * mass, "stiffness": 1e7, "internal_damping": 500.0}
        return JeffcottRotor(**parts, speed=speed, unbalance=unbalance), {"": FILMS[kind]}
    rotor = ShaftRotor(
        elements=ShaftElement(length=0.3, outer_diameter=0.06, material=STEEL).split(2),
        disks=(Disk(node=1, mass=2.0 * mass - 6.66, polar_inertia=0.05, diametral_inertia=0.03),),
        stations=(Station(name="left", node=0), Station(name="right", node=2)),
        unbalances=(Unbalance(node=1, unbalance=2.0 * unbalance),),
        beam=ClassicalBeam(),
        internal_damping=1e-5,
        speed=speed,
    )
    return rotor, {"left": FILMS[kind], "right": FILMS[kind]}


def rest_of(rotor, films, speed=SPEED):
    """Return what the analyses say of the rest: coordinates of the rotor."""
    if isinstance(rotor, RigidRotor):
        return equilibrium(films[""], rotor.static_load, speed).position
    return rotor_equilibrium(rotor, films, speed).displacement


def settled(mounted, start, size):
    """Return the place at which the first states do not move, by Newton's method from a state."""
    x, scale = np.array(start), scales(mounted)[:size]
    for _ in range(20):
        rate = mounted.derivative(0.0, x, ())[:size]
        change = np.linalg.solve(mounted.linearization(0.0, x, ()).A[:size, :size], rate)
        x[:size] -= change
        if np.all(np.abs(change) <= 1e-11 * scale):
            return x
    raise AssertionError(f"no rest: {change / scale}")


def scales(mounted):
    return np.array([signal.nominal for signal in mounted.states])


def resting(kind, shape, unbalance=0.0, speed=SPEED):
    """Return rotor, films, the mounted rotor and its state at rest."""
    rotor, films = placed(kind, shape, unbalance, speed)
    mounted, size = mount(rotor, films), len(rotor.states)
    x = mounted.initial_state
    if kind == "worn bush":  # which no analysis puts against its arc
        down = [k for k, signal in enumerate(rotor.states[: size // 2]) if "y" in signal.name.split("_")]
        x[[k for k in down if "tilt" not in rotor.states[k].name]] = IN_CONTACT
    else:
        x[: size // 2] = rest_of(rotor, films, speed)
        if all(map(states_rest, films.values())):
            at = dict(zip(names(rotor.outputs), rotor.output(0.0, x[:size], ()), strict=True))
            places = [[at[f"{name}_{axis}" if name else axis] for axis in "xy"] for name in films]
            states = [
                rest_state(film, place, speed) for film, place in zip(films.values(), places, strict=True)
            ]
            x[size:] = np.concatenate(states)
    return rotor, films, mounted, settled(mounted, x, size if kind in NO_REST else len(x))


def cells(*slow, without=frozenset()):
    """Return a decorator over all kinds of films but some, and all rotors; slow pairs are for long runs."""
    pairs = [
        pytest.param(*pair, marks=[pytest.mark.long] * (pair in slow or pair[1] in slow))
        for pair in product(FILMS, ROTORS)
        if pair[0] not in without
    ]
    return pytest.mark.parametrize(("kind", "shape"), pairs)


@cells(without={"worn bush"})
def test_the_rest_is_that_of_the_state_space(kind, shape):
    rotor, films, _, x = resting(kind, shape)
    found = rest_of(rotor, films)
    assert x[: len(found)] == pytest.approx(found, abs=1e-9 * 1e-4)


def leading(kind, shape, speed):
    """Return the largest growth of a whirl in the state space [1/s]."""
    *_, mounted, x = resting(kind, shape, speed=speed)
    values = np.linalg.eigvals(mounted.linearization(0.0, x, ()).A)
    return values[np.abs(values.imag) > 1.0].real.max()


@cells(("warm lobes", "flexible"), ("bearing in a support", "flexible"), without=NO_REST)
def test_the_threshold_is_that_of_the_state_space(kind, shape):
    rotor, films = placed(kind, shape)
    if shape == "rigid" and kind == "seal with mass":
        with pytest.raises(InputError, match="reaction must not add the mass of its oil to the rotor"):
            whirl_threshold(films[""], rotor.static_load, rotor.mass, (200.0, 1500.0))
        return
    if shape == "rigid":
        found = whirl_threshold(films[""], rotor.static_load, rotor.mass, (200.0, 1500.0))
    else:
        found = rotor_threshold(rotor, films, np.linspace(200.0, 1500.0, 4))
    if found.speed is None:
        assert found.reason.startswith("stable at every speed")
        assert max(leading(kind, shape, speed) for speed in (200.0, 1500.0)) < 0.0
    else:
        # In vibration the film keeps its temperature, whose states would move the threshold a little.
        below, above = (leading(kind, shape, share * found.speed) for share in (0.995, 1.005))
        assert below < 0.0 < above


def exact(mounted, start, push, times):
    """Return the states at some times by another method: about a rest the matrix exponential."""
    A = mounted.linearization(0.0, start, ()).A
    if np.abs(mounted.derivative(0.0, start, ()) / scales(mounted)).max() < 1e-6:
        return np.array([start + expm(t * A) @ push for t in times])
    found = solve_ivp(
        lambda t, x: mounted.derivative(t, x, ()),
        (0.0, times[-1]),
        start + push,
        method="DOP853",
        t_eval=times,
        rtol=1e-8,
        atol=1e-10 * scales(mounted),
    )
    return found.y.T


@cells(("warm lobes", "flexible"), ("worn bush", "flexible"), ("pads in a support with memory", "flexible"))
def test_a_transient_is_that_of_the_state_space(kind, shape):
    """After a push so small that motion about a rest stays linear."""
    _, films, mounted, x = resting(kind, shape)
    rotor, half = mounted.rotor, len(mounted.rotor.states) // 2
    push = np.zeros(len(x))
    push[half : 2 * half] = PUSH * scales(mounted)[half : 2 * half]
    run = simulate(rotor, films, duration=DURATION, samples=5, initial_state=x + push, rtol=1e-8)
    states = exact(mounted, x, push, run.time)
    outputs = [mounted.output(0.0, z, ()) for z in states]
    known = {signal.name: row for signal, row in zip(mounted.outputs, np.transpose(outputs), strict=True)}
    known |= {
        signal.name: row
        for signal, row in zip(mounted.states, states.T, strict=True)
        if signal.name in run.signals
    }
    assert set(known) == set(run.signals)
    for name, row in known.items():
        size = np.abs(row - row[0]).max()
        assert run[name] == pytest.approx(row, abs=LINEAR * size + 1e-9 * np.abs(row).max()), name


@cells(
    "Jeffcott",
    ("warm lobes", "flexible"),
    ("warm journal", "flexible"),
    ("pads in a support with memory", "flexible"),
    without=NO_REST,
)
def test_a_small_orbit_is_that_of_the_state_space(kind, shape):
    rotor, films, mounted, x = resting(kind, shape)
    turning, _ = placed(kind, shape, unbalance=1e-6)
    A, C = (getattr(mounted.linearization(0.0, x, ()), name) for name in "AC")
    quarter = 0.5 * np.pi / SPEED
    push = mount(turning, films).derivative(0.0, x, ()) - 1j * mount(turning, films).derivative(
        quarter, x, ()
    )
    exact = C @ np.linalg.solve(1j * SPEED * np.eye(len(A)) - A, push)
    names, tolerance = (
        [signal.name for signal in mounted.outputs],
        WARMING if kind.startswith("warm") else 1e-8,
    )
    if shape == "rigid":
        at = coefficients(films[""], x[:2], SPEED)
        dynamic = at.stiffness + 1j * SPEED * at.damping - SPEED**2 * rotor.mass * np.eye(2)
        found = np.linalg.solve(dynamic, turning.unbalance * SPEED**2 * np.array([1.0, -1j]))
        assert found == pytest.approx(exact[:2], rel=tolerance)
    else:
        response = unbalance_response(turning, films, [SPEED])
        rows = [names.index(label) for label in response.output_labels if label in names]
        found = response.frdata[[k for k, label in enumerate(response.output_labels) if label in names], 0, 0]
        size = np.abs(exact[rows])
        assert np.abs(found - exact[rows]) == pytest.approx(0.0, abs=tolerance * size.max())
    if any(inertial(film) for film in films.values()):
        with pytest.raises(InputError, match="must have no added mass on a periodic orbit"):
            periodic_orbit(mount(turning, films))
        return
    orbit = periodic_orbit(mount(turning, films), stability=False)
    wave = orbit.series[:, :, 1] - 1j * orbit.series[:, :, orbit.harmonics + 1]
    own = [f"{name}_{axis}" if name else axis for name in orbit.stations for axis in "xy"]
    linear = exact[[names.index(name) for name in own]]
    assert np.abs(wave.ravel() - linear) == pytest.approx(0.0, abs=LINEAR * np.abs(linear).max())


def thrown(mounted, size):
    """Return the rates of the states per acceleration of the ground, which added masses in bearings share."""
    rotor, found = mounted.rotor, np.zeros((size, 2))
    own, still = len(rotor.states), np.zeros(5)
    found[own // 2 : own] = -translations(rotor)
    at = rotor.linearization(0.0, np.zeros(own), np.zeros(len(rotor.inputs)))
    mass = block_diag(*(mass_of(m.reaction, still[:2], still[:2], 0.0) for m in mounted.mounts))
    push = at.B[:, [k for m in mounted.mounts for k in m.force]]
    felt = mass @ at.C[[k for m in mounted.mounts for k in m.motion[2:4]]]
    found[:own] -= push @ np.linalg.solve(np.eye(len(mass)) + felt @ push, felt @ found[:own])
    return found


@pytest.mark.parametrize("kind", ["tilting pads", "pads with inertia", "pads on springs", "lubricated balls"])
@pytest.mark.parametrize("shape", ["Jeffcott", "flexible"])
def test_the_ground_is_felt_at_its_own_frequency(kind, shape):
    """K(s) of the films is that at the frequency of the ground, not at that of the shaft."""
    rotor, films, mounted, x = resting(kind, shape)
    A, C = (getattr(mounted.linearization(0.0, x, ()), name) for name in "AC")
    pushed = thrown(mounted, len(x))
    response = base_response(rotor, rotor_equilibrium(rotor, films, SPEED), [90.0, 1500.0])
    names = [signal.name for signal in mounted.outputs]
    rows = [names.index(label) for label in response.output_labels if label in names]
    places = [k for k, label in enumerate(response.output_labels) if label in names]
    for k, frequency in enumerate((90.0, 1500.0)):
        wanted = C[rows] @ np.linalg.solve(1j * frequency * np.eye(len(A)) - A, pushed)
        assert response.frdata[places, :, k] == pytest.approx(
            wanted, rel=1e-6, abs=1e-9 * np.abs(wanted).max()
        )


@pytest.mark.parametrize("kind", [kind for kind in FILMS if kind not in NO_REST])
@pytest.mark.parametrize("shape", ["Jeffcott", "flexible"])
def test_python_control_has_the_state_space(kind, shape):
    """Also where a bearing has K(s), and not K and C of one frequency; a film keeps its temperature."""
    rotor, films, mounted, x = resting(kind, shape)
    A, _, C, _ = mounted.linearization(0.0, x, ())
    kept = len(rotor.states) if kind.startswith("warm") else len(A)
    A, C = A[:kept, :kept], C[:, :kept]
    at = rotor_equilibrium(rotor, films, SPEED)
    system = base_system(rotor, at)
    assert np.sort_complex(rotor_system(rotor, at).poles()) == pytest.approx(
        np.sort_complex(np.linalg.eigvals(A)), rel=1e-6
    )
    pushed = thrown(mounted, kept)
    seen = {signal.name: row for signal, row in zip(mounted.outputs, C, strict=True)}
    labels = system.output_labels
    wanted = [seen[n] if n in seen else -seen[n.replace("housing_", "")] for n in labels]
    # The force of an added mass follows the ground at once, which rows over the states do not tell.
    told = [k for k, n in enumerate(labels) if n in seen or kind != "seal with mass"]
    for frequency in (0.0, 90.0, 1500.0):
        response = np.array(wanted) @ np.linalg.solve(1j * frequency * np.eye(kept) - A, pushed)
        assert system(1j * frequency)[told] == pytest.approx(
            response[told], rel=1e-6, abs=1e-9 * np.abs(response).max()
        )


@cells("Jeffcott", "flexible")
def test_an_fmu_of_both_has_the_motion_of_the_model(kind, shape, tmp_path):
    _, films, mounted, _ = resting(kind, shape)
    path = export_fmu(mounted, tmp_path / "both.fmu", "2.0", stop_time=END)
    told = fmpy.simulate_fmu(str(path), stop_time=END, output_interval=END, step_size=END)
    run = simulate(mounted.rotor, films, duration=END, samples=2)
    for name in (signal.name for signal in mounted.rotor.outputs):
        last, size = run[name][-1], np.abs(run[name]).max()
        assert told[f"mounted_rotor.{name}"][-1] == pytest.approx(
            last, rel=1e-3, abs=1e-9 * max(size, 1e-4)
        ), name


@pytest.mark.parametrize("kind", [kind for kind in FILMS if kind not in NO_REST])
def test_the_closed_loop_is_the_state_space(kind):
    """Its poles are the eigenvalues of the mounted rotor; a film keeps its temperature."""
    rotor, films, mounted, x = resting(kind, "rigid")
    rest = equilibrium(films[""], rotor.static_load, SPEED)
    poles = np.linalg.eigvals(closed_loop(rotor, films[""], rest).A)
    A = mounted.linearization(0.0, x, ()).A
    wanted = np.linalg.eigvals(A[:4, :4] if kind.startswith("warm") else A)
    assert np.sort_complex(poles) == pytest.approx(np.sort_complex(wanted), rel=1e-6)
    gain = transmissibility(rotor, films[""], rotor.static_load, [SPEED]).frdata[:, :, 0]
    at = coefficients(films[""], rest.position, SPEED)
    dynamic = at.stiffness + 1j * SPEED * at.damping
    wanted = dynamic @ np.linalg.inv(dynamic - SPEED**2 * rotor.mass * np.eye(2))
    assert gain == pytest.approx(wanted, rel=1e-6, abs=1e-9)


def test_a_closed_loop_holds_the_cage_that_turns_where_it_starts():
    rotor, films, *_ = resting("turning balls", "rigid")
    rest = equilibrium(films[""], rotor.static_load, SPEED)
    poles = closed_loop(rotor, films[""], rest).poles()
    held = closed_loop(rotor, films[""].bearing, rest).poles()
    np.testing.assert_allclose(np.sort(poles[np.abs(poles) > 0.0]), np.sort(held), rtol=1e-9)
    assert np.sum(poles == 0.0) == 2  # of the angles of cage and shaft


def test_a_flexible_rotor_asks_for_its_films_by_station():
    rotor, films = placed("tilting pads", "flexible")
    with pytest.raises(InputError, match=r"mapping with a film for each of the stations \['left', 'right'\]"):
        simulate(rotor, films["left"], duration=1e-3)


@pytest.mark.filterwarnings("ignore:.*:rotorfilm.core.errors.ValidityWarning")
@pytest.mark.parametrize("kind", sorted(FILMS))
def test_transmissibility_is_the_algebra_of_the_dynamic_stiffness(kind):
    """What reaches the housing is Z (Z + m s^2)^-1, the states eliminated by hand."""
    rotor, films = placed(kind, "rigid")
    film, load, s = films[""], rotor.static_load, 1j * SPEED
    found = transmissibility(rotor, film, load, [SPEED]).frdata[:, :, 0]
    at = equilibrium(film, load, SPEED)
    # The temperature of a film is held, the wear of a bush follows the journal.
    temperature = rest_temperature(film, at.position, SPEED)
    held = film if temperature is None else film.at_temperature(temperature)
    A, B, C, D = rest_linearization(held, at.position, SPEED)
    moved = np.linalg.solve(s * np.eye(len(A)) - A, B[:, :2] + s * B[:, 2:4]) if len(A) else np.zeros((0, 2))
    Z = -(D[:, :2] + s * D[:, 2:4] + C @ moved) + s**2 * mass_of(held, at.position, np.zeros(2), SPEED)
    np.testing.assert_allclose(
        found, Z @ np.linalg.inv(Z + rotor.mass * s**2 * np.eye(2)), rtol=1e-9, atol=1e-12
    )
