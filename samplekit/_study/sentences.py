"""The answers in words: sentences about each scene, and one about each sampler on it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._study.ranking import may_be_least

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from samplekit._study.results import Choice, Crossing, Fit, Flip, Interval, Results, ToTarget

_MOST_BUDGETS = 6
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
    for scene, target in results.target.items():
        needs = [need for need in results.to_target if need.scene == scene]
        choices = [choice for choice in results.front if choice.scene == scene]
        flips = [flip for flip in results.flips if flip.scene == scene and flip.leads]
        texts = [_least_text(target, needs), *map(_flip_text, flips)]
        texts += [_budgets_text(choices)] if choices else []
        texts += [_crossing_text(crossing) for crossing in results.crossings if crossing.scene == scene]
        found += [Statement(scene, None, f"{text}.") for text in texts]
        slopes = {fit.sampler: fit for fit in results.fits if fit.scene == scene}
        found += [Statement(scene, need.sampler, _sampler_text(need, slopes.get(need.sampler))) for need in needs]
    return found


def _least_text(target: float, needs: Sequence[ToTarget]) -> str:
    found: dict[str, list[str]] = {}
    for what, numbers in (
        ("the fewest samples", [need.count for need in needs]),
        ("the least time", [need.seconds for need in needs]),
    ):
        may = [need.sampler for need, may in zip(needs, may_be_least(numbers), strict=True) if may]
        if len(may) == 1:
            found.setdefault(f"{may[0]} needs", []).append(what)
        elif may:
            found.setdefault(f"the intervals do not tell which of {listed(may, 'and')} needs", []).append(what)
        elif any(number.estimate is not None for number in numbers):
            found.setdefault("no interval tells which sampler needs", []).append(what)
    texts = [f"{text} {' and '.join(whats)}" for text, whats in found.items()] if len(needs) > 1 else []
    return "; ".join([f"the target is an mse of {target:.3g}", *texts])


def _flip_text(flip: Flip) -> str:
    cost, low, high = flip.cost.estimate or 0.0, flip.cost.low or 0.0, flip.cost.high or 0.0
    return (
        f"from an extra cost of {cost:.3g} ns a sample on ({low:.3g} to {high:.3g}), {flip.above} needs less time"
        f" than {flip.below}"
    )


def _budgets_text(choices: Sequence[Choice]) -> str:
    if len(choices) == 1:
        return f"for every budget of time the best sampler is {listed(choices[0].samplers, 'or')}"
    alone: dict[str, list[str]] = {}
    for choice in choices:
        if len(choice.samplers) == 1:
            alone.setdefault(choice.samplers[0], []).append(_range(choice))
    if not alone:
        return "the intervals tell no best sampler for any budget of time"
    number = sum(map(len, alone.values()))
    untold = "; for other budgets the intervals do not tell" if number < len(choices) else ""
    if number <= _MOST_BUDGETS:
        best = ", ".join(f"{sampler} {listed(ranges, 'and')}" for sampler, ranges in alone.items())
        return f"the best sampler for a budget of time is {best}{untold}"
    if len(alone) == 1:
        return f"for some budgets of time the best sampler is {next(iter(alone))}{untold}"
    return f"the best sampler changes with the budget of time among {listed(list(alone), 'and')}{untold}"


def _range(choice: Choice) -> str:
    until = "on" if choice.until is None else f"to {seconds_in_words(choice.until)}"
    return f"from {seconds_in_words(choice.seconds)} {until}"


def _crossing_text(crossing: Crossing) -> str:
    parts = []
    for sampler in crossing.samplers:
        ranges = [
            f"at {lead.first}" if lead.first == lead.last else f"from {lead.first} to {lead.last}"
            for lead in crossing.leads
            if lead.sampler == sampler
        ]
        samples = "sample" if ranges[-1] == "at 1" else "samples"
        parts.append(f"{sampler} has the smaller error {listed(ranges, 'and')} {samples}")
    return ", ".join(parts)


def _sampler_text(need: ToTarget, fit: Fit | None) -> str:
    text = _samples_in_words(need.count)
    if need.count.estimate is not None and need.seconds.estimate is not None:
        text += f" and {seconds_in_words(need.seconds.estimate)}{_ends(need.seconds, seconds_in_words)}"
    if fit is not None and not fit.falls:
        text += "; these counts do not tell how fast its mse falls"
    elif fit is not None:
        theory = "" if fit.theory is None else f"; theory: N^{fit.theory:g}"
        text += f"; its mse falls as N^{fit.slope.estimate:.2f} ({fit.slope.low:.2f} to {fit.slope.high:.2f}{theory})"
    return text + "."


def _samples_in_words(count: Interval) -> str:
    """Return what a sampler needs: the estimate and its interval, or the bound that is known."""
    if count.estimate is not None:
        return f"needs {_samples(count.estimate)}{_ends(count, _number)}"
    if count.low is not None and count.high is not None:
        return f"needs between {_number(count.low)} and {_samples(count.high)}"
    if count.high is not None:
        return f"needs at most {_samples(count.high)}"
    if count.low is not None:
        return f"needs more than {_samples(count.low)}"
    return "these rows do not tell how many samples it needs"


def _ends(interval: Interval, write: Callable[[float], str]) -> str:
    """Return the interval in brackets; empty if it is one number."""
    low, high = interval.low, interval.high
    if low is not None and high is not None:
        return "" if low == high else f" ({write(low)} to {write(high)})"
    if high is not None:
        return f" (at most {write(high)})"
    return " (without an interval)" if low is None else f" (at least {write(low)})"


def _samples(number: float) -> str:
    """Return a number of samples, such as ``1 sample`` or ``16 samples``."""
    return f"{_number(number)} sample{'' if _number(number) == '1' else 's'}"


def _number(value: float) -> str:
    """Return a number with three digits, or all digits before the point."""
    return f"{value:.3g}" if value < 1000.0 else f"{value:.0f}"


def listed(names: Sequence[str], word: str) -> str:
    """Return names with commas, and a word before the last."""
    return f" {word} ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)
