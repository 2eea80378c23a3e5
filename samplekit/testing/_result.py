"""What a check says: passed, failed with the smallest counter-example, not applicable and why, expected to fail."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

Status = Literal["passed", "failed", "not applicable", "expected failure", "unexpected pass"]
STATUSES: tuple[Status, ...] = ("passed", "failed", "not applicable", "expected failure", "unexpected pass")
BROKEN: tuple[Status, ...] = ("failed", "unexpected pass")
"""The statuses that make a run fail: a failure that was declared and does not happen is one of them."""

_POINTS_SHOWN = 4


@dataclass(frozen=True, eq=False)
class CounterExample:
    """The smallest request that shows a property broken.

    Attributes
    ----------
    sampler
        As on the command line, with its options.
    count, dims, seed
        The request.
    realization
        Number of the realisation; for one that is given by a pixel, ``(x, y)``.
    indices, coordinates
        The points that break the property: their indices in the set, and float64[k, D].
    axes
        The dimensions that matter.
    box
        Low and high edge along each of ``axes`` of the cell that holds too many points or too few.
    points
        The whole set, float64[N, D], for a picture; None where it is too large or the failure is not of one set.
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

    def __str__(self) -> str:
        where = f"sampler {self.sampler}, count {self.count}, dims {self.dims}, seed {self.seed}"
        text = f"{where}, realisation {self.realization}"
        shown = [
            f"point {index}" + (f" at ({', '.join(repr(float(x)) for x in place)})" if place else "")
            for index, place in zip(self.indices, self.coordinates or ((),) * len(self.indices), strict=True)
        ]
        more = f" and {len(shown) - _POINTS_SHOWN} more" if len(shown) > _POINTS_SHOWN else ""
        return text + (f": {'; '.join(shown[:_POINTS_SHOWN])}{more}" if shown else "")

    def as_json(self) -> dict[str, Any]:
        """Plain data; the seed as text, as many JSON readers round integers beyond 2^53."""
        return {
            "sampler": self.sampler,
            "count": self.count,
            "dims": self.dims,
            "seed": str(self.seed),
            "realization": list(self.realization) if isinstance(self.realization, tuple) else self.realization,
            "indices": list(self.indices),
            # NaN is no JSON: a coordinate that was never written is told as text.
            "coordinates": [[x if x == x else "nan" for x in map(float, place)] for place in self.coordinates],
            "axes": list(self.axes),
            "box": [list(edges) for edges in self.box],
        }


class CheckFailed(Exception):  # noqa: N818 - it is a verdict, not an error of the program
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
    """The check finds, while running, that it has nothing to judge; says why."""


@dataclass(frozen=True)
class Check:
    """A check: a plain function with what it requires of a declaration.

    Attributes
    ----------
    name
        Its name in reports and in ``expected_failures``: part of the interface, never changed.
    number
        Its place in the suite, from 1.
    kind
        What it judges.
    summary, tolerance
        One line each, for reports.
    requires
        Gives the reason why the check does not apply to a declaration, or nothing.
    function
        Called with the subject; raises CheckFailed.
    """

    name: str
    number: int
    kind: Literal["sampler", "scene"]
    summary: str
    tolerance: str
    requires: Callable[[Any], str]
    function: Callable[[Any], None]

    def __call__(self, subject: Any) -> None:
        """Judge the subject.

        Raises
        ------
        CheckFailed
            The property does not hold.
        NotApplicable
            There is nothing to judge.
        """
        self.function(subject)


def _applies_to_all(_: Any) -> str:
    return ""


def check(
    name: str,
    number: int,
    *,
    tolerance: str = "exact",
    kind: Literal["sampler", "scene"] = "sampler",
    requires: Callable[[Any], str] = _applies_to_all,
) -> Callable[[Callable[[Any], None]], Check]:
    """Make a function a check; the first line of its docstring is its summary."""

    def decorate(function: Callable[[Any], None]) -> Check:
        # Python drops docstrings if it is asked to (-OO).
        summary = next(iter((function.__doc__ or name).strip().splitlines()))
        return Check(name, number, kind, summary, tolerance, requires, function)

    return decorate


@dataclass
class Outcome:
    """What one check said of one subject."""

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
        """Plain data."""
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


def broken(outcomes: Sequence[Outcome]) -> list[Outcome]:
    """The outcomes that make a run fail."""
    return [outcome for outcome in outcomes if outcome.status in BROKEN]
