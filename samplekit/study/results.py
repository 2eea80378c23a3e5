"""What a study found, as plain data: what ``samplekit.compare`` returns and ``results.json`` holds.

Seconds are those of one trial: one estimate of the unit square, or one image. Every interval is one of 95 %.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from typing import Any

from samplekit.errors import UsageError
from samplekit.study.plain_data import from_plain

SCHEMA = "samplekit.study/1"
LEVEL = 0.95


@dataclass(frozen=True)
class Interval:
    """An estimate with its 95 % confidence interval over trials.

    ``low`` and ``high`` are None where there is none: a single trial, or a sampler that is not random. ``estimate`` is
    None where nothing was measured, or the value is not finite.
    """

    estimate: float | None
    low: float | None = None
    high: float | None = None


@dataclass(frozen=True)
class Spread:
    """Median and quartiles of repeated measurements."""

    median: float
    lower: float
    upper: float


@dataclass(frozen=True)
class Clock:
    """Seconds of the processor and by the wall clock."""

    cpu: Spread
    wall: Spread


@dataclass(frozen=True)
class Times:
    """Seconds that one trial takes on one thread, over ``laps`` interleaved repetitions.

    ``points`` draws the samples, ``scene`` evaluates them, ``total`` is both. ``setup_cpu`` and ``setup_wall`` are
    spent once, before the first sample: tables, banks of sets, compilation or the loading of what was compiled before.
    """

    points: Clock
    scene: Clock
    total: Clock
    setup_cpu: float
    setup_wall: float
    laps: int


@dataclass(frozen=True)
class Pictures:
    """Files of a row's first trial, relative to ``results.json``, and the factor between error and false colour.

    ``exr`` holds the parts image, reference and error in float32; ``error_scale`` is the error that has the strongest
    colour in ``error_png``.
    """

    exr: str
    png: str
    error_png: str
    error_scale: float


@dataclass(frozen=True)
class Row:
    """A scene, a sampler and a count.

    Attributes
    ----------
    scene, sampler
        As on the command line.
    count, asked
        Samples of a pixel; the counts that were asked for and led to this row: ``[count]``, or others where the sampler
        makes none such and this is the nearest below.
    replaced
        Why ``asked`` holds others; empty where it does not.
    dims, samples
        Dimensions of a sample; samples of one trial, over all pixels that are sampled.
    trials
        Independent realisations behind the errors: fewer than were asked for where ``notes`` says why.
    mse, rmse
        Mean over trials and pixels of the squared error, and its square root.
    bias
        Mean over trials and pixels of the signed error.
    variance
        Mean over pixels of the variance between trials.
    squared_bias
        mse - variance, estimated without bias: mean over pixels of the square of each pixel's own bias. May come out
        below 0 where there is none.
    blurred_mse
        Mean square of the error after a Gaussian blur of 2 pixels; None for one pixel.
    efficiency
        1 / (mse x ``time``).
    ratio
        mse over that of the first sampler at the same count, None where there is none: with seeds paired where that
        narrows the interval.
    reference_error, reference_kind
        Bound of the reference's error in any pixel, 0: exact; in words.
    invalid_pixels
        Pixels of all trials whose estimate was not finite; they are left out of the errors.
    times
        None where none were taken.
    time
        Seconds of a trial that the answers reckon with: the median processor time of ``times.total``, and the stated
        cost for each sample. None without ``times``.
    fitted, left_out
        Whether the fit uses this row, and why not.
    notes
        What a reader should know, a sentence each: exact zero, below the reference's error, sets from a bank, ...
    pictures
        None for one pixel.
    """

    scene: str
    sampler: str
    count: int
    asked: list[int]
    replaced: str
    dims: int
    samples: int
    trials: int
    mse: Interval
    rmse: Interval
    bias: Interval
    variance: Interval
    squared_bias: Interval
    blurred_mse: Interval | None
    efficiency: Interval | None
    ratio: Interval | None
    reference_error: float
    reference_kind: str
    invalid_pixels: int
    times: Times | None
    time: float | None
    fitted: bool
    left_out: str
    notes: list[str]
    pictures: Pictures | None


@dataclass(frozen=True)
class Fit:
    """The law mse = constant x count^slope of a sampler on a scene.

    Attributes
    ----------
    slope
        With its interval, which counts the scatter about the line as well as that between trials.
    constant
        mse of the line at one sample.
    scatter
        Relative standard deviation of the rows about the line that trials do not explain; 0: they explain it.
    first, last
        The range of counts, ends included.
    counts, left_out
        Counts of the rows that were used; of those that were not, with the reason.
    case, theory
        ``"worst"`` or ``"best"`` where the course's table has an exponent for this sampler and scene, and it.
    """

    scene: str
    sampler: str
    slope: Interval
    constant: float
    scatter: float
    first: int
    last: int
    counts: list[int]
    left_out: dict[int, str]
    case: str | None
    theory: float | None


@dataclass(frozen=True)
class ToTarget:
    """What a sampler needs for the target error on a scene, None where it does not get there within what was measured.

    Between two rows count, error and time are interpolated in their logarithms.
    """

    scene: str
    sampler: str
    target: float
    count: float | None
    seconds: float | None
    note: str


@dataclass(frozen=True)
class Choice:
    """The least error on a scene for a budget of ``seconds`` (of one trial) up to ``until`` (None: without end)."""

    scene: str
    sampler: str
    count: int
    mse: float
    seconds: float
    until: float | None


@dataclass(frozen=True)
class Flip:
    """A cost of a sample at which two samplers change places in the time that they need for the target error.

    Below ``cost`` (in nanoseconds) ``below`` needs less time, above it ``above``. ``leads``: of all samplers, these two
    need the least there.
    """

    scene: str
    target: float
    cost: float
    below: str
    above: str
    leads: bool


@dataclass(frozen=True)
class LeftOut:
    """A scene and sampler, or one count of theirs, that there is no row for, and why."""

    scene: str
    sampler: str
    count: int | None
    reason: str


@dataclass(frozen=True)
class Results:
    """A whole study.

    Attributes
    ----------
    command
        That makes it again.
    versions, machine
        Of samplekit, Python and libraries; ``system``, ``processor``, ``processors``, ``memory`` of where times were
        taken.
    scenes, samplers, counts, trials, size, seed
        What was asked for.
    workers
        What computed the errors, which do not depend on it; times are those of one thread of ``machine``.
    cost
        Nanoseconds that were added for each sample.
    target
        The error of ``to_target`` and ``flips`` for each scene: the one that was asked for, or the largest that some
        sampler is left with at its largest count, so that all get there.
    complete
        False: interrupted, and some rows have fewer trials.
    rows
        Scene by scene, sampler by sampler, count rising.
    sentences
        One for each scene and sampler, and one for each scene on the whole.
    plots
        Files relative to ``results.json``.
    """

    command: str
    versions: dict[str, str]
    machine: dict[str, str]
    scenes: list[str]
    samplers: list[str]
    counts: list[int]
    trials: int
    size: tuple[int, int]
    seed: int
    workers: str
    cost: float
    target: dict[str, float]
    complete: bool
    rows: list[Row]
    fits: list[Fit]
    to_target: list[ToTarget]
    front: list[Choice]
    flips: list[Flip]
    left_out: list[LeftOut]
    sentences: list[str]
    notes: list[str]
    plots: list[str] = field(default_factory=list)


def to_json(results: Results) -> str:
    """The results as one JSON object, without NaN and infinity; the seed is text, since it has 64 bits."""
    plain: dict[str, Any] = {"schema": SCHEMA, "level": LEVEL, **asdict(results)}
    plain["seed"] = str(results.seed)
    return json.dumps(plain, allow_nan=False, indent=1)


def from_json(text: str) -> Results:
    """The results that :func:`to_json` wrote.

    Raises
    ------
    UsageError
        It is no such object, or of another version.
    """
    try:
        plain = json.loads(text)
        found = plain.pop("schema", None)
    except (ValueError, AttributeError):
        raise UsageError("these are no results of samplekit compare: expected one JSON object") from None
    if found != SCHEMA:
        raise UsageError(f"these results are of version {found!r}, this samplekit reads {SCHEMA!r}: run the study anew")
    plain.pop("level", None)
    plain["seed"] = int(plain["seed"])
    try:
        return from_plain(Results, plain)
    except (KeyError, TypeError, ValueError) as error:
        raise UsageError(f"these results are damaged: {type(error).__name__}: {error}") from None
