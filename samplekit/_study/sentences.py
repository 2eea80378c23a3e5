"""The answers in words: a sentence for each scene on the whole, and one for each sampler on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from samplekit._study.results import Choice, Crossing, Fit, Flip, ToTarget

_MOST_SPANS = 2
_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def seconds_in_words(seconds: float) -> str:
    """A time with three digits and its unit: ``1.25 ms``."""
    size, unit = next(((size, unit) for size, unit in _UNITS if seconds >= 0.9995 * size), _UNITS[-1])
    return f"{seconds / size:.3g} {unit}"


def sentences(
    target: Mapping[str, float],
    to_target: Sequence[ToTarget],
    front: Sequence[Choice],
    flips: Sequence[Flip],
    fits: Sequence[Fit],
    crossings: Sequence[Crossing],
) -> list[str]:
    """Sentences for each scene that has a target."""
    found: list[str] = []
    for scene, error in target.items():
        own = [need for need in to_target if need.scene == scene]
        choices = [choice for choice in front if choice.scene == scene]
        found.append(_of_scene(scene, error, own, choices, [flip for flip in flips if flip.scene == scene]))
        found += [
            f"{scene}: {crossing.fewer} has the smaller error up to {crossing.last} samples, {crossing.more} from"
            f" {crossing.first} on; their curves cross at about {crossing.count:.0f}."
            for crossing in crossings
            if crossing.scene == scene
        ]
        slopes = {fit.sampler: fit for fit in fits if fit.scene == scene}
        found += [_of_sampler(need, own, choices, slopes.get(need.sampler)) for need in own]
    return found


def _of_scene(
    scene: str, target: float, needs: Sequence[ToTarget], choices: Sequence[Choice], flips: Sequence[Flip]
) -> str:
    reached = [need for need in needs if need.count is not None]
    if not reached:
        return f"{scene}: no sampler reaches an mse of {target:.3g}."
    fewest = min(reached, key=lambda need: need.count or 0.0)
    text = f"{scene}: for an mse of {target:.3g}, {fewest.sampler} needs the fewest samples ({fewest.count:.3g})"
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
        text += f"; the best choices for rising budgets are of {', '.join(names)}"
    return text + "."


def _of_sampler(need: ToTarget, needs: Sequence[ToTarget], choices: Sequence[Choice], fit: Fit | None) -> str:
    text = f"{need.scene}, {need.sampler}: "
    if need.count is None:
        text += need.note
    else:
        text += f"needs {need.count:.3g} samples"
        fastest = min((other.seconds for other in needs if other.seconds is not None), default=None)
        if need.seconds is not None and fastest:
            text += f" and {seconds_in_words(need.seconds)}"
            factor = need.seconds / fastest
            text += ", the least" if factor == 1.0 else f", {factor:.3g} times the least"
    if fit is not None and fit.slope.high is not None and fit.slope.high >= 0.0:
        text += "; how fast its mse falls, these counts do not tell"
    elif fit is not None:
        text += f"; its mse falls as N^{fit.slope.estimate:.2f}"
        if fit.theory is not None:
            text += f" (theory: N^{fit.theory:g})"
    spans = _joined(choices, need.sampler)
    if len(spans) > _MOST_SPANS:
        text += f"; the best choice for budgets in {len(spans)} ranges from {seconds_in_words(spans[0].seconds)} on"
    elif spans:
        written = [
            f"from {seconds_in_words(span.seconds)}"
            + (" on" if span.until is None else f" to {seconds_in_words(span.until)}")
            for span in spans
        ]
        text += f"; the best choice for budgets {', '.join(written)}"
    return text + "."


def _joined(choices: Sequence[Choice], sampler: str) -> list[Choice]:
    """The choices of a sampler, those that follow on each other as one."""
    from dataclasses import replace

    joined: list[Choice] = []
    for previous, choice in zip([None, *choices], choices, strict=False):
        if choice.sampler != sampler:
            continue
        if previous is not None and previous.sampler == sampler and joined:
            joined[-1] = replace(joined[-1], until=choice.until)
        else:
            joined.append(choice)
    return joined
