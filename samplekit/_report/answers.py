"""What the page says first: the sentences about each scene, and the best sampler for each budget of time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._report.wording import seconds
from samplekit._study.sentences import listed, statements

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.results import Choice, Results

_OPEN_END = 4.0
"""The last range has no end. Its bar ends at this multiple of its start, or takes a fifth of the strip."""


@dataclass(frozen=True)
class Budget:
    """A range of times in which one sampler is the best, or one of several that nothing tells apart.

    Attributes
    ----------
    samplers
        Those that may be the best.
    words
        The text about it.
    start, width
        Its place in the strip of all budgets, in percent.
    """

    samplers: list[str]
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
    """Return a range for each choice, on a logarithmic strip of times."""
    if not front or front[0].seconds <= 0.0:
        return []
    begin = math.log(front[0].seconds)
    end = max(math.log(front[-1].seconds * _OPEN_END), begin + 1.25 * (math.log(front[-1].seconds) - begin))
    found = []
    for choice in front:
        left = (math.log(choice.seconds) - begin) / (end - begin)
        right = 1.0 if choice.until is None else (math.log(choice.until) - begin) / (end - begin)
        time = f"from {seconds(choice.seconds, 2)}" + (
            "" if choice.until is None else f" to {seconds(choice.until, 2)}"
        )
        words = f"{time}: {listed(choice.samplers, 'or')}"
        found.append(Budget(choice.samplers, words, 100.0 * left, 100.0 * (right - left)))
    return found
