"""List the rows of a study, and the requested combinations that cannot be run."""

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
    from samplekit._study.subjects import Subjects

_MOST_STEPS = 64


@dataclass(frozen=True)
class Cell:
    """A row of a study, before it is measured.

    Attributes
    ----------
    count
        Samples in each pixel.
    asked, replaced
        The requested counts that ``count`` stands for; the reason, if the sampler cannot make one of them.
    shared_draw
        Whether the set is a prefix of the larger sets of the sampler, so that one draw serves all of them.
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


def lay_out(request: Request, subjects: Subjects) -> tuple[list[Cell], list[LeftOut]]:
    """The cells of a study, scene by scene, sampler by sampler, count rising; and what is left out.

    Raises
    ------
    UsageError
        Nothing is left; the message is the first reason.
    """
    cells: list[Cell] = []
    left_out: list[LeftOut] = []
    for scene_text in request.scenes:
        for sampler_text in request.samplers:
            scene, sampler = subjects.scene(scene_text), subjects.sampler(sampler_text)
            found: dict[int, list[int]] = {}
            reasons: dict[int, str] = {}
            for asked in request.counts:
                count, reason = _possible(scene, sampler, asked)
                if count is None:
                    left_out.append(LeftOut(scene_text, sampler_text, asked, reason))
                else:
                    found.setdefault(count, []).append(asked)
                    reasons[count] = reasons.get(count) or reason
            cells += [
                _cell(request, scene, sampler, count, tuple(asked), reasons[count])
                for count, asked in sorted(found.items())
            ]
    if not cells:
        raise UsageError(left_out[0].reason)
    return cells, left_out


def _possible(scene: ConfiguredScene, sampler: ConfiguredSampler, asked: int) -> tuple[int | None, str]:
    """Return the largest possible count up to ``asked`` (None: none), and the reason if it is another."""
    first_reason, count = "", asked
    for _ in range(_MOST_STEPS):
        try:
            check_points(scene, sampler, count)
            return count, first_reason
        except UsageError as error:
            first_reason = first_reason or str(error)
            if not isinstance(error, CountError) or error.below is None:
                # Fewer points do not help: the count is not what is wrong, or there is none below.
                break
            count = error.below
    return None, first_reason


def _cell(
    request: Request,
    scene: ConfiguredScene,
    sampler: ConfiguredSampler,
    count: int,
    asked: tuple[int, ...],
    reason: str,
) -> Cell:
    notes = list(sampler.notes(count, scene.dims))
    trials = request.trials
    spec = sampler.spec
    if not spec.randomized:
        trials = 1
        notes.append("not random: every trial is the same, so one was made, and errors have no interval")
    elif request.one_pixel and spec.period is not None and spec.period < trials:
        trials = spec.period
        notes.append(f"has {spec.period} sets and no more: so many trials")
    if request.trials == 1 and spec.randomized:
        notes.append("a single trial: errors have no interval")
    if not spec.unbiased:
        notes.append("biased: its mean over realisations is not the integral")
    return Cell(
        scene.text,
        sampler.text,
        count,
        asked,
        reason if asked != (count,) else "",
        scene.dims,
        trials,
        tuple(notes),
        spec.progressive is not None and spec.progressive.allows(count, scene.dims),
    )
