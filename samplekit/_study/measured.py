"""What was measured, as plain data: intervals, times, and the row of a scene, sampler and count."""

from __future__ import annotations

from dataclasses import dataclass

LEVEL = 0.95
"""Of all intervals."""


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
        Pixels of all trials whose error or its square was not finite; they are left out of the errors.
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
