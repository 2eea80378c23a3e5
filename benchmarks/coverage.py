"""How often the intervals of a study cover the truth, for errors from easy to hard.

python benchmarks/coverage.py [--studies 2000] [--seed 0]

Each study takes the errors of some trials of one pixel and asks for the interval of the mean squared error, whose true
value is known. The table has the share of studies that have an interval, and the share of these in which it covers.
"""

from __future__ import annotations

import argparse
import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit._study.errors import errors_of
from samplekit._study.trials import COLUMNS, ERROR, SQUARE, TRIALS

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Array = NDArray[np.float64]

TRIAL_COUNTS = (32, 64, 100, 400)
CORNER = "oscillating:family=corner-peak"


def _shares(rng: np.random.Generator, samples: int, area: float, number: int) -> Array:
    """Draw errors of the share of samples inside a shape of this area."""
    return rng.binomial(samples, area, number) / samples - area


def families(rng: np.random.Generator) -> dict[str, tuple[Callable[[int], Array], float]]:
    """Return for each kind of error a function that draws so many, and their true mean square."""
    shares = {"bright disk, 1 sample": (1, 0.28), "small disk, 16 samples": (16, 0.008)}
    found: dict[str, tuple[Callable[[int], Array], float]] = {
        "normal": (rng.standard_normal, 1.0),
        "uniform": (lambda n: rng.random(n) - 0.5, 1.0 / 12.0),
        "exponential": (lambda n: rng.exponential(size=n) - 1.0, 1.0),
        "normal, one in ten 4 times as large": (
            lambda n: rng.standard_normal(n) * np.where(rng.random(n) < 0.1, 4.0, 1.0),
            2.5,
        ),
        "lognormal": (lambda n: np.exp(rng.standard_normal(n)) - math.exp(0.5), (math.e - 1.0) * math.e),
    }
    for name, (samples, area) in shares.items():
        found[name] = partial(_shares, rng, samples, area), area * (1.0 - area) / samples
    edges = np.array([0.0, 1.0])
    exact = float(samplekit.scene(CORNER).exact(edges, edges)[0, 0])
    values = samplekit.estimate(CORNER, "random", 1, realizations=2**21) - exact
    found["corner peak, 1 sample"] = lambda n: rng.choice(values, n), float(np.mean(values**2))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--studies", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    heads = "".join(f"{trials:>8} trials" for trials in TRIAL_COUNTS)
    print(f"{'errors':<38}{heads}   (given, of these covered)")
    for name, (draw, truth) in families(np.random.default_rng(options.seed)).items():
        cells = []
        for trials in TRIAL_COUNTS:
            given = covered = 0
            for _ in range(options.studies):
                errors = draw(trials)
                sums = np.zeros((trials, COLUMNS))
                sums[:, TRIALS], sums[:, ERROR], sums[:, SQUARE] = 1.0, errors, errors * errors
                found = errors_of(sums, one_pixel=True, sampled=1)
                if not found["no_interval"]:
                    given += 1
                    covered += found["mse"].low <= truth <= found["mse"].high
            share = f"{100 * covered / given:.0f} %" if given else "-"
            cells.append(f"{100 * given / options.studies:>7.0f} % {share:>5}")
        print(f"{name:<38}" + "".join(cells))


if __name__ == "__main__":
    main()
