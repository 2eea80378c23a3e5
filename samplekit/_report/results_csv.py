"""``results.csv``: a line for each scene, sampler and count. A field without a number is empty."""

from __future__ import annotations

import csv
import io
import itertools
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from samplekit._study.results import Interval

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._study.results import Results, Row

_INTERVALS = ("mse", "rmse", "bias", "variance", "squared_bias", "blurred_mse", "efficiency", "ratio", "time")
_SECONDS = itertools.product(("points", "scene", "total"), ("cpu", "wall"), ("median", "lower", "upper"))
_TIMES = (*map(".".join, _SECONDS), "setup_cpu", "setup_wall", "laps", "rounds")
"""Attributes of the times of a row."""


def csv_text(results: Results) -> str:
    """Return the rows of a study as CSV, with a header; numbers have all their digits."""
    return records_text([_line(row) for row in results.rows])


def records_text(records: Sequence[dict[str, Any]]) -> str:
    """Return records that have the same keys as CSV, with a header; numbers have all their digits."""
    out = io.StringIO()
    writer = csv.DictWriter(out, list(records[0]) if records else [], lineterminator="\n")
    writer.writeheader()
    writer.writerows(records)
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
        "no_interval": row.no_interval,
    }
    for name in _INTERVALS:
        interval = getattr(row, name) or Interval(None)
        line |= {name: interval.estimate, f"{name}_low": interval.low, f"{name}_high": interval.high}
    for name in _TIMES:
        line[name.replace(".", "_")] = None if row.times is None else attrgetter(name)(row.times)
    line["reference_error"] = float(row.reference_error)
    line["invalid_pixels"] = row.invalid_pixels
    line["fitted"] = int(row.fitted)
    line["notes"] = "; ".join([*([row.replaced] if row.replaced else []), *row.notes])
    return line
