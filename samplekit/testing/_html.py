"""A report as one page: a table for each subject, and pictures of the sets that break a property."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from samplekit.testing._report import SubjectReport, rate_line
from samplekit.testing._result import BROKEN, CounterExample, Outcome

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
    """Draw the set that fails: its cell is shaded, the points at fault are circled. Empty if there are no points."""
    if example.points is None or not len(example.points):
        return ""
    import numpy as np

    from samplekit.plots._points import PointsDisplay
    from samplekit.plots._saving import inline_svg

    points = example.points
    # The dimensions that matter first, then others: two of them, if there are two.
    axes = list(dict.fromkeys([*example.axes, *range(points.shape[1])]))[:2]
    drawn = np.clip(np.nan_to_num(points[:, axes], nan=0.0), 0.0, 1.0)
    names = ", ".join(map(str, axes))
    display = PointsDisplay(drawn, title=f"{example.sampler}, dimensions {names}", names=axes).plot()
    if example.box:
        edges = dict(zip(example.axes, example.box, strict=True))
        (left, right), (low, high) = (edges.get(axis, (0.0, 1.0)) for axis in [*axes, -1][:2])
        display.ax_.fill(
            [left, right, right, left], [low, low, high, high], color="#c2281d", alpha=0.15, linewidth=0.0, gid="cell"
        )
    rows = [index - example.start for index in example.indices[:64] if 0 <= index - example.start < len(drawn)]
    if len(axes) == 2:
        x, y = drawn[rows].T
        display.ax_.scatter(x, y, 81.0, facecolors="none", edgecolors="#1f5fbf", linewidths=1.2, clip_on=False)
    return f"<figure>{inline_svg(display.figure_)}</figure>"
