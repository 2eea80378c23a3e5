"""Declarations in words: what a sampler promises, how its sets grow, which numbers of points it makes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._specs import GridStrata, LatinStrata, MinimumDistance, Net, OrthogonalArray
from samplekit._specs.counts import describe, nearest_above

if TYPE_CHECKING:
    from collections.abc import Iterable

    from samplekit._specs import Option, Promise, SamplerSpec

_EXAMPLES = 8


def dimensions(spec: SamplerSpec) -> str:
    """Least and most dimensions."""
    least, most = spec.dimensions
    return f"{least}" if most == least else f"{least} and more" if most is None else f"{least} to {most}"


def counts(spec: SamplerSpec) -> str:
    """The rule of its counts, with the first of them where they are not all."""
    rule = describe(spec.counts)
    if spec.counts == "any" or spec.counts.startswith("exactly"):
        return rule
    examples: list[int] = []
    while len(examples) < _EXAMPLES and (following := nearest_above(spec.counts, max(examples, default=0), 2)):
        examples.append(following)
    where = " in 2D" if spec.counts == "products" else ""
    return f"{rule}{where}: {', '.join(map(str, examples))}, ..."


def progressive(spec: SamplerSpec) -> str:
    """What happens to the points when there are more."""
    if spec.progressive == "no":
        return "no: another number of points is another set"
    keeps = "the first points stay when there are more"
    if spec.progressive == "every-count":
        return f"at every number of points: {keeps}"
    base = spec.progressive.rpartition("-")[2]
    return f"at powers of {base}: {keeps}, and the first {base}^m are a good set"


def screen(side: int) -> str:
    """What pixels have to do with each other."""
    return (
        f"each aligned block of {side} x {side} pixels shares one sequence: its sets together keep every promise, and"
        " errors cancel when seen together"
    )


def promise(promised: Promise) -> str:
    """One promise as a sentence."""
    if isinstance(promised, GridStrata):
        where = "" if promised.block is None else f" of every block of {promised.block} dimensions"
        return f"one point in each cell of a grid of near-equal sides{where}"
    if isinstance(promised, LatinStrata):
        where = "every dimension" if promised.dims is None else _axes(promised.dims)
        return f"one point in each of N intervals of {where}"
    if isinstance(promised, Net):
        blocks = ", and so is every later block of as many" if promised.sequence else ""
        kind = f"({promised.t}, m, {len(promised.dims)})-net in base {promised.base}"
        return f"{_axes(promised.dims)}: the first {promised.base}^m points are a {kind}{blocks}"
    if isinstance(promised, OrthogonalArray):
        t = promised.strength
        return f"one point in each of the s^{t} cells of any {t} dimensions, N = s^{t}"
    return f"points at least {promised.fraction:g} of the densest packing's distance apart, on the torus"


def short_dimensions(spec: SamplerSpec) -> str:
    """Least and most dimensions for a narrow column."""
    least, most = spec.dimensions
    return f"{least}" if most == least else f"{least}+" if most is None else f"{least}-{most}"


def short_counts(spec: SamplerSpec) -> str:
    """The rule of its counts for a narrow column."""
    base = spec.counts.rpartition("-")[2]
    if spec.counts.startswith("powers-of-"):
        return f"{base}^m"
    if spec.counts.startswith(("products-in-", "exactly-")):
        return f"a grid in {base}D" if spec.counts.startswith("products") else f"only {base}"
    words = {"products": "a grid", "prime-squares": "prime^2", "prime-cubes": "prime^3", "fibonacci": "Fibonacci"}
    return words.get(spec.counts, spec.counts)


def short_progressive(spec: SamplerSpec) -> str:
    """Where more points keep those there are, for a narrow column."""
    words = {"no": "", "every-count": "always"}
    return words.get(spec.progressive, f"at {spec.progressive.rpartition('-')[2]}^m")


def short_promises(promises: Iterable[Promise]) -> str:
    """All promises as a few words for a table."""
    bases = ", ".join(dict.fromkeys(str(each.base) for each in promises if isinstance(each, Net)))
    words = {
        LatinStrata: "Latin",
        Net: f"net in base {bases}",
        OrthogonalArray: "orthogonal array",
        MinimumDistance: "distance",
    }
    return "; ".join(
        dict.fromkeys(
            ("grid" if each.block is None else "grid in pairs" if each.block == 2 else f"grid in {each.block}s")
            if isinstance(each, GridStrata)
            else words[type(each)]
            for each in promises
        )
    )


def option(declared: Option) -> str:
    """What an option takes and means."""
    takes = " or ".join(declared.choices)
    if not takes and (declared.minimum is not None or declared.maximum is not None):
        low = "any" if declared.minimum is None else f"{declared.minimum:g}"
        takes = f"{low} and more" if declared.maximum is None else f"{low} to {declared.maximum:g}"
    parts = [part for part in (declared.summary, takes) if part]
    return f"{'; '.join(parts)}{' (required)' if declared.required else ''}"


def _axes(dims: tuple[int, ...]) -> str:
    return ("dimension " if len(dims) == 1 else "dimensions ") + ", ".join(map(str, dims))
