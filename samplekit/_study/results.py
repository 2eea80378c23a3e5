"""What a study found, as plain data: what ``samplekit.compare`` returns and ``results.json`` holds.

Seconds are those of one trial: one estimate of the unit square, or one image. Every interval is one of 95 %.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from samplekit._errors import UsageError
from samplekit._study.answers import Choice, Crossing, Fit, Flip, LeftOut, ToTarget
from samplekit._study.measured import LEVEL, Clock, Interval, Pictures, Row, Spread, Times
from samplekit._study.plain_data import from_plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from samplekit.plots import StudyDisplay

SCHEMA = "samplekit.study/1"

__all__ = [
    "LEVEL",
    "SCHEMA",
    "Choice",
    "Clock",
    "Crossing",
    "Fit",
    "Flip",
    "Interval",
    "LeftOut",
    "Pictures",
    "Results",
    "Row",
    "Spread",
    "Times",
    "ToTarget",
    "from_json",
    "to_json",
]


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
    crossings
        Scene by scene, the lowest count first.

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

    def plot(
        self, scene: str | None = None, *, against: Literal["samples", "time"] = "samples", ax: Axes | None = None
    ) -> StudyDisplay:
        """Draw the mean squared error on one scene, a curve for each sampler.

        Parameters
        ----------
        scene
            One of ``scenes``; None: the only one.
        against
            ``"samples"`` of a pixel, or ``"time"``: the seconds of one trial.
        ax
            The axes of matplotlib to draw on; None: a new figure.

        Returns
        -------
        samplekit.plots.StudyDisplay

        Raises
        ------
        UsageError
            A scene that is not in the study, or none where there are several; there is nothing to draw.
        """
        from samplekit.plots import StudyDisplay

        return StudyDisplay(self, scene, against).plot(ax)


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
