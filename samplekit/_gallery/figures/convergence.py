"""How the error falls: the course's convergence plots and its table, and error against time."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import samplekit
from samplekit._drawing.drawing import Drawing, Text
from samplekit._gallery.figure import Figure
from samplekit._study.plots import plots_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.results import Results

CHAPTER = "Convergence"
_COURSE = ("random", "jittered", "poisson-disk", "ccvt")
_MORE = ("random", "jittered", "latin-hypercube", "correlated-multi-jittered", "halton+owen", "sobol+owen", "pmj02")
_PLATE = "zoneplate:k=100"
_BLUENOISE = ("samplekit-bluenoise",)


def _command(samplers: Sequence[str], scenes: Sequence[str], rest: str) -> str:
    names = [f"-s {name}" for name in samplers] + [f"--scene {scene}" for scene in scenes]
    return f"samplekit compare {' '.join(names)} {rest}"


@functools.cache
def _course() -> Results:
    return samplekit.compare(
        list(_COURSE), ["disk", "gaussian"], [2**m for m in range(4, 10)], trials=400, size=(1, 1), times=False
    )


@functools.cache
def _more() -> Results:
    return samplekit.compare(
        list(_MORE), ["disk", "gaussian"], [2**m for m in range(2, 13)], trials=1000, size=(1, 1), times=False
    )


def crossing() -> Drawing:
    """Poisson disk and jitter alone, over more counts."""
    counts = [4**m for m in range(1, 7)]
    found = samplekit.compare(["jittered", "poisson-disk"], "gaussian", counts, trials=400, size=(1, 1), times=False)
    return plots_of(found)["gaussian.error-against-count"]


def error_against_time() -> Drawing:
    """A zone plate as an image, against the seconds that it takes."""
    counts = [4**m for m in range(1, 6)]
    found = samplekit.compare([*_MORE, "poisson-disk"], _PLATE, counts, trials=4, size=(64, 64), budget=20.0)
    (plot,) = (plot for name, plot in plots_of(found).items() if name.endswith("error-against-time"))
    return plot


def table() -> Drawing:
    """The course's table: exponents as theory has them, and as they are measured."""
    fits = {(fit.sampler.partition(":")[0], fit.scene): fit for fit in _course().fits}
    drawing = Drawing(740, 116 + 34 * len(_COURSE), "Exponents of the mean squared error")
    drawing.add(Text(drawing.title, 24, 32, 17))
    columns = (("disk", 170, 270), ("gaussian", 460, 560))
    for scene, left, right in columns:
        drawing.add(Text(f"{scene}: theory", left, 66, 12), Text("measured, 95 %", right, 66, 12))
    for number, sampler in enumerate(_COURSE):
        y = 96 + 34 * number
        drawing.segment(24, y - 22, 716, y - 22, "#e3e6eb")
        drawing.add(Text(sampler, 24, y, 14))
        for scene, left, right in columns:
            fit = fits[sampler, scene]
            drawing.add(Text(f"{fit.theory:g}", left, y, 14), Text(_interval(fit.slope), right, y, 14))
    drawing.add(Text("N = 16 to 512, 400 trials", 24, drawing.height - 14, 12, "left", "#6b7480"))
    return drawing


def _interval(slope: object) -> str:
    estimate, low, high = (getattr(slope, name) for name in ("estimate", "low", "high"))
    return f"{estimate:.2f}  ({low:.2f} to {high:.2f})"


_COUNTS = "--spp 2^4..2^9 --trials 400 --size 1 --no-time"
FIGURES = [
    Figure(
        "convergence-disk",
        "Convergence on the disk",
        "The worst case. Stratified samplers fall as N^-1.5, random ones as N^-1.",
        _command(_MORE, ["disk"], "--spp 2^2..2^12 --trials 1000 --size 1 --no-time"),
        lambda: plots_of(_more())["disk.error-against-count"],
        chapter=CHAPTER,
    ),
    Figure(
        "convergence-gaussian",
        "Convergence on a Gaussian",
        "The best case. Jitter falls as N^-2; correlated multi-jitter and scrambled nets as N^-3 and nearly so.",
        _command(_MORE, ["gaussian"], "--spp 2^2..2^12 --trials 1000 --size 1 --no-time"),
        lambda: plots_of(_more())["gaussian.error-against-count"],
        chapter=CHAPTER,
    ),
    Figure(
        "course-table",
        "The course's table",
        "Poisson disk's slope on the disk is steeper than its asymptotic -1: its low plateau is reached late.",
        _command(_COURSE, ["disk", "gaussian"], _COUNTS),
        table,
        _BLUENOISE,
        CHAPTER,
    ),
    Figure(
        "poisson-disk-and-jitter",
        "Poisson disk against jitter",
        "On a Gaussian, Poisson disk is ahead at low counts, jitter at high ones.",
        _command(["jittered", "poisson-disk"], ["gaussian"], "--spp 4^1..4^6 --trials 400 --size 1 --no-time"),
        crossing,
        _BLUENOISE,
        CHAPTER,
    ),
    Figure(
        "error-against-time",
        "Error against time",
        "The scene costs next to nothing here, so what a sampler's points cost matters: `--cost` adds a renderer's.",
        _command([*_MORE, "poisson-disk"], [_PLATE], "--spp 4^1..4^5 --trials 4 --size 64 --budget 20"),
        error_against_time,
        _BLUENOISE,
        CHAPTER,
        measured=True,
    ),
]
