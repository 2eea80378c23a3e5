"""Declarations of samplers in words, in full for ``samplekit list samplers NAME`` and short for tables."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from samplekit._specs import AnyCount, Promise, SamplerSpec

_EXAMPLES = 8


def dimensions(spec: SamplerSpec) -> str:
    """State the least and most number of dimensions."""
    least, most = spec.dimensions
    return f"{least}" if most == least else f"{least} and more" if most is None else f"{least} to {most}"


def short_dimensions(spec: SamplerSpec) -> str:
    """State the least and most number of dimensions for a narrow column."""
    least, most = spec.dimensions
    return f"{least}" if most == least else f"{least}+" if most is None else f"{least}-{most}"


def extensible(spec: SamplerSpec) -> str:
    """State what happens to the points when there are more dimensions."""
    if spec.dimensions[0] == spec.dimensions[1]:
        return "no: the number of dimensions is fixed"
    if spec.extensible_dims:
        return "yes: the first dimensions stay when there are more"
    return "no: another number of dimensions is another set"


def counts(spec: SamplerSpec) -> str:
    """State which numbers of points there are, with the first of them where that is not obvious."""
    rule = spec.counts.describe()
    first = list(islice(spec.counts.rising(0, 2), _EXAMPLES))
    if len(first) < _EXAMPLES or first[-1] == _EXAMPLES:
        return rule
    where = " in 2D" if spec.counts.depends_on_dims else ""
    return f"{rule}{where}: {', '.join(map(str, first))}, ..."


def progressive(spec: SamplerSpec) -> str:
    """State what happens to the points when there are more."""
    if spec.progressive is None:
        return "no: another number of points is another set"
    keeps = "the first points stay when there are more"
    if spec.progressive == AnyCount():
        return f"at every number of points: {keeps}"
    return f"at {spec.progressive.describe()}: {keeps}, and the first {spec.progressive.short()} are a good set"


def short_progressive(spec: SamplerSpec) -> str:
    """State for a narrow column where the points stay when there are more."""
    if spec.progressive is None:
        return ""
    return "always" if spec.progressive == AnyCount() else f"at {spec.progressive.short()}"


def progressive_word(spec: SamplerSpec) -> str:
    """Return the word for JSON: ``no``, ``every-count``, or a rule such as ``powers-of-2``."""
    if spec.progressive is None:
        return "no"
    return "every-count" if spec.progressive == AnyCount() else str(spec.progressive)


def short_promises(promises: Sequence[Promise]) -> str:
    """Name all promises in a few words for a table."""
    return "; ".join(dict.fromkeys(promise.short(promises) for promise in promises))
