"""A report as one page: a table for each subject, and pictures of the sets that break something."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from samplekit.testing._result import BROKEN, STATUSES
from samplekit.testing._statistics import family_rate

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

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


def page(runs: Mapping[str, Sequence[Outcome]]) -> str:
    """The page, as text: subject to outcomes."""
    summary = "; ".join(f"{escape(name)}: {counted(outcomes)}" for name, outcomes in runs.items())
    head = (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>samplekit check</title>'
        f"<style>{_STYLE}</style></head><body>\n<h1>samplekit check</h1>\n<p>{summary}</p>\n"
        f"<p class=note>{escape(rate_line(len(runs)))}</p>\n"
    )
    parts = [head]
    for name, outcomes in runs.items():
        parts.append(f"<h2>{escape(name)}</h2>\n<table><tr><th>check<th>result<th>why</tr>\n")
        parts += [_row(outcome) for outcome in outcomes]
        parts.append("</table>\n")
    return "".join(parts) + "</body></html>\n"


def counted(outcomes: Sequence[Outcome]) -> str:
    """Numbers of outcomes by status."""
    numbers = {status: sum(outcome.status == status for outcome in outcomes) for status in STATUSES}
    return ", ".join(f"{number} {status}" for status, number in numbers.items() if number)


def rate_line(subjects: int) -> str:
    """How often a run like this blames a conforming sampler."""
    rate = f"{family_rate(subjects):.2g}"
    return f"statistical checks blame a conforming sampler in this run with probability at most {rate}"


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
    """A picture of the failing set, its cell shaded and the points that break it circled; nothing if there is none."""
    if example.points is None or not len(example.points):
        return ""
    import numpy as np

    from samplekit.files._pointsets.picture import make_picture
    from samplekit.files._pointsets.svg import svg_text

    points = example.points
    axes = list(example.axes) or list(range(min(points.shape[1], 2)))
    axes = axes[:2] if len(axes) > 1 or points.shape[1] == 1 else [axes[0], next(i for i in (0, 1) if i != axes[0])]
    drawn = np.clip(np.nan_to_num(points[:, axes], nan=0.0), 0.0, 1.0)
    picture = make_picture(drawn, (), f"{example.sampler}, dimensions {', '.join(map(str, axes))}")
    svg = "".join(svg_text(picture, {})).partition("?>\n")[2]
    panel = picture.panels[0]
    ring = 'fill="none" stroke="#1f5fbf" stroke-width="2"'
    cell = ""
    if example.box:
        edges = dict(zip(example.axes, example.box, strict=True))
        (x, right), (y, bottom) = (edges.get(axis, (0.0, 1.0)) for axis in [*axes, -1][:2])
        cell = (
            f'<rect x="{panel.left + x * panel.width:.2f}" y="{panel.top + y * panel.height:.2f}"'
            f' width="{(right - x) * panel.width:.2f}" height="{(bottom - y) * panel.height:.2f}"'
            ' fill="#c2281d" fill-opacity="0.15"/>'
        )
    start = _first_index(example) if example.indices else 0
    circles = ""
    for index in example.indices[:64]:
        row = index - start
        if 0 <= row < len(drawn) and len(panel.axes) == 2:
            x, y = panel.left + drawn[row, 0] * panel.width, panel.top + drawn[row, 1] * panel.height
            circles += f'<circle cx="{x:.2f}" cy="{y:.2f}" r="9" {ring}/>'
    return f"<figure>{svg.replace('</svg>', cell + circles + '</svg>')}</figure>"


def _first_index(example: CounterExample) -> int:
    """Index of the first point that was kept: a slice of a larger set starts later."""
    assert example.points is not None
    for row, place in enumerate(example.points):
        if example.coordinates and tuple(place[list(example.axes) or slice(None)][:8]) == example.coordinates[0]:
            return example.indices[0] - row
    return 0
