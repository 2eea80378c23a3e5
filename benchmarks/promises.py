"""Every promise of every sampler, exactly, in many realisations: the tests check the same in fewer.

python benchmarks/promises.py [--realizations 100] [SAMPLER...]

Elementary intervals of every declared net for every power of its base from 2^2 to 2^14 points, blocks 0, 1 and 5;
strata and orthogonal arrays at counts of all kinds; minimum distances on the torus; prefixes bit for bit.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import TYPE_CHECKING

from scipy.spatial import cKDTree

import samplekit
from samplekit import MinimumDistance, Net, UsageError
from samplekit._registry import registry
from samplekit._specs import Strata

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np

    from samplekit import ConfiguredSampler

MOST_POINTS = 1 << 14
BLOCKS = (0, 1, 5)
COUNTS = (1, 2, 3, 4, 5, 7, 8, 9, 12, 16, 25, 27, 49, 64, 96, 97, 100, 121, 125, 343, 961, 1000, 1024, 1026, 1331, 1369)
LARGE_COUNTS = (2025, 2048, 2491, 4096, 4913, 5041, 6859, 10201, 16384)
DISTANCE_COUNTS = (2, 3, 5, 8, 13, 16, 64, 97, 100, 144, 256, 987, 1000, 1024)
ROUNDING = 2.0**-51
OPTIONS = (
    *("halton:scramble=digits", "halton:scramble=owen", "faure:base=2", "faure:base=3", "faure:base=7"),
    *("van-der-corput:base=3", "van-der-corput:base=6", "van-der-corput:base=10", "z-sobol:orders=random"),
    *("orthogonal-array:offset=jittered", "orthogonal-array:offset=multi-jittered"),
    *("orthogonal-array:strength=3", "orthogonal-array:strength=3,offset=multi-jittered"),
    *("poisson-disk:radius=0.75", "poisson-disk:method=elimination", "rank1:vector=hkkn"),
)


def everything() -> list[str]:
    """All samplers and options that promise something, plain and under the randomizers that keep it."""
    plain = [
        *(name for name, offer in registry().all("sampler").items() if not offer.spec.required_options),
        *OPTIONS,
    ]
    suffixes = ("", *(f"+{name}" for name in registry().all("randomizer")))
    texts = [text + suffix for text in plain for suffix in suffixes]
    return [text for text in texts if samplekit.sampler(text).spec.promises]


def makes(sampler: ConfiguredSampler, count: int, dims: int) -> bool:
    try:
        sampler.check(count, dims)
    except UsageError:
        return False
    return True


def sets(
    sampler: ConfiguredSampler, count: int, dims: int, realizations: int, start: int, seed: int
) -> Iterator[np.ndarray]:
    """Yield points from ``start`` on, float64[R, n, D], in batches that fit into memory."""
    realizations = realizations if sampler.spec.randomized else 1
    points = sampler.points(count, dims, realizations=realizations, seed=seed, start=start)
    batch = max(1, (1 << 20) // points[0].size)
    for first in range(0, realizations, batch):
        yield points[first : first + batch]


class Sweep:
    """What was judged, and what failed."""

    def __init__(self, text: str, realizations: int) -> None:
        self.sampler = samplekit.sampler(text).fresh()
        self.realizations = realizations
        self.judged = 0
        self.failures: list[str] = []
        self.most = self.sampler.spec.dimensions[1] or 10**9

    def judge(self, holds: bool, what: str) -> None:
        self.judged += 1
        if not holds:
            self.failures.append(what)

    def nets(self, net: Net) -> None:
        dims = max(*net.dims, self.sampler.spec.dimensions[0] - 1) + 1
        if dims > self.most:
            return
        for m in range(1, 15):
            size = net.base**m
            if m < net.t or size > MOST_POINTS:
                continue
            for block in BLOCKS if net.sequence else (0,):
                count = (block + 1) * size
                if not net.sequence and not makes(self.sampler, count, dims):
                    continue
                for values in sets(self.sampler, count, dims, self.realizations, block * size, seed=m):
                    found = net.find_violation(values)
                    self.judge(found is None, f"{net} m={m} block {block}: {found}")

    def strata(self) -> None:
        promises = self.sampler.spec.promised(Strata)
        if not promises:
            return
        least = self.sampler.spec.dimensions[0]
        for dims in sorted({min(max(d, least), self.most) for d in (1, 2, 3, 4, 5)}):
            for count in COUNTS + LARGE_COUNTS:
                if not makes(self.sampler, count, dims):
                    continue
                for values in sets(self.sampler, count, dims, self.realizations, 0, seed=count):
                    for promise in promises:
                        found = promise.find_violation(values)
                        self.judge(found is None, f"{count} points in {dims}D: {found}")

    def distances(self, promise: MinimumDistance) -> None:
        dims = max(2, self.sampler.spec.dimensions[0])
        for count in DISTANCE_COUNTS:
            distance = promise.distance(count, dims)
            if distance is None or not makes(self.sampler, count, dims):
                continue
            for values in sets(self.sampler, count, dims, self.realizations, 0, seed=count):
                for one in values:
                    least = cKDTree(one, boxsize=1.0).query(one, 2)[0][:, 1].min()
                    self.judge(least >= distance - ROUNDING, f"{count} points: {least}")

    def prefixes(self) -> None:
        progressive = self.sampler.spec.progressive
        if progressive is None:
            return
        dims = min(self.most, 5)
        powers = {base**k for base in (2, 3, 5, 7) for k in range(15)}
        wanted = {1, 3, 16, 100, 1000} | powers | {n + 1 for n in powers} | {n - 1 for n in powers}
        lengths = {length for length in wanted if length < 5000 and progressive.allows(length, dims)}
        whole = self.sampler.points(5000, dims, realizations=self.realizations, seed=1)
        for length in sorted(lengths):
            short = self.sampler.points(length, dims, realizations=self.realizations, seed=1)
            self.judge(bool((short == whole[:, :length]).all()), f"prefix of {length}")

    def run(self) -> None:
        for net in self.sampler.spec.promised(Net):
            self.nets(net)
        for distance in self.sampler.spec.promised(MinimumDistance):
            self.distances(distance)
        self.strata()
        self.prefixes()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("samplers", nargs="*")
    parser.add_argument("--realizations", type=int, default=100)
    arguments = parser.parse_args()
    failed = 0
    for text in arguments.samplers or everything():
        began = time.perf_counter()
        sweep = Sweep(text, arguments.realizations)
        sweep.run()
        failed += len(sweep.failures)
        seconds = time.perf_counter() - began
        print(f"{text:<46}{sweep.judged:>7} judged {len(sweep.failures):>5} failed {seconds:>7.1f} s", flush=True)
        for failure in sweep.failures[:3]:
            print(f"    {failure}", flush=True)
    sys.exit(3 if failed else 0)


if __name__ == "__main__":
    main()
