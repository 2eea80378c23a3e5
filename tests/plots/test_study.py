"""Plots of studies: errors with their intervals, slopes as powers, and every word where it can be read."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

import samplekit
from samplekit import UsageError
from samplekit._study.results import Interval
from samplekit.plots import StudyDisplay

SAMPLERS = ["random", "jittered", "sobol+owen", "halton"]


@pytest.fixture(scope="module")
def study():
    return samplekit.compare(SAMPLERS, ["disk", "gaussian"], [4, 16, 64, 256], trials=40, size=(1, 1), budget=0.0)


def curves(ax):
    """Legend to the curve's points and intervals."""
    handles, labels = ax.get_legend_handles_labels()
    found = {}
    for label, (line, _, (*_, bars)) in zip(labels, handles, strict=True):
        low, high = np.array([segment[:, 1] for segment in bars.get_segments()]).T
        found[label] = (*line.get_data(), low, high)
    return found


def test_curves_are_the_rows_of_the_results(study):
    ax = study.plot("disk").ax_
    assert ax.get_xscale() == ax.get_yscale() == "log"
    for label, (x, y, low, high) in curves(ax).items():
        rows = [row for row in study.rows if row.scene == "disk" and row.sampler == label.split("  ")[0]]
        assert x.tolist() == [row.count for row in rows]
        assert y.tolist() == [row.mse.estimate for row in rows]
        assert low == pytest.approx([row.mse.low or row.mse.estimate for row in rows])
        assert high == pytest.approx([row.mse.high or row.mse.estimate for row in rows])


def test_against_time_x_is_seconds(study):
    ax = study.plot("disk", against="time").ax_
    for label, (x, *_) in curves(ax).items():
        assert x.tolist() == [
            row.time.estimate for row in study.rows if row.scene == "disk" and row.sampler == label.split("  ")[0]
        ]
    assert ax.get_xlabel() == "seconds $t$"


def test_the_legend_names_slopes_as_powers_and_follows_the_ends_of_the_curves(study):
    found = curves(study.plot("gaussian").ax_)
    fits = [fit for fit in study.fits if fit.scene == "gaussian"]
    powers = {fit.sampler: f"  $N^{{{fit.slope.estimate:.2f}}}$" for fit in fits if fit.falls}
    assert {"random", "jittered", "sobol+owen"} <= set(powers)
    assert set(found) == {sampler + powers.get(sampler, "") for sampler in SAMPLERS}
    ends = [y[-1] for _, y, _, _ in found.values()]
    assert ends == sorted(ends, reverse=True)


def test_the_legend_names_no_power_of_the_samples_along_time(study):
    assert set(curves(study.plot("gaussian", against="time").ax_)) == set(SAMPLERS)


def test_the_legend_names_no_power_where_the_interval_of_the_slope_reaches_0(study):
    vague = [replace(fit, slope=Interval(-1.0, -2.5, 0.5)) for fit in study.fits]
    assert set(curves(replace(study, fits=vague).plot("gaussian").ax_)) == set(SAMPLERS)


def test_curves_differ_in_colour_and_in_marker(study):
    lines = [line for line in study.plot("disk").ax_.lines if line.get_marker() not in ("None", "")]
    assert len({line.get_color() for line in lines}) == len({line.get_marker() for line in lines}) == 4


@pytest.mark.parametrize("against", ["samples", "time"])
@pytest.mark.parametrize("scene", ["disk", "gaussian"])
def test_no_word_lies_on_a_curve_or_on_another(study, apart, scene, against):
    apart(study.plot(scene, against=against).figure_)


def test_the_guide_lines_have_the_slopes_that_they_name(study):
    ax = study.plot("disk").ax_
    (left, right), (bottom, top) = ax.get_xlim(), ax.get_ylim()
    guides = [line for line in ax.lines if line.get_transform() == ax.transAxes]
    slopes = []
    for line in guides:
        (x0, x1), (y0, y1) = line.get_data()
        slopes.append((y1 - y0) * np.log(top / bottom) / ((x1 - x0) * np.log(right / left)))
        # Outside of the axes, where no curve is.
        assert x0 > 1.0
    named = [text.get_text() for text in ax.texts]
    assert named == [f"$N^{{\N{MINUS SIGN}{-slope:.2g}}}$" for slope in slopes]
    assert slopes[0] == pytest.approx(-1.0)


def test_title_and_conditions(study, drawn):
    texts = drawn(study.plot("disk").figure_)
    assert "disk: error against samples" in texts
    assert "the unit square, 40 trials, 95 % intervals" in texts
    image = samplekit.compare("random", "disk", [1, 4], trials=2, size=(6, 5), budget=0.0, cost=50.0).plot(
        against="time"
    )
    texts = drawn(image.figure_)
    assert "6 x 5 pixels, 2 trials, 95 % intervals, 50 ns added for each sample" in texts
    assert "seconds for an image, $t$" in texts


@pytest.mark.parametrize("counts", [[16], [5, 6, 7], [3, 2**14, 2**20], [2**k for k in range(15)]])
def test_marks_of_the_counts_can_be_read(study, apart, counts):
    row = next(row for row in study.rows if row.scene == "disk")
    rows = [replace(row, count=count, mse=replace(row.mse, estimate=0.03, low=0.02, high=0.05)) for count in counts]
    made = replace(study, scenes=["disk"], rows=rows, fits=[]).plot()
    apart(made.figure_)
    marks = made.ax_.get_xticks()
    assert len(marks) >= min(len(counts), 2)
    assert all(counts[0] <= mark <= counts[-1] for mark in marks)


@pytest.mark.parametrize("spread", [0.0, 1e-3, 0.1, 1.0, 8.0, 1e6])
def test_numbers_along_axes_of_any_length_can_be_read(study, apart, spread):
    rows = [
        replace(
            row,
            time=Interval(2.15e-5 * (1.0 + spread * place)),
            mse=replace(row.mse, estimate=3e-7 * (1.0 + spread * place), low=None, high=None),
        )
        for place, row in enumerate(row for row in study.rows if row.scene == "disk" and row.sampler == "random")
    ]
    made = replace(study, scenes=["disk"], rows=rows, fits=[]).plot(against="time")
    apart(made.figure_)
    for low, high in (made.ax_.get_xlim(), made.ax_.get_ylim()):
        assert sum(low <= 10.0**power <= high for power in range(-20, 20)) >= 2


def test_many_samplers_with_long_names(study, apart):
    rows = [row for row in study.rows if row.scene == "disk" and row.sampler == "random"]
    names = [f"sampler:number={number},path=$a_{number}$" for number in range(30)]
    many = replace(
        study,
        scenes=["disk"],
        samplers=names,
        rows=[replace(row, sampler=name) for name in names for row in rows],
        fits=[],
    )
    display = many.plot()
    apart(display.figure_)
    assert len(display.ax_.get_legend().get_texts()) == 30


def test_the_scene_is_chosen_where_there_are_several(study):
    with pytest.raises(UsageError, match="choose the scene of the plot: disk, gaussian"):
        study.plot()
    with pytest.raises(UsageError, match="no scene checker: it has disk, gaussian"):
        study.plot("checker")
    with pytest.raises(UsageError, match="expected samples or time"):
        study.plot("disk", against="count")


def test_errors_of_zero_are_left_out(study):
    found = samplekit.compare(["random", "regular"], "bilinear", [4, 16], trials=4, size=(1, 1), times=False)
    assert {row.sampler for row in StudyDisplay(found).rows} <= {"random", "regular"}
    nothing = replace(found, rows=[replace(row, mse=replace(row.mse, estimate=0.0)) for row in found.rows])
    assert StudyDisplay(nothing).rows == []
    with pytest.raises(UsageError, match="no error is above 0"):
        nothing.plot()
    with pytest.raises(UsageError, match="no times were taken"):
        found.plot(against="time")


def test_on_axes_of_the_caller(study):
    ax = Figure().subplots()
    display = study.plot("disk", ax=ax)
    assert display.ax_ is ax
    assert not display.figure_.texts
