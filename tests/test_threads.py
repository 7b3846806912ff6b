"""One BLAS thread while an analysis runs, and what was set before afterwards."""

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController

import rotorfilm as rf
from rotorfilm.analysis.threads import one_blas_thread


def threads() -> set[int]:
    found = ThreadpoolController().select(user_api="blas").lib_controllers
    return {library.get_num_threads() for library in found}


@pytest.fixture
def two_threads():
    import scipy.linalg  # noqa: F401

    with ThreadpoolController().limit(limits=2, user_api="blas"):
        if threads() != {2}:
            pytest.skip("this BLAS has one thread")
        yield


def test_blocks_within_blocks_and_errors_restore_what_was_set(two_threads):
    with one_blas_thread:
        with one_blas_thread:
            assert threads() == {1}
        assert threads() == {1}
    assert threads() == {2}
    with pytest.raises(ZeroDivisionError), one_blas_thread:
        1 / 0  # noqa: B018
    assert threads() == {2}


class Witness(rf.LinearBearing):
    """Springs that note the number of threads when they are asked for their force."""

    def linearization(self, t, state, u):
        seen.append(threads())
        return super().linearization(t, state, u)

    def jacobian(self, position, velocity, speed):
        seen.append(threads())
        return super().jacobian(position, velocity, speed)


seen: list[set[int]] = []


@pytest.mark.parametrize(
    "analysis",
    [
        lambda rotor, on: rf.rotor_modes(rotor, on, 100.0),
        lambda rotor, on: rf.campbell(rotor, on, [50.0, 100.0]),
        lambda rotor, on: rf.critical_speeds(rotor, on, np.linspace(20.0, 300.0, 3)),
        lambda rotor, on: rf.unbalance_response(rotor, on, [50.0, 100.0]),
    ],
    ids=["modes", "Campbell", "critical speeds", "unbalance"],
)
def test_analyses_of_rotors_run_on_one_thread(two_threads, analysis):
    steel = rf.ElasticMaterial(young_modulus=2.1e11, shear_modulus=8.1e10, density=7800.0)
    rotor = rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.0, outer_diameter=0.04, material=steel).split(4),
        disks=(rf.Disk.solid(2, outer_diameter=0.3, width=0.05, inner_diameter=0.04, density=7800.0),),
        stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
        unbalances=(rf.Unbalance(node=2, unbalance=1e-4),),
        speed=0.0,
    )
    seen.clear()
    spring = Witness(stiffness=1e7, damping=1e3)
    analysis(rotor, {"left": spring, "right": spring})
    assert seen
    assert all(found == {1} for found in seen)
    assert threads() == {2}
