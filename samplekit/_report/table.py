"""``results.csv``: a line for each scene, sampler and count. A field without a number is empty."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from samplekit._study.results import Interval, Results, Row, Seconds, Spread

_INTERVALS = ("mse", "rmse", "bias", "variance", "squared_bias", "blurred_mse", "efficiency", "ratio")
_PARTS = ("points", "scene", "total")


def csv_text(results: Results) -> str:
    """Return the rows of a study as CSV, with a header."""
    out = io.StringIO()
    lines = [_line(row) for row in results.rows]
    writer = csv.DictWriter(out, list(lines[0]) if lines else [], lineterminator="\n")
    writer.writeheader()
    writer.writerows(lines)
    return out.getvalue()


def _line(row: Row) -> dict[str, object]:
    line: dict[str, object] = {
        "scene": row.scene,
        "sampler": row.sampler,
        "count": row.count,
        "asked": " ".join(str(count) for count in row.asked),
        "dims": row.dims,
        "samples": row.samples,
        "trials": row.trials,
    }
    for name in _INTERVALS:
        interval: Interval | None = getattr(row, name)
        line[name] = _shortest(None if interval is None else interval.estimate)
        line[f"{name}_low"] = _shortest(None if interval is None else interval.low)
        line[f"{name}_high"] = _shortest(None if interval is None else interval.high)
    line["time"] = _shortest(row.time)
    for name in _PARTS:
        seconds: Seconds | None = None if row.times is None else getattr(row.times, name)
        for kind in ("cpu", "wall"):
            spread: Spread | None = None if seconds is None else getattr(seconds, kind)
            for place in ("median", "lower", "upper"):
                line[f"{name}_{kind}_{place}"] = _shortest(None if spread is None else getattr(spread, place))
    line["setup_cpu"] = _shortest(None if row.times is None else row.times.setup_cpu)
    line["setup_wall"] = _shortest(None if row.times is None else row.times.setup_wall)
    line["laps"] = row.times.laps if row.times else ""
    line["reference_error"] = _shortest(row.reference_error)
    line["invalid_pixels"] = row.invalid_pixels
    line["fitted"] = int(row.fitted)
    line["notes"] = "; ".join([*([row.replaced] if row.replaced else []), *row.notes])
    return line


def _shortest(value: float | None) -> str:
    """Return the shortest text that reads back as the same number; empty for None."""
    return "" if value is None else repr(float(value))
