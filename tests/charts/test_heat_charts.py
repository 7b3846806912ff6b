"""Pictures of films that warm: what is drawn is what was found, in the units of the labels."""

import numpy as np
import pytest

from rotorfilm import Groove, InputError
from rotorfilm.bearings.journal import (
    BushRing,
    HeatedFilm,
    JournalBearing,
    LayeredTemperature,
    MeanTemperature,
)
from rotorfilm.bearings.oil import Cooling, Oil
from rotorfilm.charts import (
    plot_circumference,
    plot_heated_film,
    plot_pressure_field,
    plot_study,
    plot_temperature_across,
    plot_temperature_field,
)
from rotorfilm.studies import HEAT_CASES, HeatModel, StudyResult, StudyRow


def state_of(profile):
    bearing = JournalBearing(
        radius=0.05,
        length=0.05,
        clearance=75e-6,
        oil=Oil.iso_vg(46),
        cooling=Cooling(supply_temperature=318.15),
        grooves=(Groove(center=0.0, width=0.35), Groove(center=np.pi, width=0.35)),
    )
    film = HeatedFilm(bearing=bearing, walls=BushRing(outer_radius=0.1), cells=(32, 4), profile=profile)
    return film.solve([22e-6, -37e-6], 314.2)


@pytest.fixture(scope="module")
def layered():
    return state_of(LayeredTemperature(5))


def mesh_of(axes):
    return axes.collections[0]


def test_fields_are_drawn_whole_and_in_degrees(layered):
    (axes,) = plot_temperature_field(layered).draw()
    shown = mesh_of(axes).get_array()
    mean = layered.oil_temperature.mean(axis=-1) - 273.15
    assert shown.shape == (2 * mean.shape[1] - 1, mean.shape[0])
    assert (shown.min(), shown.max()) == pytest.approx((mean.min(), mean.max()))
    np.testing.assert_array_equal(shown, shown[::-1])  # both halves
    assert axes.get_xlim() == (0.0, 360.0)
    assert axes.get_ylim() == pytest.approx((-25.0, 25.0))
    assert axes.figure.axes[1].get_ylabel() == "temperature [degC]"


def test_pressure_is_where_it_was_found(layered):
    (axes,) = plot_pressure_field(layered).draw()
    mesh = mesh_of(axes)
    shown = mesh.get_array()
    line, node = np.unravel_index(layered.pressure.argmax(), layered.pressure.shape)
    assert shown.max() == pytest.approx(1e-6 * layered.pressure[line, node])
    column = np.unravel_index(shown.argmax(), shown.shape)[1]
    edges = np.sort(mesh.get_coordinates()[0, :, 0])
    assert edges[column] <= np.degrees(layered.angle[line]) <= edges[column + 1]


def test_the_gap_is_drawn_across(layered):
    field, journal = plot_temperature_across(layered).panels[0].marks
    gap, chi = journal.y, np.hypot(*layered.position) / 75e-6
    assert gap.min() == pytest.approx(75.0 * (1.0 - chi), rel=5e-3)
    assert gap.max() == pytest.approx(75.0 * (1.0 + chi), rel=5e-3)
    thinnest = np.degrees(np.arctan2(layered.position[1], layered.position[0])) % 360.0
    assert journal.x[gap.argmin()] == pytest.approx(thinnest, abs=12.0)
    assert np.nanmax(field.values) == pytest.approx(layered.oil_temperature[:, 0].max() - 273.15)
    np.testing.assert_array_equal(np.isnan(field.values), field.y[:, None] >= gap)


def test_a_film_with_a_mean_temperature_has_no_picture_across():
    state = state_of(MeanTemperature())
    assert len(plot_heated_film(state).panels) == 2
    with pytest.raises(InputError, match="state must be that of a film with LayeredTemperature"):
        plot_temperature_across(state)


def test_load_and_film_over_the_circumference(layered):
    _, pressure, film = plot_circumference(layered).panels[0].marks
    np.testing.assert_array_equal(np.diff(pressure.x) > 0.0, True)
    assert pressure.y.max() == pytest.approx(1e-6 * layered.pressure.max())
    chi = np.hypot(*layered.position) / 75e-6
    assert (film.y.min(), film.y.max()) == pytest.approx((75.0 * (1.0 - chi), 75.0 * (1.0 + chi)), rel=5e-3)
    assert film.right


def test_the_whole_film_is_one_figure(layered):
    shown = plot_heated_film(layered, title="a film").draw()
    assert [axes.get_figure().get_suptitle() for axes in shown] == ["a film"] * 3


@pytest.mark.long
def test_ladder_has_a_panel_for_each_bearing():
    rungs = tuple(
        StudyRow(
            name=model,
            family=model,
            label=model.label,
            case=case.name,
            values={
                "error of the position [1]": 0.5 / k,
                "error of the power [1]": 0.2 / k,
                "CPU time [s]": 1e-3 * k,
            },
        )
        for case in HEAT_CASES
        for k, model in enumerate(HeatModel, 1)
    )
    picture = plot_study(StudyResult(study="heat", reference="finer", rungs=rungs))
    first = picture.panels[0]
    assert [one.title for one in picture.panels] == [case.name for case in HEAT_CASES]
    dots = np.array([(*one.x, *one.y) for one in first.curves.values()])
    np.testing.assert_allclose(dots[:, 0], 1e-3 * np.arange(1.0, 7.0))
    np.testing.assert_allclose(dots[:, 1], 0.5 / np.arange(1.0, 7.0))
    assert {text.get_text() for text in picture.draw()[0].texts} == {model.label for model in HeatModel}
