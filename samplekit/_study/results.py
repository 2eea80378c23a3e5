"""The results of a study as plain data: what ``samplekit.compare`` returns and ``results.json`` holds.

Seconds are those of one trial: of one estimate of the unit square, or of one image. All intervals are 95 % intervals.

Numbers that follow from several others, such as the samples to a target, have intervals too. Where an end of an
interval is None, the study does not bound the number on that side.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from samplekit.plots import StudyDisplay

SCHEMA = "samplekit.study/2"
LEVEL = 0.95
"""Confidence level of all intervals."""


@dataclass(frozen=True)
class Interval:
    """An estimate with its 95 % confidence interval: of errors over trials, of times over rounds.

    Attributes
    ----------
    estimate
        None if nothing was measured, if the value is not finite, or if only a bound is known.
    low, high
        Ends of the interval. An end that is None is open: nothing is known on that side. Both are the estimate itself
        where nothing is random.
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
class Seconds:
    """Seconds by the processor's clock and by the wall clock."""

    cpu: Spread
    wall: Spread


@dataclass(frozen=True)
class Times:
    """Seconds that one trial takes on one thread.

    Attributes
    ----------
    points, scene, total
        Drawing the samples, evaluating them, and both.
    setup_cpu, setup_wall
        Seconds spent once, before the first sample: making tables and banks of sets, compiling kernels or loading them.
    laps
        Number of repetitions; those of different combinations take turns.
    rounds
        Number of rounds, apart in time, in which the laps were taken.
    seconds
        Processor seconds of points and scene together, for comparing the rows of a study: what slowed all rows of a
        round alike is taken out. The interval is over rounds, and there is none from fewer than six.
    """

    points: Seconds
    scene: Seconds
    total: Seconds
    setup_cpu: float
    setup_wall: float
    laps: int
    rounds: int
    seconds: Interval


@dataclass(frozen=True)
class Pictures:
    """The image files of a row's first trial; paths are relative to ``results.json``.

    Attributes
    ----------
    exr
        File with the parts image, reference and error in float32.
    png, error_png
        The image, and its error in false colour.
    error_scale
        The error that has the strongest colour in ``error_png``.
    """

    exr: str
    png: str
    error_png: str
    error_scale: float


@dataclass(frozen=True)
class Row:
    """The results for a scene, a sampler and a count.

    Attributes
    ----------
    scene, sampler
        Texts as on the command line.
    count, asked
        Number of samples per pixel, and the requested counts that led to it: ``[count]``, or others if the sampler
        cannot make them and this is the nearest count below.
    replaced
        Why ``asked`` holds other counts; empty if it does not.
    dims, samples
        Dimensions of a sample; number of samples of one trial, over all pixels that are sampled.
    trials
        Number of independent realisations behind the errors. If it is smaller than requested, ``notes`` says why.
    shared_draw
        Whether the rows of this sampler come from the same draws: each set is the beginning of the next larger one, so
        that their errors go together.
    no_interval
        Why errors have no interval; empty if they have. ``"no hits"``: all trials gave one value, and it is not the
        mean of the scene. ``"few hits"``: too few trials found what makes up the error. ``"infinite variance"``
        or ``"heavy tails"``: the scene says that its square, or its fourth power, has no finite integral.
        ``"few trials"``: one, or fewer than 32 estimates of pixels that are not constant. No fit uses such rows. The
        answers use the estimates of the last kind, and of the others at most the bound ``mse.high``.
    mse, rmse
        Mean over trials and pixels of the squared error, and its square root. Without hits there is no estimate, and
        ``high`` is a one-sided 95 % bound if the scene declares the range of its values.
    bias
        Mean over trials and pixels of the signed error.
    variance
        Mean over pixels of the variance between trials. The interval is that of ``mse`` if the sampler is unbiased.
    squared_bias
        mse - variance, which estimates the mean over pixels of the square of each pixel's own bias. It may come out
        below 0 if there is no bias. Images have an interval from 8 trials on.
    blurred_mse
        Mean square of the error after a Gaussian blur of 2 pixels; None for one pixel.
    efficiency
        1 / (mse x ``time``).
    ratio
        mse relative to that of the first sampler at the same count, None if there is none. Both use the same seeds, and
        where that makes their errors go together the interval is narrower.
    reference_error, reference_kind
        Largest possible error of the reference in any pixel, 0 if it is exact; how it was computed, in words.
    invalid_pixels
        Number of pixels of all trials whose error or its square was not finite; they are left out of the errors.
    times
        Measured times; None if none were measured.
    time
        Seconds of a trial that the answers use: ``times.seconds``, plus the extra cost per sample. None without
        ``times``.
    fitted, left_out
        Whether the fit uses this row, and why not.
    notes
        Remarks on the row, each in a sentence: an error of exactly zero, an error below that of the reference,
        sets from a bank, ...
    pictures
        Image files of the first trial; None for one pixel.
    """

    scene: str
    sampler: str
    count: int
    asked: list[int]
    replaced: str
    dims: int
    samples: int
    trials: int
    shared_draw: bool
    no_interval: str
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
    time: Interval | None
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
        The exponent. Its interval allows for the scatter about the line as well as for that between trials.
    constant
        The line's mse at one sample; None if it is beyond the largest float.
    scatter
        Relative standard deviation of the rows about the line that the trials do not explain; 0 if they explain it all.
    first, last
        Range of the counts, both included.
    counts, left_out
        Counts of the rows that were used; counts of the other rows, each with the reason.
    case, theory
        ``"worst"`` or ``"best"`` if theory has an exponent for this scene, and the exponent of this sampler.
    """

    scene: str
    sampler: str
    slope: Interval
    constant: float | None
    scatter: float
    first: int
    last: int
    counts: list[int]
    left_out: dict[int, str]
    case: str | None
    theory: float | None

    @property
    def falls(self) -> bool:
        """Whether the rows show that the error falls: the slope has an interval, and it lies below 0."""
        return self.slope.high is not None and self.slope.high < 0.0


@dataclass(frozen=True)
class ToTarget:
    """What a sampler needs to reach the target error on a scene.

    Attributes
    ----------
    target
        The mean squared error to reach.
    count, seconds
        Number of samples and seconds, interpolated between two rows in their logarithms. The estimate is None if it
        lies outside of the measured counts. ``low`` None: perhaps fewer than the smallest count; ``high`` None: perhaps
        more than the largest.
    """

    scene: str
    sampler: str
    target: float
    count: Interval
    seconds: Interval


@dataclass(frozen=True)
class Choice:
    """The samplers that may have the smallest error on a scene, for a range of time budgets.

    Attributes
    ----------
    samplers
        The best one; or several that the intervals of their errors and times cannot tell apart.
    seconds, until
        The range of budgets for one trial; ``until`` None: without end.
    """

    scene: str
    samplers: list[str]
    seconds: float
    until: float | None


@dataclass(frozen=True)
class Flip:
    """A cost per sample at which two samplers change places in the time that they need to reach the target error.

    Only samplers whose samples and seconds the intervals tell apart have one.

    Attributes
    ----------
    cost
        Extra cost per sample in nanoseconds.
    below, above
        The sampler that needs less time at smaller costs, and the one that needs less at larger costs.
    leads
        Whether no other sampler is certainly faster at this cost.
    """

    scene: str
    target: float
    cost: Interval
    below: str
    above: str
    leads: bool


@dataclass(frozen=True)
class Lead:
    """A range of counts, both included, at each of which the sampler has the smaller error beyond both intervals."""

    sampler: str
    first: int
    last: int


@dataclass(frozen=True)
class Crossing:
    """Two samplers of which one has the smaller error at some counts, and the other at others.

    Attributes
    ----------
    samplers
        The two.
    leads
        Where either has the smaller error, counts rising. At counts between these ranges the intervals overlap.
    """

    scene: str
    samplers: tuple[str, str]
    leads: list[Lead]


@dataclass(frozen=True)
class LeftOut:
    """A requested scene and sampler, or one of their counts, without a row, and the reason."""

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
        The command that makes the study again.
    versions, machine
        Versions of samplekit, Python and the libraries; ``system``, ``processor``, ``processors`` and ``memory`` of the
        machine on which times were measured.
    scenes, samplers, counts, trials, size, seed
        The request.
    workers
        What computed the errors, in words; no error depends on it. Times are those of one thread of ``machine``.
    cost
        Extra cost per sample, in nanoseconds.
    target
        For each scene the mean squared error of ``to_target`` and ``flips``: the requested one, or the smallest
        that all samplers with intervals certainly reach, rounded up to two digits.
    complete
        False if the study was interrupted and some rows have fewer trials.
    rows
        Scene by scene, sampler by sampler, counts rising.
    fits, to_target, front, flips, left_out, crossings
        The answers, scene by scene.
    notes
        What a reader should know about the whole study.
    sentences
        The answers in words: for each scene, and for each sampler on it.
    plots
        Files relative to ``results.json``.

    Examples
    --------
    >>> import samplekit
    >>> results = samplekit.compare("random", "disk", [4, 16], trials=8, size=(1, 1), times=False)
    >>> [row.count for row in results.rows]
    [4, 16]
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
    notes: list[str]
    sentences: list[str] = field(default_factory=list)
    plots: list[str] = field(default_factory=list)
    crossings: list[Crossing] = field(default_factory=list)

    def as_json(self) -> dict[str, Any]:
        """Return the object that ``samplekit compare --json`` prints; the seed has 64 bits and is a text."""
        return {"schema": SCHEMA, "level": LEVEL, **asdict(self), "seed": str(self.seed)}

    def plot(
        self, scene: str | None = None, *, against: Literal["samples", "time"] = "samples", ax: Axes | None = None
    ) -> StudyDisplay:
        """Draw the mean squared error on one scene, a curve for each sampler.

        Parameters
        ----------
        scene
            One of ``scenes``; None: the only one.
        against
            ``"samples"``: the number of samples per pixel; ``"time"``: the seconds of one trial.
        ax
            The axes of matplotlib to draw on; None: a new figure.

        Returns
        -------
        samplekit.plots.StudyDisplay

        Raises
        ------
        UsageError
            The scene is not in the study, or none is given and there are several; or there is nothing to draw.
        """
        from samplekit.plots import StudyDisplay

        return StudyDisplay(self, scene, against).plot(ax)
