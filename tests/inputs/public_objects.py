"""One object of every public class that takes a quantity with a unit."""

import dataclasses
from importlib import import_module

import numpy as np

import rotorfilm as rf
from rotorfilm.core import published

PUBLIC = {name: getattr(import_module(package), name) for name, package in published().items()}
"""Everything that users import, by its name."""

BEARING = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
SHORT_GROOVE = rf.Groove(center=1.0, width=0.2, length=0.01)
BUSH = rf.bearings.f4k20_bush()
STEEL = rf.ElasticMaterial(young_modulus=2.06e11, shear_modulus=8e10, density=7850.0)
PIECE = rf.ShaftElement(
    length=0.2,
    outer_diameter=0.05,
    inner_diameter=0.01,
    material=STEEL,
    shear_coefficient=0.9,
    end_outer_diameter=0.04,
    end_inner_diameter=0.01,
    axial_force=10.0,
    torque=2.0,
)
STATIONS = (rf.Station(node=0, name="a"), rf.Station(node=1, name="b"))
SHAFT = rf.ShaftRotor(elements=(PIECE,), speed=100.0, stations=STATIONS, internal_damping=1e-5)
BALL = rf.RollingBall(
    radius=0.01,
    mass=0.033,
    modulus=2.06e11,
    poisson_ratio=0.3,
    viscosity=0.008,
    pressure_coefficient=5e-9,
    speed=0.9,
    load=10.0,
    plane_modulus=2e11,
)
LOBED = rf.LobedBearing(
    radius=0.05, length=0.03, pad_clearance=1e-4, viscosity=0.1, lobes=rf.lobe_set("elliptical")
)
DEEP_GROOVE = rf.BallBearing(
    balls=8,
    ball_diameter=8e-3,
    pitch_diameter=0.034,
    internal_clearance=1e-5,
    growth=1e-6,
    axial_displacement=2e-6,
    axial_load=100.0,
    tilt=(1e-5, 2e-5),
    cage_angle=0.1,
    damping=10.0,
)
ANGULAR_CONTACT = rf.BallBearing(balls=8, ball_diameter=8e-3, pitch_diameter=0.034, contact_angle=0.4)
DAM_PADS = rf.pressure_dam_pads(depth=6e-5, end=2.5, share=0.75, preload=0.2)
FED_DAMPER = rf.DamperSupply(
    supply_pressure=1e5, circumferential_groove=2e-3, cavitation_pressure=-5e4, submerged=True
)
MADE = [
    BEARING,
    rf.JFOFilm(
        bearing=dataclasses.replace(BEARING, film=rf.ReynoldsFilm(), grooves=(SHORT_GROOVE,)),
        supply_flow=2e-6,
        cavitation_pressure=-5e4,
    ),
    rf.JFODamper(radius=0.05, length=0.04, clearance=1e-4, viscosity=0.02, supply=FED_DAMPER, stiffness=1e5),
    FED_DAMPER,
    rf.Lobe(start=0.1, extent=1.0, preload=0.3, offset=0.6),
    LOBED,
    DAM_PADS[0],
    DAM_PADS[0].recess,
    rf.PressureDamBearing(radius=0.05, length=0.04, pad_clearance=1e-4, viscosity=0.03, pads=DAM_PADS),
    rf.TiltingPadBearing(
        radius=0.05,
        length=0.04,
        viscosity=0.03,
        pivots=rf.even_pivots(4),
        extent=1.2,
        preload=0.3,
        pad_clearance=1e-4,
        pivot_stiffness=1e9,
        pad_inertia=1e-3,
        pivot_distance=0.01,
        pad_mass=0.5,
    ),
    dataclasses.replace(
        BEARING,
        film=rf.ReynoldsFilm(),
        grooves=(rf.Groove(center=0.0, width=0.2),),
        supply_pressure=1e5,
    ),
    SHORT_GROOVE,
    rf.FeedHole(center=1.0, diameter=0.004),
    rf.bearings.FixedOnset(line=0.5),
    rf.Pad(start=1.0, extent=0.5),
    rf.bearings.FixedArc(start=0.1, extent=3.0),
    rf.bearings.ReynoldsArc(start=0.1),
    rf.bearings.SlitArc(slit=0.1, extent=3.0),
    rf.Measurements(speed=[100.0, 200.0], load=[0.0, -500.0], values={"x": [4e-5, 5e-5]}),
    rf.LinearBearing(stiffness=1e6, damping=100.0),
    rf.LinearBearing(stiffness=((1e6, 2.0), (3.0, 1e6)), damping=100.0),
    rf.LinearBearing(stiffness=(2e8, 5e4, 5e4), damping=(1e4, 1.0, 1.0), freedoms=("z", "tilt_x", "tilt_y")),
    rf.TabulatedBearing(speeds=[1.0, 2.0], stiffness=np.ones((2, 2, 2)), damping=np.ones((2, 2, 2))),
    rf.EndSeal(leakage=1e-10, uncertainty=0.3),
    rf.bearings.FilmSegment(length=0.02, clearance=1e-4),
    rf.bearings.SegmentedDamper(
        radius=0.05,
        segments=(rf.bearings.FilmSegment(length=0.02, clearance=1e-4),),
        viscosity=4e-4,
        density=850.0,
    ),
    rf.SqueezeFilmDamper(radius=0.05, length=0.02, clearance=1e-4, viscosity=4e-4, density=850.0),
    rf.PorousDamper(
        radius=0.05,
        length=0.02,
        clearance=1e-4,
        viscosity=4e-4,
        cage=rf.PorousCage(thickness=2.5e-3, permeability=4e-13),
    ),
    rf.with_springs(rf.LinearBearing(stiffness=1e6, damping=1.0), 2e6),
    rf.bearings.Body(mass=2.0, inertia=0.01),
    rf.FrequencyDependentReaction(
        A=np.full((2, 1, 1), -300.0),
        B=np.ones((2, 1, 2)),
        C=np.ones((2, 2, 1)),
        D=np.zeros((2, 2, 2)),
        speeds=[100.0, 200.0],
        damping=np.eye(2),
        added_mass=np.eye(2),
        band=(1.0, 500.0),
    ),
    rf.RubRing(
        gap=2e-4,
        stiffness=1e7,
        radius=0.05,
        friction_coefficient=0.1,
        dissipation=0.2,
        ring_center=(1e-5, 2e-5),
    ),
    rf.rotors.GaschHinge(edge=0.2),
    rf.rotors.JeffcottCrack(reduction=0.1, cross_reduction=0.02, crack_angle=0.3),
    rf.rotors.ShaftCrack(element=0, depth=1e-3, crack_angle=0.3),
    rf.CrackedRotor(
        rotor=rf.JeffcottRotor(mass=5.0, journal_mass=1.0, stiffness=1e6, speed=100.0),
        crack=rf.rotors.JeffcottCrack(reduction=0.1),
        opening_angle=0.3,
    ),
    rf.bearings.HirsFriction(coefficient=0.079, exponent=-0.25),
    rf.AnnularSeal(
        radius=0.05,
        length=0.02,
        clearance=2e-4,
        pressure_drop=1e6,
        viscosity=1e-3,
        density=1000.0,
        inlet_loss=0.2,
    ),
    rf.PorousCage(thickness=2.5e-3, permeability=4e-13, anisotropy=2.0, vented=True, supply_pressure=1e5),
    rf.RadialFeed(inflow=1e-4),
    rf.bearings.AxialFeed(start_pressure=1e5, end_pressure=2e5),
    BALL,
    BUSH,
    BUSH.geometry,
    BUSH.liner,
    BUSH.shaft,
    BUSH.friction,
    rf.BushWear(bush=BUSH, melting_heat=3e8, wear=0.0),
    rf.BushReaction(bush=BUSH, melting_heat=3e8, temperature=200.0),
    rf.BushReaction(bush=BUSH, melting_heat=3e8, nodes=8, wear_depth=(1e-6,) * 8, retardation=1e-3),
    rf.RigidRotor(mass=10.0, speed=100.0, unbalance=1e-4, unbalance_angle=0.5),
    rf.JeffcottRotor(mass=10.0, journal_mass=1.0, stiffness=1e6, speed=100.0, unbalance=1e-4),
    rf.RigidShaft(
        mass=10.0, diametral_inertia=0.2, polar_inertia=0.1, stations=(("a", -0.1), ("b", 0.1)), speed=9.0
    ),
    rf.SpeedProfile(times=(0.0, 1.0), speeds=(100.0, 200.0)),
    rf.rotors.LinearMotor(stall_torque=2.0, idle_speed=300.0, resistance=1e-3),
    rf.MotorDrivenRotor(
        rotor=rf.RigidRotor(mass=10.0, speed=100.0),
        inertia=0.1,
        torque=rf.rotors.LinearMotor(stall_torque=2.0, idle_speed=300.0),
    ),
    rf.BaseMotion(times=(0.0, 1.0), acceleration_x=(1.0, -1.0), acceleration_y=(0.5, 2.0)),
    rf.BaseExcitedRotor(rotor=rf.RigidRotor(mass=10.0, speed=100.0), base=rf.BaseMotion(times=(0.0, 1.0))),
    rf.rotors.ForcedRotor(rotor=SHAFT, times=(0.0, 1.0), forces={0: ((1.0, 2.0), (0.0, 3.0))}),
    STEEL,
    PIECE,
    rf.Coupling(stiffness=1e6, tilt_stiffness=1e3),
    rf.Disk(node=0, mass=1.0, diametral_inertia=0.01, polar_inertia=0.02),
    rf.rotors.Support(mass=5.0, stiffness=1e7, damping=10.0),
    rf.rotors.TiltSpring(node=0, stiffness=1e4, damping=10.0),
    rf.Probe(node=0, name="p", angle=0.3),
    rf.Unbalance(node=0, unbalance=1e-4, unbalance_angle=0.5),
    SHAFT,
    rf.rotors.ReducedRotor(rotor=SHAFT, modes=2, speed=100.0, gravity=SHAFT.gravity),
    rf.rotors.ModallyDampedRotor(
        rotor=SHAFT, damping_ratios=(0.01,), speed=100.0, gravity=SHAFT.gravity, bearing_stiffness=1e7
    ),
    rf.analysis.Impeller(power=2e5, diameter=0.4, width=0.012, suction_density=5.0, discharge_density=8.0),
    rf.analysis.AxialStage(power=5e5, diameter=0.6, height=0.08),
    rf.rotors.SkewedCollar(
        rotor=rf.RigidShaft(
            mass=10.0,
            diametral_inertia=0.1,
            polar_inertia=0.2,
            stations=(("", 0.0),),
            speed=100.0,
            feels_tilt=True,
        ),
        station="",
        skew=1e-4,
        skew_angle=0.3,
    ),
    rf.analysis.AxialSpring(node=0, stiffness=1e8, damping=1e4),
    rf.analysis.TorsionalSpring(node=0, stiffness=1e5, damping=10.0),
    rf.OperatingPoint(t=1.0, x=(), u=(0.0,) * 5),
    rf.RollingMaterial.steel(),
    rf.bearings.EllipticContact(rolling_radius=3e-3, groove_radius=0.05, combined_modulus=2.2e11),
    rf.bearings.RaceFilm(
        touch=rf.bearings.EllipticContact(rolling_radius=3e-3, groove_radius=0.05, combined_modulus=2.2e11),
        load=100.0,
        rolling_speed=5.0,
        viscosity=0.02,
        pressure_coefficient=2e-8,
    ),
    DEEP_GROOVE,
    ANGULAR_CONTACT,
    rf.back_to_back(ANGULAR_CONTACT, distance=0.02, preload=100.0),
    rf.MomentCarryingBalls(bearing=ANGULAR_CONTACT),
    rf.MomentCarryingBalls(bearing=ANGULAR_CONTACT, freedoms=rf.bearings.rolling.BALL_FREEDOMS),
    rf.bearings.MomentCarryingJournal(
        bearing=dataclasses.replace(BEARING, film=rf.ReynoldsFilm(cells=(16, 4)))
    ),
    rf.bearings.MomentCarryingJournal(bearing=BEARING, level=rf.bearings.TiltLevel.CLOSED_FORM),
    rf.bearings.HeldTilt(
        journal=rf.bearings.MomentCarryingJournal(bearing=BEARING, level=rf.bearings.TiltLevel.CLOSED_FORM),
        tilt=(1e-4, 2e-4),
    ),
    rf.ThrustBearing(
        inner_radius=0.025,
        outer_radius=0.05,
        pads=8,
        pad_arc=0.7,
        viscosity=0.02,
        taper_depth=3e-5,
        step_depth=1e-5,
        crown=5e-6,
        gap=4e-5,
        start=0.1,
    ),
    rf.bearings.TiltingThrustBearing(
        inner_radius=0.025,
        outer_radius=0.05,
        pads=8,
        pad_arc=0.7,
        viscosity=0.02,
        crown=5e-6,
        gap=4e-5,
        start=0.1,
    ),
    rf.VariableComplianceBalls(bearing=ANGULAR_CONTACT, cage_ratio=0.4),
    rf.bearings.PalmgrenBalls(balls=8, ball_diameter=8e-3, contact_angle=0.1, damping=10.0),
    rf.bearings.Waviness(inner=True, lobes=9, radial_amplitude=1e-7, axial_amplitude=2e-8, phase=0.3),
    rf.BearingPair(
        bearing=ANGULAR_CONTACT,
        distance=0.02,
        directions=(-1, 1),
        spacer_offset=1e-6,
        axial_displacement=1e-7,
        axial_load=50.0,
        tilt=(1e-5, 2e-5),
        damping=10.0,
    ),
    rf.Oil.iso_vg(46),
    rf.Cooling(supply_temperature=310.0, housing_conductance=3.0),
    rf.bearings.BushRing(outer_radius=0.1),
    rf.bearings.HeldWalls(bush_temperature=310.0, journal_temperature=320.0),
]
"""Of every public class that takes a quantity with a unit, one with all of them where that is possible."""
