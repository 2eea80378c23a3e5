"""``results.csv``: a line for each scene, sampler and count; empty fields where there is no number."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from samplekit._study.results import Clock, Interval, Results, Row, Spread

_INTERVALS = ("mse", "rmse", "bias", "variance", "squared_bias", "blurred_mse", "efficiency", "ratio")
_CLOCKS = ("points", "scene", "total")


def table_text(results: Results) -> str:
    """The rows as CSV."""
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
        line[name] = _written(None if interval is None else interval.estimate)
        line[f"{name}_low"] = _written(None if interval is None else interval.low)
        line[f"{name}_high"] = _written(None if interval is None else interval.high)
    line["time"] = _written(row.time)
    for name in _CLOCKS:
        clock: Clock | None = None if row.times is None else getattr(row.times, name)
        for kind in ("cpu", "wall"):
            spread: Spread | None = None if clock is None else getattr(clock, kind)
            for place in ("median", "lower", "upper"):
                line[f"{name}_{kind}_{place}"] = _written(None if spread is None else getattr(spread, place))
    line["setup_cpu"] = _written(None if row.times is None else row.times.setup_cpu)
    line["setup_wall"] = _written(None if row.times is None else row.times.setup_wall)
    line["laps"] = row.times.laps if row.times else ""
    line["reference_error"] = _written(row.reference_error)
    line["invalid_pixels"] = row.invalid_pixels
    line["fitted"] = int(row.fitted)
    line["notes"] = "; ".join([*([row.replaced] if row.replaced else []), *row.notes])
    return line


def _written(value: float | None) -> str:
    return "" if value is None else repr(float(value))
