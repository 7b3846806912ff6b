"""`[lubricant]`: the oil of a scene, and what cools it."""

import numpy as np
import pytest

from rotorfilm import Cooling, JournalBearing, Oil, SceneError, equilibrium
from rotorfilm.scenes import Lubricant, parse_scene

SCENE = """
schema = 1
[journal]
diameter = "100 mm"
length = "30 mm"
clearance = "0.1 mm"
{journal}
[lubricant]
{lubricant}
[operation]
speed = "1500 rpm"
load = "525 N"
"""


def scene(lubricant, journal=""):
    return parse_scene(SCENE.format(lubricant=lubricant, journal=journal), "scene.toml")


GRADE = 'grade = "ISO VG 100"\nsupply_temperature = "37.1 degC"\n'


def test_a_journal_without_viscosity_runs_on_the_oil():
    warm = scene(GRADE + 'housing_conductance = "3 W/K"\nambient_temperature = "300 K"')
    cooling = Cooling(supply_temperature=310.25, housing_conductance=3.0, ambient_temperature=300.0)
    own = JournalBearing(radius=0.05, length=0.03, clearance=1e-4, oil=Oil.iso_vg(100), cooling=cooling)
    assert warm.bearing == own
    told, at = warm.describe().equilibrium, equilibrium(own, (0.0, -525.0), 50.0 * np.pi)
    assert told.temperature == at.temperature
    assert told.position == pytest.approx(at.position, rel=1e-14)
    assert not any("heat" in remark for remark in warm.describe().remarks)


@pytest.mark.parametrize(
    ("lubricant", "oil"),
    [
        ('viscosity_40 = "46 cSt"\nviscosity_100 = "6.76 mm2/s"', Oil.iso_vg(46)),
        ('grade = 46\nviscosity_100 = "7 cSt"', Oil.two_points((313.15, 46e-6), (373.15, 7e-6))),
        ('viscosity_40 = "46 cSt"\nthinning = 0.03', None),
    ],
)
def test_oils_by_what_is_known_of_them(lubricant, oil):
    found = scene(lubricant + '\nsupply_temperature = "45 degC"').bearing.oil
    if oil is None:
        assert found.thinning(300.0) == 0.03
        assert found.viscosity(313.15) / found.density(313.15) == pytest.approx(46e-6, rel=1e-12)
    else:
        assert found == oil


def test_a_stated_viscosity_stays_what_it_is():
    plain = scene("density = 870", 'viscosity = "0.1 Pa s"')
    beside = scene(GRADE, 'viscosity = "0.1 Pa s"')
    assert plain.bearing == beside.bearing
    assert plain.bearing.oil is None
    assert plain.lubricant.properties == Lubricant(density=870.0)
    assert beside.lubricant.properties.thinning == pytest.approx(0.0549, abs=1e-4)


def test_a_viscosity_beside_an_oil_is_told():
    plain, beside = (
        scene("density = 870", "viscosity = 0.1").describe(),
        scene(GRADE, "viscosity = 0.1").describe(),
    )
    assert not any(remark.startswith("oil: ") for remark in plain.remarks)
    assert beside.remarks[0].startswith("oil: journal runs on its own viscosity of 0.1 Pa s")
    assert beside.equilibrium.position.tobytes() == plain.equilibrium.position.tobytes()


@pytest.mark.parametrize(
    ("lubricant", "match"),
    [
        ("density = 870", r"journal\.viscosity is required where \[lubricant\] gives no grade"),
        ('grade = "ISO VG 100"', r"scene\.toml: lubricant\.supply_temperature must be given"),
        ('grade = "SAE 30"\nsupply_temperature = 310', r"lubricant\.grade must be an ISO viscosity grade"),
        ("grade = 47\nsupply_temperature = 310", "grade must be one of 22, 32"),
        ('viscosity_40 = "46 cSt"\nsupply_temperature = 310', "viscosity_40 and viscosity_100 must be given"),
        (GRADE + 'viscosity_40 = "46 cSt"', "grade must not be given beside viscosity_40"),
        ('grade = 46\nsupply_temperature = "45 m"', "must be measured in K"),
        ("thinning = -1\n", "thinning must be finite and positive"),
    ],
)
def test_an_oil_that_is_not_known_is_named(lubricant, match):
    with pytest.raises(SceneError, match=match):
        scene(lubricant)
