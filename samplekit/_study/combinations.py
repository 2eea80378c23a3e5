"""The combinations of scene, sampler and count that a study measures, and those that cannot be run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._errors import CountError, UsageError
from samplekit._integrate.plan import check_points
from samplekit._study.results import LeftOut

if TYPE_CHECKING:
    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._configured.scene import ConfiguredScene
    from samplekit._study.request import Request
    from samplekit._study.resources import Resources

_MOST_STEPS = 64


@dataclass(frozen=True)
class Combination:
    """A scene, a sampler and a count: what one row of the results is about.

    Attributes
    ----------
    scene, sampler, count
        Texts of the scene and the sampler, and the number of samples per pixel.
    asked
        The counts of the request that led to ``count``.
    replaced
        Why the sampler cannot make one of ``asked``; empty if ``asked`` is ``count`` alone.
    dims
        Dimensions of a sample.
    trials
        Number of independent realisations.
    notes
        Remarks on the row, each in a sentence.
    shared_draw
        Whether one draw of the largest count has this set as its prefix, so that several counts share it.
    """

    scene: str
    sampler: str
    count: int
    asked: tuple[int, ...]
    replaced: str
    dims: int
    trials: int
    notes: tuple[str, ...]
    shared_draw: bool

    @property
    def pair(self) -> tuple[str, str]:
        """Scene and sampler."""
        return self.scene, self.sampler


def list_combinations(request: Request, resources: Resources) -> tuple[list[Combination], list[LeftOut]]:
    """List the combinations of a study, and the requested ones that cannot be run.

    A count that a sampler cannot make is replaced by the nearest one below.

    Returns
    -------
    combinations
        Scene by scene, sampler by sampler, counts rising.
    left_out
        The scenes, samplers and counts without a combination, and the reason.

    Raises
    ------
    UsageError
        Nothing can be run; the message is the first reason.
    """
    combinations: list[Combination] = []
    left_out: list[LeftOut] = []
    for scene_text in request.scenes:
        for sampler_text in request.samplers:
            scene, sampler = resources.scene(scene_text), resources.sampler(sampler_text)
            found: dict[int, list[int]] = {}
            reasons: dict[int, str] = {}
            for asked in request.counts:
                count, reason = _nearest_count(scene, sampler, asked)
                if count is None:
                    left_out.append(LeftOut(scene_text, sampler_text, asked, reason))
                else:
                    found.setdefault(count, []).append(asked)
                    reasons[count] = reasons.get(count) or reason
            for count, counts in sorted(found.items()):
                combinations.append(_combination(request, scene, sampler, count, tuple(counts), reasons[count]))
    if not combinations:
        raise UsageError(left_out[0].reason)
    return combinations, left_out


def _nearest_count(scene: ConfiguredScene, sampler: ConfiguredSampler, asked: int) -> tuple[int | None, str]:
    """Return the largest possible count up to ``asked``, None if there is none, and why ``asked`` is not possible."""
    reason, count = "", asked
    for _ in range(_MOST_STEPS):
        try:
            check_points(scene, sampler, count)
            return count, reason
        except UsageError as error:
            reason = reason or str(error)
            if not isinstance(error, CountError) or error.below is None:
                # Fewer points do not help: the fault lies elsewhere, or there is no count below.
                break
            count = error.below
    return None, reason


def _combination(
    request: Request,
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    asked: tuple[int, ...],
    replaced: str,
) -> Combination:
    notes = list(sampler.notes(count, scene.dims))
    trials = request.trials
    spec = sampler.spec
    if not spec.randomized:
        trials = 1
        notes.append("not random: every trial is the same, so one was made, and its errors are exact")
    elif request.one_pixel and spec.period is not None and spec.period < trials:
        trials = spec.period
        notes.append(f"has only {spec.period} sets, so only {spec.period} trials were made")
    if not spec.unbiased:
        notes.append("biased: its mean over realisations need not be the integral")
    return Combination(
        scene.text,
        sampler.text,
        count,
        asked,
        replaced,
        scene.dims,
        trials,
        tuple(notes),
        spec.progressive is not None and spec.progressive.allows(count, scene.dims),
    )
