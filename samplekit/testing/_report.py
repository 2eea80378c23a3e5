"""The report of a run over samplers and scenes: as plain data, as lines of text, and as a page."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from samplekit.testing._result import STATUSES, Outcome, broken
from samplekit.testing._statistics import family_rate

SCHEMA = "samplekit.check/1"


@dataclass(frozen=True)
class SubjectReport:
    """What the checks found about one sampler or scene.

    Attributes
    ----------
    name
        As on the command line; ``sampler NAME`` or ``scene NAME`` where both have the name.
    outcomes
        An outcome for each check, in the order of the suite.
    """

    name: str
    outcomes: list[Outcome]

    @property
    def conforms(self) -> bool:
        """Whether no check failed, except those that are declared to fail."""
        return not broken(self.outcomes)

    @property
    def seconds(self) -> float:
        """Time that the checks took."""
        return sum(outcome.seconds for outcome in self.outcomes)

    @property
    def points(self) -> int:
        """Number of points that were drawn."""
        return sum(outcome.points for outcome in self.outcomes)

    @property
    def counts(self) -> dict[str, int]:
        """Number of outcomes of each status."""
        return {status: sum(outcome.status == status for outcome in self.outcomes) for status in STATUSES}

    @property
    def summary(self) -> str:
        """The counts that are not 0, in one line."""
        return ", ".join(f"{number} {status}" for status, number in self.counts.items() if number)

    def table(self) -> list[str]:
        """Return the lines of text that ``samplekit check`` prints."""
        lines = [f"{self.name}: {self.summary} ({self.seconds:.1f} s, {self.points} points)"]
        for outcome in self.outcomes:
            detail = outcome.message + (f" [{outcome.example}]" if outcome.example else "")
            lines.append(f"  {outcome.check:<21} {outcome.status:<17} {detail}".rstrip())
            lines += [f"  {'':<21} {'hint':<17} {hint}" for hint in outcome.hints]
            lines += [f"  {'':<21} {'note':<17} {note}" for note in outcome.notes]
        return lines

    def as_json(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "name": self.name,
            "conforms": self.conforms,
            "counts": self.counts,
            "seconds": round(self.seconds, 3),
            "points": self.points,
            "checks": [outcome.as_json() for outcome in self.outcomes],
        }


@dataclass(frozen=True)
class Report:
    """What :func:`samplekit.testing.check` found.

    Attributes
    ----------
    subjects
        A report for each sampler and scene, in the order of the names.
    quick
        Whether samples were smaller.

    Examples
    --------
    >>> from samplekit.testing import check
    >>> report = check("jittered", only=["strata", "seed"], quick=True)
    >>> [outcome.status for outcome in report.outcomes], report.failed
    (['passed', 'passed'], [])
    """

    subjects: list[SubjectReport]
    quick: bool

    @property
    def outcomes(self) -> list[Outcome]:
        """The outcomes of all checks of all subjects."""
        return [outcome for subject in self.subjects for outcome in subject.outcomes]

    @property
    def failed(self) -> list[str]:
        """The names of the subjects that do not conform."""
        return [subject.name for subject in self.subjects if not subject.conforms]

    @property
    def summary(self) -> str:
        """How many subjects conform, and how often a run like this blames a conforming sampler, in one line."""
        number = len(self.subjects)
        return f"{number - len(self.failed)} of {number} conform; {rate_line(number)}"

    def as_json(self) -> dict[str, Any]:
        """Return what ``samplekit check --json`` prints."""
        return {
            "schema": SCHEMA,
            "quick": self.quick,
            "conform": not self.failed,
            "false_alarm_rate": family_rate(len(self.subjects)),
            "subjects": [subject.as_json() for subject in self.subjects],
        }

    def page(self) -> str:
        """Return a page of HTML with a table for each subject, and pictures of the sets that fail."""
        from samplekit.testing._html import page

        return page(self.subjects)


def rate_line(subjects: int) -> str:
    """Say how often a run over this many subjects blames a conforming sampler."""
    rate = f"{family_rate(subjects):.2g}"
    return f"statistical checks blame a conforming sampler in this run with probability at most {rate}"
