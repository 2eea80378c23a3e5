"""What follows from the rows, as plain data: fits, the price of a target, the best choices, and what is left out."""

from __future__ import annotations

from dataclasses import dataclass

from samplekit._study.measured import Interval  # noqa: TC001 - read back from JSON by its annotation


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
class Crossing:
    """Two samplers of which one has the smaller error at few samples, the other at many, by intervals that are apart.

    ``fewer`` is the better one up to ``last``, ``more`` from ``first`` on; in between, at about ``count``, their curves
    cross.
    """

    scene: str
    fewer: str
    more: str
    last: int
    first: int
    count: float


@dataclass(frozen=True)
class LeftOut:
    """A scene and sampler, or one count of theirs, that there is no row for, and why."""

    scene: str
    sampler: str
    count: int | None
    reason: str
