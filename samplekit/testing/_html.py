"""A report as one page: a table for each subject, and pictures of the sets that break a property."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from samplekit.testing._report import rate_line
from samplekit.testing._result import BROKEN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit.testing._report import SubjectReport
    from samplekit.testing._result import CounterExample, Outcome

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #2b323c; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .3rem .6rem; }
tr { border-top: 1px solid #e3e6eb; }
.failed, .unexpected { color: #c2281d; font-weight: 600; }
.not, .note { color: #6a7380; }
.expected { color: #8a5a00; }
figure { margin: .5rem 0; }
svg { max-width: 30rem; height: auto; }
code { background: #f3f4f6; padding: .1rem .3rem; }
"""


def page(subjects: Sequence[SubjectReport]) -> str:
    """Return the page."""
    summary = "; ".join(f"{escape(subject.name)}: {subject.summary}" for subject in subjects)
    head = (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>samplekit check</title>'
        f"<style>{_STYLE}</style></head><body>\n<h1>samplekit check</h1>\n<p>{summary}</p>\n"
        f"<p class=note>{escape(rate_line(len(subjects)))}</p>\n"
    )
    parts = [head]
    for subject in subjects:
        parts.append(f"<h2>{escape(subject.name)}</h2>\n<table><tr><th>check<th>result<th>why</tr>\n")
        parts += [_row(outcome) for outcome in subject.outcomes]
        parts.append("</table>\n")
    return "".join(parts) + "</body></html>\n"


def _row(outcome: Outcome) -> str:
    lines = [escape(outcome.message)] if outcome.message else []
    lines += [f"hint: {escape(text)}" for text in outcome.hints]
    lines += [f"<span class=note>{escape(text)}</span>" for text in outcome.notes]
    figure = ""
    if outcome.example is not None and outcome.status in BROKEN:
        lines.append(f"<code>{escape(str(outcome.example))}</code>")
        figure = _figure(outcome.example)
    why = "<br>".join(lines) + figure
    kind = outcome.status.split()[0]
    return f"<tr><td>{escape(outcome.check)}<td class={kind}>{escape(outcome.status)}<td>{why}</tr>\n"


def _figure(example: CounterExample) -> str:
    """Draw the failing set with its cell shaded and the points that break it circled; empty if there are no points."""
    if example.points is None or not len(example.points):
        return ""
    import numpy as np

    from samplekit.plots._points import PointsDisplay
    from samplekit.plots._saving import inline_svg

    points = example.points
    axes = list(example.axes) or list(range(min(points.shape[1], 2)))
    axes = axes[:2] if len(axes) > 1 or points.shape[1] == 1 else [axes[0], next(i for i in (0, 1) if i != axes[0])]
    drawn = np.clip(np.nan_to_num(points[:, axes], nan=0.0), 0.0, 1.0)
    names = ", ".join(map(str, axes))
    display = PointsDisplay(drawn, title=f"{example.sampler}, dimensions {names}", names=axes).plot()
    if example.box:
        edges = dict(zip(example.axes, example.box, strict=True))
        (left, right), (low, high) = (edges.get(axis, (0.0, 1.0)) for axis in [*axes, -1][:2])
        display.ax_.fill(
            [left, right, right, left], [low, low, high, high], color="#c2281d", alpha=0.15, linewidth=0.0, gid="cell"
        )
    start = _first_index(example) if example.indices else 0
    rows = [index - start for index in example.indices[:64] if 0 <= index - start < len(drawn)]
    if len(axes) == 2:
        x, y = drawn[rows].T
        display.ax_.scatter(x, y, 81.0, facecolors="none", edgecolors="#1f5fbf", linewidths=1.2, clip_on=False)
    return f"<figure>{inline_svg(display.figure_)}</figure>"


def _first_index(example: CounterExample) -> int:
    """Index of the first point that was kept: a slice of a larger set starts later."""
    assert example.points is not None
    for row, place in enumerate(example.points):
        if example.coordinates and tuple(place[list(example.axes) or slice(None)][:8]) == example.coordinates[0]:
            return example.indices[0] - row
    return 0
