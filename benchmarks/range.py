"""No value outside [0, 1): many draws over all samplers and randomizers, and their extremes with forced random bits.

python benchmarks/range.py [--values 1e10] [--only NAME ...]

Every choice draws its share, realisation after realisation: sets of several counts, in several dimensions, at seeds
from all over. Ends with status 1 at the first value outside.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time

import numpy as np

from samplekit import ConfiguredSampler
from samplekit import sampler as configured_sampler
from samplekit._registry import registry
from samplekit.testing._forced_bits import forced_extremes
from samplekit.testing._subject import SamplerSubject

COUNTS = (1, 3, 16, 97, 512)
VALUES_AT_ONCE = 2**19


def choices() -> list[str]:
    names = [
        name
        for name, offer in registry().all("sampler").items()
        if not any(option.required for option in offer.spec.options)
    ]
    return [name + suffix for name in names for suffix in ("", *(f"+{r}" for r in registry().all("randomizer")))]


def requests(sampler: ConfiguredSampler) -> list[tuple[int, int]]:
    """Counts and dimensions that it makes: small and large, few and many."""
    least, most = sampler.spec.dimensions
    made = []
    for dims in sorted({max(least, 2 if most != 1 else 1), min(most or 8, 8)}):
        for count in COUNTS:
            possible = sampler.spec.counts.nearest(count, dims)[-1]
            try:
                sampler.check(possible, dims)
            except Exception:
                continue
            if possible * dims <= VALUES_AT_ONCE:
                made.append((possible, dims))
    return list(dict.fromkeys(made))


def draw(sampler: ConfiguredSampler, share: int) -> tuple[int, float, float]:
    drawn, low, high = 0, np.inf, -np.inf
    seeds = np.random.default_rng(0)
    for count, dims in itertools.cycle(requests(sampler)):
        sampler.prepare(count, dims)
        realizations = max(1, VALUES_AT_ONCE // (count * dims))
        first = int(seeds.integers(0, 2**31 - realizations))
        trials = sampler.trials(first, first + realizations, int(seeds.integers(0, 2**64, dtype=np.uint64)))
        out = np.full((realizations, dims, count), np.nan)
        sampler.fill(out, trials, count, 0)
        low, high = min(low, float(out.min())), max(high, float(out.max()))
        drawn += out.size
        if not (low >= 0.0 and high < 1.0):
            sys.exit(f"{sampler.text}: {count} points in {dims} dimensions gave {low!r} to {high!r}")
        if drawn >= share:
            return drawn, low, high
    raise AssertionError("there are requests")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--values", type=float, default=1e10)
    parser.add_argument("--only", nargs="*")
    arguments = parser.parse_args()
    chosen = arguments.only or choices()
    share = int(arguments.values / len(chosen)) + 1
    total, forced, lowest, highest = 0, 0, np.inf, -np.inf
    began = time.perf_counter()
    for text in chosen:
        start = time.perf_counter()
        drawn, low, high = draw(configured_sampler(text), share)
        nanoseconds = (time.perf_counter() - start) / drawn * 1e9
        extremes = [values for _, values in forced_extremes(SamplerSubject(text))]
        for values in extremes:
            if not ((values >= 0.0).all() and (values < 1.0).all()):
                sys.exit(f"{text}, with forced random bits: {values.min()!r} to {values.max()!r}")
        total += drawn
        forced += sum(values.size for values in extremes)
        lowest, highest = min(lowest, low), max(highest, high)
        gap = (1.0 - high) / 2.0**-53
        print(
            f"{text:<36}{drawn:>12} values, {nanoseconds:6.1f} ns, least {low:.3g}, 1 - most = {gap:.3g} x 2^-53,",
            end="",
        )
        print(f" {sum(values.size for values in extremes)} forced", flush=True)
    print(
        f"{total:.4g} values and {forced} with forced random bits, least {lowest:.3g}, most {highest!r}, all in [0, 1)"
    )
    print(f"{time.perf_counter() - began:.0f} s")


if __name__ == "__main__":
    main()
