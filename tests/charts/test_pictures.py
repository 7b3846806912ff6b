"""One description of each picture, drawn by matplotlib and by plotly, and the numbers that are in it."""

from dataclasses import replace

import numpy as np
import pytest

import rotorfilm as rf
from rotorfilm.analysis import (
    OrbitsOverSpeed,
    RotorModes,
    coefficient_table,
    run_amplitudes,
    run_orbits,
    run_spectra,
)
from rotorfilm.charts import (
    BarsMark,
    ColorScale,
    CurveMark,
    FieldMark,
    LevelMark,
    NoteMark,
    Picture,
    PicturePanel,
    picture_of,
    plot_full_spectrum,
    plot_histogram,
    plot_map,
    plot_mode_orbits,
    plot_rotor,
    plot_run_orbits,
    plot_spectrogram,
    plot_time_windows,
    plot_tornado,
    plot_waterfall,
    use,
)
from rotorfilm.core import CircularOrbit

pytest.importorskip("plotly")

FORWARD, BACKWARD, WHIP = 5e-6, 2e-6, 1e-6


def run_up(first=10.0, last=60.0, duration=4.0, samples=16001):
    """Return a run-up [turns a second]: an ellipse at 1x, and forward whirl at 7 Hz."""
    time = np.linspace(0.0, duration, samples)
    rise = (last - first) / duration
    angle = 2.0 * np.pi * (first * time + 0.5 * rise * time**2)
    z = FORWARD * np.exp(1j * angle) + BACKWARD * np.exp(-1j * angle) + WHIP * np.exp(14j * np.pi * time)
    signals = {"disk_x": z.real, "disk_y": z.imag, "speed": 2.0 * np.pi * (first + rise * time)}
    return rf.Trajectory(time=time, signals=signals, work={})


RUN = run_up()


def test_pyplot_shows_plots_where_it_has_windows(monkeypatch):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.close("all")
    RUN.plot("amplitude")
    assert pyplot.get_fignums() == []
    monkeypatch.setattr(pyplot, "get_backend", lambda: "QtAgg")
    RUN.plot("amplitude")
    picture_of(RUN, "amplitude").draw()
    assert len(pyplot.get_fignums()) == 1
    pyplot.close("all")


def shaft():
    steel = rf.ElasticMaterial(young_modulus=211e9, shear_modulus=81.2e9, density=7810.0)
    solid = {"density": 7810.0, "width": 0.07, "outer_diameter": 0.28}
    return rf.ShaftRotor(
        elements=rf.ShaftElement(length=1.2, outer_diameter=0.05, material=steel).split(4),
        stations=(rf.Station(node=0, name="left"), rf.Station(node=4, name="right")),
        disks=(rf.Disk.solid(2, **solid),),
        unbalances=(rf.Unbalance(node=2, unbalance=1e-4),),
        probes=(rf.Probe(node=1, name="probe"),),
        speed=0.0,
    )


def whirl(sense, speed=100.0):
    """Return a mode in circles: y lags behind x by a quarter of a turn where it is forward."""
    rotor = shaft()
    n = len(rotor.assembly.coordinates)
    shapes = np.zeros((2 * n, 1), complex)
    shapes[0:10:2, 0] = bow = np.sin(np.pi * rotor.positions / 1.2)
    shapes[n : n + 10 : 2, 0] = -1j * sense * bow
    modes = RotorModes(
        speed=speed, eigenvalues=np.array([-3.0 + 200j]), shapes=shapes, direction=np.array([sense])
    )
    return plot_mode_orbits(rotor, modes, 0)


SPRING = rf.LinearBearing(stiffness=((1e7, 0.0), (0.0, 2e7)), damping=((1e3, 0.0), (0.0, 1e3)))
SPRINGS = {"left": SPRING, "right": SPRING}


def deflected():
    return rf.analysis.deflected_shape(shaft(), SPRINGS, 150.0)


def damper_curve():
    def orbit(speed, ratio, rate):
        return CircularOrbit(
            eccentricity_ratio=ratio,
            unbalance=1e-4,
            speed=speed,
            phase=-1.0,
            transmissibility=2.0 * ratio,
            growth_rate=rate,
        )

    return OrbitsOverSpeed(
        unbalance=1e-4, orbits=(orbit(100.0, 0.2, -1.0), orbit(200.0, 0.3, -1.0), orbit(200.0, 0.5, 2.0))
    )


FILM = rf.JournalBearing(radius=0.05, length=0.03, clearance=1e-4, viscosity=0.1)
DOTS = [1.0, 2.0], [3.0, 4.0]
DOTTED = [CurveMark(*DOTS, "dots")]
GRID = [0.0, 1.0], [0.0, 1.0, 2.0]
TABLE = [[-1, 1], [0, 2], [1, 3]]
EVERY = Picture(
    (
        PicturePanel(
            (
                CurveMark([1.0, 2.0], [3.0, 4.0], "line", "C1", "--", marker="s", filled=False),
                CurveMark([1.0, 2.0], [30.0, 40.0], "other", "C2", right=True),
                CurveMark([1.0, 2.0, 1.5], [3.0, 3.0, 4.0], "", "C3", "", fill=0.2),
                CurveMark(
                    [1.0, 2.0],
                    [3.0, 4.0],
                    "dots",
                    "k",
                    "",
                    marker="^",
                    values=[0.0, 1.0],
                    scale=ColorScale("v"),
                ),
                LevelMark(3.5, "level", dash=":"),
                LevelMark(1.2, "band", "0.5", upright=True, to=1.4),
                NoteMark(1.0, 3.0, "here"),
            ),
            "x [m]",
            "y [m]",
            "title",
            right="other [N]",
            log="x",
            x_limits=(0.5, 3.0),
        ),
        PicturePanel([BarsMark([1.0, 2.0], [3.0, 5.0], "bars", base=1.0)], "x", "y", y_limits=(0.0, None)),
        PicturePanel(
            [FieldMark([0.0, 1.0], [0.0, 1.0, 2.0], [[1, 2], [3, 4], [5, 6]], ColorScale("f [Pa]"))],
            "x",
            "y",
            equal=True,
        ),
        PicturePanel([CurveMark([0.0, 1.0], [0.0, 1.0], z=[2.0, 3.0], marker="^")], "x", "y", z="z [m]"),
    ),
    columns=2,
)
PICTURES = {
    "every mark": EVERY,
    "orbit": picture_of(RUN),
    "amplitude": picture_of(RUN, "amplitude"),
    "waterfall": plot_waterfall(run_spectra(RUN)),
    "spectrogram": plot_spectrogram(run_spectra(RUN)),
    "full spectrum": plot_full_spectrum(run_spectra(RUN)),
    "orbits": plot_run_orbits(run_orbits(RUN, [100.0, 300.0])),
    "windows": plot_time_windows(RUN, [0.5, 3.0]),
    "spectrum": picture_of(RUN, "spectrum"),
    "rotor": plot_rotor(shaft()),
    "mode in space": whirl(1.0),
    "deflected shape": picture_of(deflected()),
    "deflected orbits": picture_of(deflected(), "orbits"),
    "damper curve": picture_of(damper_curve()),
    "coefficients": picture_of(coefficient_table(FILM, (0.0, -525.0), [100.0, 200.0])),
    "tornado": plot_tornado({"clearance": (0.2, 0.4), "load": (0.31, 0.29)}, base=0.3, quantity="ratio [1]"),
    "histogram": plot_histogram([1.0, 2.0, 2.0, 3.0], quantity="film [um]", bins=4),
    "map": plot_map([1.0, 2.0], [1.0, 2.0, 3.0], TABLE, labels=("a", "b", "c"), level=0.0),
}


def drawn_by_plotly(picture):
    """Return coordinates of the curves of a plotly figure, without texts and entries of its legend."""
    data = [one for one in picture.to_plotly().data if one.type.startswith("scatter") and one.mode != "text"]
    return [(np.asarray(one.x, float), np.asarray(one.y, float)) for one in data if one.x[0] is not None]


@pytest.mark.parametrize("name", PICTURES)
def test_both_backends_draw_the_numbers_of_one_description(name):
    picture = PICTURES[name]
    axes = picture.draw()
    assert len(axes) == len(picture.panels)
    curves = [one for panel in picture.panels for one in panel.marks if isinstance(one, CurveMark)]
    for curve, (x, y) in zip(curves, drawn_by_plotly(picture), strict=True):
        np.testing.assert_array_equal(x, curve.x)
        np.testing.assert_array_equal(y, curve.y)
    lines = [line for one in axes[0].figure.axes for line in one.get_lines()]
    for curve in (one for one in curves if one.values is None and one.dash and one.z is None):
        assert any(np.array_equal(line.get_xdata(), curve.x) for line in lines)
    assert picture.to_plotly().to_json()


def test_every_mark_reaches_both_backends():
    figure, axes = EVERY.to_plotly(), EVERY.draw()
    names = {one.name for one in figure.data if one.showlegend}
    assert names == {"line", "other", "dots", "level", "band", "bars"}
    shown = {text.get_text() for one in axes[:2] for text in one.get_legend().get_texts()}
    assert names == shown
    assert len(figure.layout.shapes) == 2
    first = Picture((PicturePanel([LevelMark(1.0), *DOTTED], "x", "y", legend="none"),)).to_plotly()
    assert len(first.layout.shapes) == 1  # also where the line is behind all curves
    assert first.layout.legend.visible is False
    heat = next(one for one in figure.data if one.type == "heatmap")
    mesh = axes[2].collections[0]
    np.testing.assert_array_equal(heat.z, mesh.get_array())
    assert heat.colorbar.title.text == "f [Pa]"
    bars = next(one for one in figure.data if one.type == "bar")
    np.testing.assert_array_equal(bars.y, [bar.get_height() for bar in axes[1].patches])
    assert (figure.layout.xaxis.title.text, figure.layout.xaxis.type) == ("x [m]", "log")
    np.testing.assert_allclose(figure.layout.xaxis.range, np.log10([0.5, 3.0]))
    assert figure.layout.scene.zaxis.title.text == axes[3].get_zlabel() == "z [m]"


@pytest.mark.closed_form
def test_the_amplitudes_of_a_run_up_are_those_of_its_ellipse():
    """Along x the ellipse has the half axis a + b; 1x is free of the whirl at 7 Hz, the overall is not."""
    found = run_amplitudes(RUN, turns=8)
    fast = found.speed > 2.0 * np.pi * 25.0
    np.testing.assert_allclose(np.abs(found.synchronous)[fast], FORWARD + BACKWARD, rtol=0.03)
    assert np.all(found.overall[fast] <= 1.0001 * (FORWARD + BACKWARD + WHIP))
    assert np.all(found.overall[fast] > FORWARD + BACKWARD)
    np.testing.assert_allclose(np.angle(found.synchronous[fast]), 0.0, atol=0.03)
    np.testing.assert_allclose(found.speed, 2.0 * np.pi * (10.0 + 12.5 * found.time), rtol=1e-3)


@pytest.mark.closed_form
def test_a_full_spectrum_tells_forward_from_backward_whirl():
    steady = run_up(first=40.0, last=40.0)
    found = run_spectra(steady, windows=1)
    row, hertz = found.whirl_amplitude[0], found.frequency / (2.0 * np.pi)
    for at, size in ((40.0, FORWARD), (-40.0, BACKWARD), (7.0, WHIP), (-7.0, 0.0)):
        assert row[np.abs(hertz - at) < 0.5].max() == pytest.approx(size, rel=0.02, abs=2e-9), at
    curve = next(one for one in plot_full_spectrum(found).panels[0].marks)
    assert curve.x[np.argmax(curve.y)] == pytest.approx(40.0, abs=0.1)


@pytest.mark.closed_form
def test_the_largest_line_of_a_run_up_is_at_the_speed():
    found = run_spectra(RUN, "disk", windows=60)
    peaks = found.frequency[found.whirl_amplitude.argmax(axis=1)]
    step = found.frequency[1] - found.frequency[0]
    np.testing.assert_allclose(peaks, found.speed, atol=step)
    assert set(PICTURES["spectrogram"].panels[0].curves) == {"1x", "0.5x", "-1x"}


@pytest.mark.closed_form
def test_keyphasor_dots_are_where_the_shaft_has_the_angle_of_the_start():
    found = run_orbits(RUN, [2.0 * np.pi * 40.0], turns=4)
    dots = found.x[0][found.keyphasor[0]] + 1j * found.y[0][found.keyphasor[0]]
    assert 3 <= dots.size <= 5
    assert np.abs(dots - (FORWARD + BACKWARD)).max() < 1.2 * WHIP
    assert np.ptp(found.time) == pytest.approx(4.0 / 40.0, rel=0.05)


def test_runs_that_do_not_turn_or_lack_samples_are_refused():
    still = rf.Trajectory(time=RUN.time, signals={"x": RUN.time, "y": RUN.time}, work={})
    with pytest.raises(rf.InputError, match="signal must be one of x, y, got 'speed'"):
        still.plot("amplitude")
    assert still.plot("spectrogram").get_xlabel() == "time [s]"
    with pytest.raises(rf.InputError, match="windows must have 8 samples"):
        run_spectra(RUN, windows=10000)
    with pytest.raises(rf.InputError, match="speeds must be in the run"):
        run_orbits(RUN, [1e4])
    with pytest.raises(rf.InputError, match="run must have displacements"):
        run_spectra(rf.Trajectory(time=RUN.time, signals={"speed": RUN.time}, work={}))


@pytest.mark.closed_form
@pytest.mark.parametrize(("sense", "speed"), [(1.0, 100.0), (-1.0, 100.0), (-1.0, -100.0)])
def test_a_mode_in_space_has_circles_of_its_sense(sense, speed):
    panel = whirl(sense, speed).panels[0]
    name = "forward" if sense * speed > 0.0 else "backward"
    assert {"forward", "backward"} & set(panel.curves) == {name}
    middle = [one for one in panel.marks if isinstance(one, CurveMark) and len(np.ravel(one.x)) == 73][1]
    np.testing.assert_allclose(np.hypot(middle.y, middle.z), np.sqrt(0.5), rtol=1e-12)
    turned = np.unwrap(np.arctan2(middle.z, middle.y))
    assert np.sign(turned[-1] - turned[0]) == sense


@pytest.mark.closed_form
def test_a_rotor_is_drawn_to_scale():
    panel = PICTURES["rotor"].panels[0]
    disk = panel.curves["disk"]
    assert (max(disk.y), max(disk.x) - min(disk.x)) == pytest.approx((140.0, 70.0))
    assert np.mean(disk.x[:4]) == pytest.approx(600.0)
    boxes = [one for one in panel.marks if isinstance(one, CurveMark) and one.fill and not one.label]
    assert len(boxes) == 2 * 4
    assert max(np.max(one.y) for one in boxes) == 25.0
    assert panel.equal
    assert {"bearing", "unbalance", "probe"} <= set(panel.curves)
    seals = plot_rotor(shaft(), {"left": FakeSeal()}).panels[0].curves
    assert seals["seal"].x == [0.0]


class FakeSeal:
    """What is drawn as a seal."""


def test_the_parameter_of_most_effect_is_above():
    low, high, _ = PICTURES["tornado"].panels[0].marks
    assert list(low.places) == ["load", "clearance"]
    assert (low.tops[-1], high.tops[-1], low.base) == (0.2, 0.4, 0.3)


def test_a_stability_map_is_red_where_it_is_unstable_and_has_the_border():
    (field,) = PICTURES["map"].panels[0].marks
    assert (field.scale.colors, field.scale.low, field.scale.high) == ("RdYlGn", -3.0, 3.0)
    assert field.level == 0.0
    with pytest.raises(rf.InputError, match=r"values must have shape \(3, 2\)"):
        plot_map([1.0, 2.0], [1.0, 2.0, 3.0], np.zeros((2, 3)), labels=("a", "b", "c"))


def test_a_histogram_counts_and_tells_quantiles():
    bars, *levels = PICTURES["histogram"].panels[0].marks
    assert list(bars.tops) == [1, 0, 2, 1]
    assert levels[1].at == 2.0


def test_unstable_orbits_over_speed_are_open_dots():
    above, below = PICTURES["damper curve"].panels
    assert above.curves["eccentricity ratio, unstable"].y == [0.5]
    assert not above.curves["eccentricity ratio, unstable"].filled
    np.testing.assert_allclose(below.curves["transmissibility"].y, [0.4, 0.6])


@pytest.mark.long
def test_a_backend_is_chosen_once_and_pages_need_no_network(tmp_path):
    use("plotly")
    try:
        assert type(RUN.plot("amplitude")).__module__.startswith("plotly")
    finally:
        use("matplotlib")
    page = EVERY.save(tmp_path / "page.html").read_text(encoding="utf-8")
    assert 'src="http' not in page
    assert EVERY.save(tmp_path / "page.svg").read_bytes().lstrip().startswith(b"<?xml")
    assert EVERY._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(rf.InputError, match="backend must be one of"):
        use("gnuplot")


@pytest.mark.closed_form
def test_a_deflected_shape_is_the_response_of_its_nodes():
    """It agrees with the receptance from the disk to every node, and lies along the largest deflection."""
    found, rotor = deflected(), shaft()
    seen = rf.analysis.receptance(rotor, SPRINGS, 150.0, [150.0], range(5)).frdata[:, :, 0]
    push = 1e-4 * 150.0**2 * np.array([1.0, -1.0j])
    np.testing.assert_allclose(seen[0::2, 4:6] @ push, found.x, rtol=1e-7)
    np.testing.assert_allclose(seen[1::2, 4:6] @ push, found.y, rtol=1e-7)
    panel = picture_of(found).panels[0]
    along = np.hypot(panel.curves["x"].y, panel.curves["y"].y)
    turn = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 721))
    middle = np.hypot((found.x[2] * turn).real, (found.y[2] * turn).real).max()
    assert along.max() == pytest.approx(1e6 * middle, rel=1e-4)
    assert set(picture_of(found, "orbits").panels[0].curves) == {"shaft", "forward", "bearing"}
    with pytest.raises(rf.InputError, match="rotor must have an unbalance"):
        rf.analysis.deflected_shape(replace(rotor, unbalances=()), SPRINGS, 150.0)


def test_an_object_without_a_picture_is_refused_with_those_that_have_one():
    with pytest.raises(
        rf.InputError, match=r"^result must be one of Trajectory, .*, got a dict; functions such as"
    ):
        picture_of({})
