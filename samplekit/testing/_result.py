"""What a check is, how it reports that a property does not hold, and the outcome of one check."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import zip_longest
from typing import TYPE_CHECKING, Any, Literal, get_args

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import numpy as np
    from numpy.typing import NDArray

Kind = Literal["sampler", "scene"]
Status = Literal["passed", "failed", "not applicable", "expected failure", "unexpected pass"]
STATUSES: tuple[Status, ...] = get_args(Status)
BROKEN: tuple[Status, ...] = ("failed", "unexpected pass")
"""The statuses that make a run fail. A check that is declared to fail, and passes, makes it fail too."""

_POINTS_SHOWN = 4


@dataclass(frozen=True, eq=False)
class CounterExample:
    """The smallest request that shows a broken property.

    Attributes
    ----------
    sampler
        Text of the sampler as on the command line, with its options.
    count, dims, seed
        The request.
    realization
        Number of the realisation; ``(x, y)`` where the realisation is a pixel.
    indices, coordinates
        The points that break the property: their indices in the set, and float64[k, D].
    axes
        The dimensions that matter.
    box
        Low and high edge, along each of ``axes``, of the cell that holds too many points or too few.
    points
        The whole set, or the slice of it that was judged, float64[n, D], for a picture; None if it is too large or if
        the failure is not in one set.
    start
        Index in the set of the first of ``points``.
    """

    sampler: str
    count: int
    dims: int
    seed: int = 0
    realization: int | tuple[int, int] = 0
    indices: tuple[int, ...] = ()
    coordinates: tuple[tuple[float, ...], ...] = ()
    axes: tuple[int, ...] = ()
    box: tuple[tuple[float, float], ...] = ()
    points: NDArray[np.float64] | None = None
    start: int = 0

    def __str__(self) -> str:
        where = f"sampler {self.sampler}, count {self.count}, dims {self.dims}, seed {self.seed}"
        text = f"{where}, realisation {self.realization}"
        shown = [
            f"point {index}" + (f" at ({', '.join(repr(float(x)) for x in place)})" if place else "")
            for index, place in zip_longest(self.indices, self.coordinates)
        ]
        more = f" and {len(shown) - _POINTS_SHOWN} more" if len(shown) > _POINTS_SHOWN else ""
        return text + (f": {'; '.join(shown[:_POINTS_SHOWN])}{more}" if shown else "")

    def as_json(self) -> dict[str, Any]:
        """Return plain data, without the points."""
        data = {name: value for name, value in vars(self).items() if name not in ("points", "start")}
        # Many readers of JSON round integers beyond 2^53, and JSON has no NaN, which a coordinate never written is.
        data["seed"] = str(self.seed)
        data["coordinates"] = [[x if x == x else "nan" for x in map(float, place)] for place in self.coordinates]
        return data


class CheckFailed(Exception):  # noqa: N818 - the sampler is wrong, not the program
    """A property does not hold.

    Parameters
    ----------
    message
        What was expected and what was found, in one line.
    example
        The smallest request that shows it.
    """

    def __init__(self, message: str, example: CounterExample | None = None) -> None:
        super().__init__(f"{message} [{example}]" if example else message)
        self.message = message
        self.example = example


class NotApplicable(Exception):  # noqa: N818
    """A check has nothing to judge; the message says why."""


@dataclass(frozen=True)
class Check:
    """A check: a plain function, with its place in the suite.

    Attributes
    ----------
    name
        Its name in reports and in ``expected_failures``: part of the interface, never changed.
    number
        Its place in the suite, from 1.
    kind
        What it judges: ``"sampler"`` or ``"scene"``.
    summary
        One line for reports.
    function
        Called with the subject. It raises CheckFailed if the property does not hold, and NotApplicable if there is
        nothing to judge.
    """

    name: str
    number: int
    kind: Kind
    summary: str
    function: Callable[[Any], None]


def conformance_check(name: str, number: int, *, kind: Kind = "sampler") -> Callable[[Callable[[Any], None]], Check]:
    """Turn a function into a check; the first line of its docstring is the summary.

    Parameters
    ----------
    name, number, kind
        The attributes of the :class:`Check`.
    """

    def decorate(function: Callable[[Any], None]) -> Check:
        # Python drops docstrings if it is asked to (-OO).
        summary = next(iter((function.__doc__ or name).strip().splitlines()))
        return Check(name, number, kind, summary, function)

    return decorate


@dataclass
class Outcome:
    """What one check found about one subject.

    Attributes
    ----------
    subject, check
        Text of the sampler or scene, and name of the check.
    status
        One of ``"passed"``, ``"failed"``, ``"not applicable"``, ``"expected failure"``, ``"unexpected pass"``.
    message, example
        Why it failed or does not apply, and the smallest request that shows it.
    hints, notes
        Advice that is no failure, and remarks on how the subject was judged.
    seconds, points
        Time that the check took, and points that it drew.
    """

    subject: str
    check: str
    status: Status
    message: str = ""
    example: CounterExample | None = None
    hints: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    seconds: float = 0.0
    points: int = 0

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "subject": self.subject,
            "check": self.check,
            "status": self.status,
            "message": self.message,
            "counter_example": self.example.as_json() if self.example else None,
            "hints": self.hints,
            "notes": self.notes,
            "seconds": round(self.seconds, 3),
            "points": self.points,
        }


def broken(outcomes: Iterable[Outcome]) -> list[Outcome]:
    """Return the outcomes that make a run fail."""
    return [outcome for outcome in outcomes if outcome.status in BROKEN]
