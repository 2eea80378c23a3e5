"""Write the results of a study as text: a table for each scene, its slopes, and the answers in words."""

from __future__ import annotations

from samplekit._study.results import Fit, Interval, Results, Row
from samplekit._study.sentences import seconds_in_words


def lines(results: Results) -> list[str]:
    """Return all lines of text that ``samplekit compare`` prints."""
    size = "the unit square" if results.size == (1, 1) else f"{results.size[0]}x{results.size[1]}"
    trials = f"{results.trials} trial{'' if results.trials == 1 else 's'}"
    written = [f"{size}, {trials}, seed {results.seed}, 95 % intervals"]
    for scene in results.scenes:
        rows = [row for row in results.rows if row.scene == scene]
        if not rows:
            continue
        written += ["", *_table(scene, rows)]
        written += _slopes([fit for fit in results.fits if fit.scene == scene])
    if results.sentences:
        written += ["", *results.sentences]
    return written


def left_out_lines(results: Results) -> list[str]:
    """Return a line for each reason why there is no row for a requested scene, sampler or count."""
    counts: dict[tuple[str, str, str], list[int]] = {}
    for item in results.left_out:
        counts.setdefault((item.scene, item.sampler, item.reason), []).extend([item.count] if item.count else [])
    return [
        f"left out: {scene}, {sampler}, {', '.join(str(count) for count in counts)} samples: {reason}"
        for (scene, sampler, reason), counts in counts.items()
    ]


def _table(scene: str, rows: list[Row]) -> list[str]:
    width = max(len(row.sampler) for row in rows)
    found = [f"{scene:<{width}}  {'samples':>9}  {'mse':>9}  {'interval':<20}  {'time':>8}"]
    for row in rows:
        time = "" if row.time is None or row.time.estimate is None else seconds_in_words(row.time.estimate)
        line = f"{row.sampler:<{width}}  {row.count:>9}  {_estimate(row.mse):>9}  {_interval(row):<20}  {time:>8}"
        remarks = [row.replaced] if row.replaced else []
        remarks += row.notes
        found.append("  ".join([line, *remarks]).rstrip())
    return found


def _slopes(fits: list[Fit]) -> list[str]:
    if not fits:
        return []
    width = max(len(fit.sampler) for fit in fits)
    found = ["slopes"]
    for fit in fits:
        theory = "" if fit.theory is None else f"  theory {fit.theory:g} ({fit.case} case)"
        left_out = f"  without {', '.join(str(count) for count in fit.left_out)}" if fit.left_out else ""
        slope = fit.slope
        reach = "" if slope.low is None or slope.high is None else f"from {slope.low:.3f} to {slope.high:.3f}"
        span = f"over {fit.first}..{fit.last}"
        found.append(f"  {fit.sampler:<{width}}  N^{slope.estimate:.3f}  {reach:<22}  {span}{theory}{left_out}")
    return found


def _estimate(interval: Interval) -> str:
    return "-" if interval.estimate is None else f"{interval.estimate:.3g}"


def _interval(row: Row) -> str:
    low, high = row.mse.low, row.mse.high
    if row.no_interval:
        return row.no_interval + ("" if high is None else f", <= {high:.3g}")
    if low is None or high is None:
        return "no interval" if high is None else f"at most {high:.3g}"
    return "not random" if low == high else f"{low:.3g} to {high:.3g}"
