"""The answers in words: sentences about each scene, and one about each sampler on it."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from samplekit._study.results import Choice, Fit, Flip, Results, ToTarget

_MOST_RANGES = 2
_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def in_unit(seconds: float) -> tuple[float, str]:
    """Return a time in the largest unit in which it is at least 1, rounded to three digits, and the unit's name."""
    size, unit = next((each for each in _UNITS if seconds >= 0.9995 * each[0]), _UNITS[-1])
    return seconds / size, unit


def seconds_in_words(seconds: float) -> str:
    """Return a time with three digits and its unit, such as ``1.25 ms``."""
    value, unit = in_unit(seconds)
    return f"{value:.3g} {unit}"


@dataclass(frozen=True)
class Statement:
    """A statement about a scene, or about one sampler on it.

    Attributes
    ----------
    scene, sampler
        What it is about; ``sampler`` is None if it is about the scene.
    text
        The rest of the sentence, which does not name them again.
    """

    scene: str
    sampler: str | None
    text: str

    @property
    def sentence(self) -> str:
        """The whole sentence, which begins with the scene and the sampler."""
        return f"{self.scene}, {self.sampler}: {self.text}" if self.sampler else f"{self.scene}: {self.text}"


def statements(results: Results) -> list[Statement]:
    """Return the statements about each scene that has a target: about the scene first, then about each sampler."""
    found: list[Statement] = []
    for scene, error in results.target.items():
        own = [need for need in results.to_target if need.scene == scene]
        choices = [choice for choice in results.front if choice.scene == scene]
        flips = [flip for flip in results.flips if flip.scene == scene]
        found.append(Statement(scene, None, _scene_text(error, own, choices, flips)))
        found += [
            Statement(
                scene,
                None,
                f"{crossing.fewer} has the smaller error up to {crossing.last} samples, {crossing.more} from"
                f" {crossing.first} on; their curves cross at about {crossing.count:.0f}.",
            )
            for crossing in results.crossings
            if crossing.scene == scene
        ]
        slopes = {fit.sampler: fit for fit in results.fits if fit.scene == scene}
        found += [
            Statement(scene, need.sampler, _sampler_text(need, own, choices, slopes.get(need.sampler))) for need in own
        ]
    return found


def _scene_text(target: float, needs: Sequence[ToTarget], choices: Sequence[Choice], flips: Sequence[Flip]) -> str:
    reached = [need for need in needs if need.count is not None]
    if not reached:
        return f"no sampler reaches an mse of {target:.3g}."
    fewest = min(reached, key=lambda need: need.count or 0.0)
    text = f"for an mse of {target:.3g}, {fewest.sampler} needs the fewest samples ({fewest.count:.3g})"
    timed = [need for need in reached if need.seconds is not None]
    if timed:
        fastest = min(timed, key=lambda need: need.seconds or 0.0)
        who = "and" if fastest is fewest else f"and {fastest.sampler}"
        text += f" {who} the least time ({seconds_in_words(fastest.seconds or 0.0)})"
    leading = [flip for flip in flips if flip.leads]
    if leading:
        flip = leading[-1]
        text += f"; from a cost of {flip.cost:.3g} ns a sample {flip.above} is the fastest"
    if choices:
        names = list(dict.fromkeys(choice.sampler for choice in choices))
        text += f"; as the time budget grows, the best samplers are {', '.join(names)}"
    return text + "."


def _sampler_text(need: ToTarget, needs: Sequence[ToTarget], choices: Sequence[Choice], fit: Fit | None) -> str:
    if need.count is None:
        text = need.note
    else:
        text = f"needs {need.count:.3g} samples"
        fastest = min((other.seconds for other in needs if other.seconds is not None), default=None)
        if need.seconds is not None and fastest:
            text += f" and {seconds_in_words(need.seconds)}"
            factor = need.seconds / fastest
            text += ", the least" if factor == 1.0 else f", {factor:.3g} times the least"
    if fit is not None and not fit.falls:
        text += "; these counts do not tell how fast its mse falls"
    elif fit is not None:
        text += f"; its mse falls as N^{fit.slope.estimate:.2f}"
        if fit.theory is not None:
            text += f" (theory: N^{fit.theory:g})"
    own = [run for run in runs(choices) if run[0].sampler == need.sampler]
    if len(own) > _MOST_RANGES:
        text += f"; the best choice for budgets in {len(own)} ranges from {seconds_in_words(own[0][0].seconds)} on"
    elif own:
        written = []
        for run in own:
            until = run[-1].until
            end = " on" if until is None else f" to {seconds_in_words(until)}"
            written.append(f"from {seconds_in_words(run[0].seconds)}{end}")
        text += f"; the best choice for budgets {', '.join(written)}"
    return text + "."


def runs(choices: Iterable[Choice]) -> list[list[Choice]]:
    """Group choices of the same sampler that follow each other: their ranges of budgets join."""
    return [list(run) for _, run in itertools.groupby(choices, key=lambda choice: choice.sampler)]
