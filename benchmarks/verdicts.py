"""Verdicts of `samplekit stability` on random cells: how many right ones it calls wrong, and how many faults it finds.

python benchmarks/verdicts.py [--cells 20000] [--biased 200] [--seed 0]

A wrong cell is one whose reference is moved by a number of its standard errors at 32 realisations.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections import Counter
from pathlib import Path
from random import Random

import numpy as np

import samplekit
from samplekit._bases.reference import Reference
from samplekit._stability.sweep import REALIZATIONS, measure_and_judge

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "stability"))

from cells import faults, random_cell

BIASES = (2.0, 3.0, 4.0, 6.0, 10.0)
BIASED_SCENES = ("disk", "gaussian", "bilinear", "zoneplate:k=100", "power:a=0.25", "oscillating:d=4")
BIASED_SAMPLERS = ("random", "jittered", "halton+owen", "sobol+owen")


def judge_right_cells(number: int, seed: str) -> None:
    kinds: Counter[str] = Counter()
    twice, began = 0, time.perf_counter()
    for k in range(number):
        cell = random_cell(Random(f"{seed} {k}"))
        found = cell.sweep()
        kinds[found.cells[0].verdict.kind] += 1
        twice += found.cells[0].repeated
        for fault in faults(found):
            print(f"{cell}: {fault}", flush=True)
    seconds = time.perf_counter() - began
    print(f"{number} right cells, {seconds:.0f} s: {dict(kinds.most_common())}, {twice} measured twice")


def judge_wrong_cells(number: int, seed: int) -> None:
    random, edges, kinds = Random(seed), np.array([0.0, 1.0]), {bias: Counter() for bias in BIASES}
    for _ in range(number):
        scene = samplekit.scene(random.choice(BIASED_SCENES))
        sampler = samplekit.sampler(random.choice(BIASED_SAMPLERS))
        count, own_seed = random.choice([16, 256, 1024]), random.randrange(2**64)
        exact = scene.reference(edges, edges)
        spread = float(np.std(samplekit.estimate(scene, sampler, count, realizations=1024, seed=own_seed ^ 1)))
        for bias in BIASES:
            moved = Reference(exact.image + bias * spread / math.sqrt(REALIZATIONS), exact.error)
            verdict = measure_and_judge(scene, sampler, count, REALIZATIONS, own_seed, moved)[1]
            kinds[bias][verdict.kind] += 1
    for bias, found in kinds.items():
        print(f"references moved by {bias:g} standard errors: {dict(found.most_common())}")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--cells", type=int, default=20_000)
    parser.add_argument("--biased", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    judge_wrong_cells(arguments.biased, arguments.seed)
    judge_right_cells(arguments.cells, f"{arguments.seed}")


if __name__ == "__main__":
    main()
