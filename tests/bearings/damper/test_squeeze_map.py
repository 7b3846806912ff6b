"""Cavitated squeeze films as maps: against the law they tabulate, the journal's map, and the short limit."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from numpy.testing import assert_allclose

from rotorfilm import (
    ConvergenceError,
    FiniteMapSqueeze,
    FiniteSqueeze,
    FullFilm,
    InputError,
    JournalBearing,
    MapFilm,
    PorousCage,
    PorousDamper,
    RadialFeed,
    RigidRotor,
    ShortSqueeze,
    UndefinedDerivativeError,
    ValidityWarning,
    synchronous_orbits,
    with_springs,
)
from rotorfilm.bearings import HalfSommerfeld, MapSqueeze, layer_modes
from rotorfilm.bearings.damper import squeeze_map as squeeze_potential, squeeze_map as squeeze_table
from rotorfilm.bearings.damper.squeeze_films import PorousLayer, short_squeeze_film
from rotorfilm.bearings.damper.squeeze_map import CavitatedPotential

LAYER = PorousLayer(
    permeability_number=0.01, grading=0.5, thickness_ratio=0.1, anisotropy=1.0, vented=False, thin=False
)
CAGE = PorousCage(thickness=2.5e-3, permeability=4e-13, grading=0.1)
SHORT = PorousDamper(radius=0.05, length=0.025, clearance=1e-4, viscosity=0.01, cage=CAGE)
MAPPED = replace(SHORT, film=MapSqueeze())
COARSE = FiniteMapSqueeze(cells=(8, 16))


@pytest.fixture(scope="module", autouse=True)
def kept(tmp_path_factory):
    """Return the folder of the maps of this module."""
    folder = tmp_path_factory.mktemp("maps")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROTORFILM_CACHE", str(folder))
        yield folder


@pytest.fixture
def finite(kept):
    """Return a damper of finite length on a coarse map."""
    return replace(SHORT, film=COARSE)


def states(count, largest):
    rng = np.random.default_rng(3)
    chi, phi = rng.uniform(0.0, largest, count), rng.uniform(-np.pi, np.pi, count)
    return 1e-4 * chi * np.stack([np.cos(phi), np.sin(phi)]), rng.normal(size=(2, count))


@pytest.mark.parametrize("cage", [None, CAGE, replace(CAGE, permeability=1e-11, vented=True)], ids=str)
def test_map_of_a_short_film_is_the_short_film(cage):
    q, v = states(400, 0.985)
    law, film = replace(MAPPED, cage=cage), replace(SHORT, cage=cage)
    expected = film.force(q, v)
    errors = np.linalg.norm(law.force(q, v) - expected, axis=0) / np.linalg.norm(expected, axis=0)
    assert np.quantile(errors, 0.99) < 2e-5
    q, v = states(50, 0.9)
    slopes = film.jacobian(q, v)
    apart = np.abs(law.jacobian(q, v) - slopes)
    for block in (slice(0, 2), slice(2, 4)):
        scale = np.abs(slopes[:, block]).max(axis=(0, 1))
        assert np.all(apart[:, block].max(axis=(0, 1)) < 5e-5 * scale)


def test_prepared_map_runs_in_c_whatever_the_speed():
    q, v = [3e-5, -2e-5], [0.01, 0.03]
    assert_allclose(MAPPED.prepare()(*q, *v, 500.0), MAPPED.force(q, v), rtol=1e-12)


@pytest.mark.closed_form
@pytest.mark.parametrize(("slenderness", "tolerance"), [(0.25, 1e-4), (0.5, 1.5e-4), (1.0, 3e-4)])
def test_solid_potential_is_that_of_the_journals_map(slenderness, tolerance):
    # Free boundaries curved over the length, elliptic trial functions: nothing in common but the equation.
    potential, journal = CavitatedPotential(slenderness, None), MapFilm()
    for eps in (0.0, 0.5, 0.9):
        for heading in (0.0, 0.8, 1.6, 3.1):
            w = np.array([np.cos(heading), np.sin(heading)])
            expected = 0.5 * journal.force(np.array([eps, 0.0]), w, slenderness) @ w / (4.0 * slenderness**2)
            assert potential(eps, heading) == pytest.approx(expected, rel=tolerance)


@pytest.mark.parametrize("cage", [None, CAGE, replace(CAGE, permeability=1e-11, vented=True)], ids=str)
@pytest.mark.parametrize(
    "laws", [(ShortSqueeze(), MapSqueeze()), (FiniteSqueeze(), FiniteMapSqueeze())], ids=str
)
def test_map_of_a_full_film_is_the_film(laws, cage):
    # The film by another code: closed forms, or harmonics around the circumference.
    film, law = (replace(SHORT, cage=cage, extent=FullFilm(), film=each) for each in laws)
    q, v = states(15, 0.98)
    expected = film.force(q, v)
    errors = np.linalg.norm(law.force(q, v) - expected, axis=0) / np.linalg.norm(expected, axis=0)
    assert errors.max() < 3e-5
    slopes = film.jacobian(q, v)
    apart = np.abs(law.jacobian(q, v) - slopes)
    for block in (slice(0, 2), slice(2, 4)):
        scale = np.abs(slopes[:, block]).max(axis=(0, 1))
        assert np.all(apart[:, block].max(axis=(0, 1)) < 1e-3 * scale)


def test_map_of_finite_length_is_made_once(kept, monkeypatch):
    cage = replace(CAGE, permeability=7e-13)
    one = replace(SHORT, cage=cage, film=FiniteMapSqueeze(cells=(6, 8)))
    path = squeeze_table.squeeze_path(one.slenderness, one.layer, True, (6, 8))
    assert path.parent == kept
    assert path.is_file()
    squeeze_table.squeeze_table.cache_clear()
    monkeypatch.setattr(squeeze_table, "_cavitated_table", None)  # making it again would fail
    q, v = states(5, 0.9)
    np.testing.assert_array_equal(replace(one, viscosity=0.01).force(q, v), one.force(q, v))
    monkeypatch.undo()
    others = {
        squeeze_table.squeeze_path(0.3, one.layer, True, (6, 8)),
        squeeze_table.squeeze_path(one.slenderness, None, True, (6, 8)),
        squeeze_table.squeeze_path(one.slenderness, one.layer, False, (6, 8)),
        squeeze_table.squeeze_path(one.slenderness, one.layer, True, (6, 12)),
    }
    assert len(others | {path}) == 5


def test_damaged_map_on_disk_is_made_again(kept):
    law = FiniteMapSqueeze(cells=(6, 8))
    one = replace(SHORT, cage=None, film=law)
    path = squeeze_table.squeeze_path(one.slenderness, None, True, (6, 8))
    whole = path.read_bytes()
    path.write_bytes(whole[:-3])
    squeeze_table.squeeze_table.cache_clear()
    with pytest.warns(RuntimeWarning, match="is made again"):
        assert replace(one, viscosity=0.02).force([3e-5, 0.0], [0.1, 0.0])[0] < 0.0
    assert path.read_bytes() == whole


@pytest.mark.convergence
@pytest.mark.parametrize("thin", [False, True])
@pytest.mark.parametrize("vented", [False, True])
def test_porous_potential_becomes_short_with_second_order(thin, vented):
    layer = LAYER._replace(thin=thin, vented=vented)
    short = short_squeeze_film(layer_modes(layer), cavitated=True)
    for eps, heading in ((0.5, 1.0), (0.8, 2.5)):
        w = np.array([np.cos(heading), np.sin(heading)])
        limit = 0.5 * short.force(np.array([eps, 0.0]), w) @ w
        errors = [CavitatedPotential(ratio, layer)(eps, heading) / limit - 1.0 for ratio in (0.06, 0.03)]
        assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.06)
        assert -1e-2 < errors[0] < 0.0


@pytest.mark.closed_form
@pytest.mark.parametrize("vented", [False, True])
def test_thin_layer_by_harmonics_is_the_local_one(vented):
    # Darcy's flux of every harmonic, in the limit in which it is a local operator.
    layer = LAYER._replace(
        thickness_ratio=1e-3, permeability_number=0.05 if not vented else 5e-8, vented=vented
    )
    for eps, heading in ((0.3, 0.5), (0.9, 2.0)):
        darcy = CavitatedPotential(0.7, layer)(eps, heading)
        local = CavitatedPotential(0.7, layer._replace(thin=True))(eps, heading)
        assert darcy == pytest.approx(local, rel=2e-4)


def test_potential_does_not_hang_on_its_resolution(monkeypatch):
    cases = [(eps, heading) for eps in (0.0, 0.6, 0.95) for heading in (0.3, 1.7, 3.0)]
    coarse = [CavitatedPotential(0.5, LAYER)(*case) for case in cases]
    monkeypatch.setattr(squeeze_potential, "FUNCTIONS", 44)
    monkeypatch.setattr(squeeze_potential, "NODES", 240)
    monkeypatch.setattr(squeeze_potential, "HARMONICS", 128)
    squeeze_potential._basis.cache_clear()
    fine = [CavitatedPotential(0.5, LAYER)(*case) for case in cases]
    monkeypatch.undo()
    squeeze_potential._basis.cache_clear()
    assert_allclose(coarse, fine, rtol=3e-4)


@pytest.mark.long
@settings(deadline=None, max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(chi=st.floats(0.0, 0.95), phi=st.floats(-3.1, 3.1), vx=st.floats(-1, 1), vy=st.floats(-1, 1))
def test_maps_dissipate(finite, chi, phi, vx, vy):
    q, v = 1e-4 * chi * np.array([np.cos(phi), np.sin(phi)]), np.array([vx, vy])
    full = (replace(damper, extent=FullFilm()) for damper in (MAPPED, finite))
    for damper in (MAPPED, finite, *full):
        force = damper.force(q, v)
        assert force @ v <= 1e-12 * np.linalg.norm(force) * np.linalg.norm(v)


def test_finite_length_takes_from_the_short_film(finite):
    q, v = states(100, 0.9)
    power, short = (np.sum(damper.force(q, v) * v, axis=0) for damper in (finite, SHORT))
    assert np.all(power / short < 1.0)
    assert 0.9 < np.median(power / short) < 1.0


def test_long_dampers_need_no_warning_with_a_finite_map(finite):
    long = replace(finite, length=0.08, cage=None, film=FiniteMapSqueeze(cells=(6, 8)))
    assert long.slenderness == pytest.approx(0.8)


def test_orbits_on_a_map_are_those_of_the_film():
    rotor = RigidRotor(mass=10.0, speed=400.0, unbalance=3e-4, gravity=(0.0, 0.0))
    film = replace(SHORT, viscosity=4.096e-4)
    found = [
        synchronous_orbits(rotor, with_springs(damper, 2.56e5))
        for damper in (film, replace(film, film=MapSqueeze()))
    ]
    for a, b in zip(found[0].folds, found[1].folds, strict=True):
        assert b.unbalance == pytest.approx(a.unbalance, rel=1e-5)
    assert found[1].contact_unbalance is None
    (orbit,), (mapped,) = (orbits.at(3e-4) for orbits in found)
    assert mapped.growth_rate == pytest.approx(orbit.growth_rate, rel=1e-3)


def test_what_has_no_map_is_refused():
    for law in (MapSqueeze(), FiniteMapSqueeze()):
        for extent in (HalfSommerfeld(), FullFilm()):
            with pytest.raises(InputError, match="feed must be None"):
                replace(SHORT, film=law, extent=extent, feed=RadialFeed(inflow=0.1))
    with pytest.raises(UndefinedDerivativeError):
        MAPPED.jacobian([3e-5, 0.0], [0.0, 0.0])
    with pytest.warns(ValidityWarning, match="beyond the map of the film"):
        MAPPED.force([0.999e-4, 0.0], [0.1, 0.0])


@pytest.mark.convergence
@pytest.mark.parametrize("turn", [0.0, 1.0, 1.55, 1.6, 2.2, 3.0])
def test_short_map_goes_on_as_the_film_at_the_wall(turn):
    exact, mapped = (replace(SHORT, cage=None, film=film) for film in (ShortSqueeze(), MapSqueeze()))
    motion = np.array([0.999e-4, 0.0]), np.array([np.cos(turn), np.sin(turn)])
    expected = exact.force(*motion)
    with pytest.warns(ValidityWarning, match="as that of a film at the wall, within 5 %"):
        difference = mapped.force(*motion) - expected
    assert np.linalg.norm(difference) < 0.04 * np.linalg.norm(expected)


def test_ends_that_are_not_found_are_an_error(monkeypatch):
    monkeypatch.setattr(squeeze_potential, "RESIDUAL", 0.0)
    with pytest.raises(ConvergenceError, match="ends of the film were not found"):
        CavitatedPotential(0.5, None)(0.5, 1.0)


@pytest.mark.long
@pytest.mark.closed_form
def test_force_of_a_finite_map_is_that_of_the_journals_map():
    journal = JournalBearing(radius=0.05, length=0.05, clearance=1e-4, viscosity=0.01, film=MapFilm())
    damper = replace(SHORT, length=0.05, cage=None, film=FiniteMapSqueeze(cells=(12, 24)))
    q, v = states(200, 0.95)
    expected = journal.force(q, v, 0.0)
    errors = np.linalg.norm(damper.force(q, v) - expected, axis=0) / np.linalg.norm(expected, axis=0)
    assert np.quantile(errors, 0.99) < 2e-4
    for chi in (0.99, 0.998):
        for turn in (0.0, 1.2, 1.55, 1.6, 2.2):
            q, v = np.array([chi * 1e-4, 0.0]), np.array([np.cos(turn), np.sin(turn)])
            expected = journal.force(q, v, 0.0)
            with pytest.warns(ValidityWarning, match="as that of a film at the wall, within 5 %"):
                difference = damper.force(q, v) - expected
            assert np.linalg.norm(difference) < 0.03 * np.linalg.norm(expected)
