"""What the page says first: the sentences about each scene, and the best sampler for each budget of time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._report.wording import counted, number, seconds
from samplekit._study.sentences import runs, statements

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.results import Choice, Results

_OPEN_END = 4.0
"""The last range has no end. Its bar ends at this multiple of its start, or takes a fifth of the strip."""


@dataclass(frozen=True)
class Budget:
    """A range of times in which one sampler is best.

    Attributes
    ----------
    words
        The text about it.
    start, width
        Its place in the strip of all budgets, in percent.
    """

    sampler: str
    words: str
    start: float
    width: float


@dataclass(frozen=True)
class Answer:
    """The answers about a scene.

    Attributes
    ----------
    lead, details
        Sentences about the scene, and about single samplers on it.
    budgets
        The best sampler for each range of times.
    """

    scene: str
    lead: list[str]
    details: list[str]
    budgets: list[Budget]


def answers(results: Results) -> list[Answer]:
    """Return the answers about each scene."""
    found = statements(results)
    return [
        Answer(
            scene,
            [each.text[:1].upper() + each.text[1:] for each in found if each.scene == scene and not each.sampler],
            [f"{each.sampler}: {each.text}" for each in found if each.scene == scene and each.sampler],
            budgets([choice for choice in results.front if choice.scene == scene]),
        )
        for scene in results.scenes
    ]


def budgets(front: Sequence[Choice]) -> list[Budget]:
    """Return a range for each run of choices of the same sampler, on a logarithmic strip of times."""
    if not front or front[0].seconds <= 0.0:
        return []
    begin = math.log(front[0].seconds)
    end = max(math.log(front[-1].seconds * _OPEN_END), begin + 1.25 * (math.log(front[-1].seconds) - begin))
    found = []
    for run in runs(front):
        until = run[-1].until
        left = (math.log(run[0].seconds) - begin) / (end - begin)
        right = 1.0 if until is None else (math.log(until) - begin) / (end - begin)
        found.append(Budget(run[0].sampler, _words(run, until), 100.0 * left, 100.0 * (right - left)))
    return found


def _words(run: Sequence[Choice], until: float | None) -> str:
    first, last = run[0], run[-1]
    time = f"from {seconds(first.seconds, 2)}" + ("" if until is None else f" to {seconds(until, 2)}")
    if first.count == last.count:
        return f"{time}: {first.sampler}, {counted(first.count, 'sample')}, MSE {number(first.mse, 2)}"
    least, most = sorted((first.count, last.count))
    errors = f"MSE {number(first.mse, 2)} to {number(last.mse, 2)}"
    return f"{time}: {first.sampler}, {least} to {counted(most, 'sample')}, {errors}"
