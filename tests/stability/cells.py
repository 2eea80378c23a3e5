"""Random cells of a sweep: scenes whose edges lie near those of strata, whose values are rare or heavy-tailed."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, NamedTuple

import samplekit

if TYPE_CHECKING:
    from random import Random

    from samplekit import Stability

SAMPLERS = (
    "random", "jittered", "multi-jittered", "correlated-multi-jittered", "uncorrelated-jitter", "n-rooks",
    "latin-hypercube", "orthogonal-array", "sobol+owen", "sobol+xor", "sobol+shift", "owen-sobol", "halton+owen",
    "faure+owen", "niederreiter+owen", "hammersley+shift", "regular+shift", "r2+shift", "fibonacci", "rank1", "pmj02",
    "poisson-disk", "hammersley", "sobol", "z-sobol",
)  # fmt: skip
SCENES = (
    "disk", "arc", "ellipse", "gaussian", "zoneplate", "step", "step", "checker", "bilinear", "power", "spike",
    "oscillating", "oscillating", "offset", "depth-of-field", "motion-blur", "ambient-occlusion",
)  # fmt: skip
COUNTS = (1, 2, 3, 4, 5, 8, 9, 16, 25, 49, 64, 89, 144, 256, 289, 512, 961, 1024, 2048, 4096)
REALIZATIONS = (2, 3, 4, 5, 8, 16, 32, 64)
_FAMILIES = ("oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous")


class Cell(NamedTuple):
    scene: str
    sampler: str
    count: int
    realizations: int
    seed: int

    def sweep(self) -> Stability:
        return samplekit.stability(
            self.scene, self.sampler, [self.count], realizations=self.realizations, seed=self.seed
        )


def between(random: Random, low: float, high: float) -> float:
    """A number whose logarithm is uniform."""
    return math.exp(random.uniform(math.log(low), math.log(high)))


def place(random: Random) -> float:
    return random.choice([0.0, 0.25, 0.375, 0.5, 0.97, 1.0, random.random(), random.random()])


def scene(random: Random) -> str:
    r, name = random, random.choice(SCENES)
    centre = f"cx={place(r)},cy={place(r)}"
    nearly = r.choice([0.0, 90.0]) + r.choice([0.0, between(r, 1e-14, 1.0), r.uniform(0.0, 90.0)])
    if name == "disk":
        return f"disk:radius={between(r, 1e-4, 2.0)},{centre}"
    if name == "arc":
        radius, (axis, other) = between(r, 1.0, 1e9), r.choice([("cx", "cy"), ("cy", "cx")])
        return f"disk:radius={radius},{axis}={place(r) + r.choice([-1, 1]) * radius},{other}={place(r)}"
    if name == "ellipse":
        return f"ellipse:radius={between(r, 1e-3, 100.0)},aspect={between(r, 1e-9, 1.0)},angle={nearly},{centre}"
    if name == "gaussian":
        return f"gaussian:sigma={between(r, 1e-6, 1e4)},{centre}"
    if name == "zoneplate":
        return f"zoneplate:k={between(r, 1e-8, 1e9)},{centre}"
    if name == "step":
        return f"step:angle={nearly},offset={place(r)},width={r.choice([0.0, between(r, 1e-15, 10.0)])}"
    if name == "checker":
        return f"checker:cells={r.choice([1, 2, 3, 4, 8, 16, 64, r.randrange(1, 2000)])}"
    if name == "power":
        return f"power:a={r.choice([0.9 * r.random(), 0.5 - between(r, 1e-4, 0.2)])}"
    if name == "spike":
        ground = r.choice([1e-30, between(r, 1e-3, 1e3)])
        return f"spike:area={between(r, 1e-8, 1.0)},peak={between(r, 1e-3, 1e3)},background={ground},{centre}"
    if name == "oscillating":
        family, difficulty = r.choice(_FAMILIES), between(r, 1e-6, 1e6)
        return f"oscillating:family={family},d={r.randrange(1, 13)},difficulty={difficulty},u={place(r)}"
    if name == "offset":
        inner = scene(r)
        pedestal = r.choice([0.0, 1.0, -1.0, 1e3, between(r, 1e-3, 1e15)])
        return inner if inner.startswith("offset") else f"offset:pedestal={pedestal},scene={inner.replace(',', '+')}"
    if name == "depth-of-field":
        return f"depth-of-field:aperture={r.choice([0.0, between(r, 1e-6, 10.0)])},focus={between(r, 0.1, 10.0)}"
    if name == "motion-blur":
        return f"motion-blur:shutter={between(r, 1e-6, 10.0)},aperture={r.choice([0.0, between(r, 1e-3, 1.0)])}"
    if name == "ambient-occlusion":
        radius = between(r, 1e-3, 0.99)
        return f"ambient-occlusion:radius={radius},height={radius + between(r, 1e-6, 10.0)},cx={r.uniform(-1.0, 1.0)}"
    return name


def random_cell(random: Random) -> Cell:
    sampler, seed = random.choice(SAMPLERS), random.randrange(2**64)
    counts = COUNTS[:11] if sampler == "poisson-disk" else COUNTS
    return Cell(scene(random), sampler, random.choice(counts), random.choice(REALIZATIONS), seed)


def faults(found: Stability) -> list[str]:
    """What is false in a sweep of right cells: wrong verdicts, and sentences with a number that is none."""
    sentences = [cell.verdict.reason for cell in found.cells] + [" ".join(found.table())]
    for extreme in {cell.extreme for cell in found.cells}:
        sentences = [text.replace(extreme, "") for text in sentences]
    return [text for text in sentences if re.search(r"\b(nan|inf)\b", text)] + [
        f"wrong: {cell.verdict.reason}" for cell in found.wrong
    ]
