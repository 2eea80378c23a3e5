"""How faint a fault the checks find: ``python tests/testing/power.py [--full] [--runs N] [FAMILY...]``.

Each family breaks a sampler with a strength that varies; each line says how many runs, with other keys, find it.
"""

from __future__ import annotations

import argparse
from types import SimpleNamespace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from mutants.density import coin
from mutants.mutant import per_key

from samplekit import Realizations
from samplekit.testing._result import CheckFailed
from samplekit.testing._subject import SamplerSubject
from samplekit.testing._suite import SUITES

if TYPE_CHECKING:
    from collections.abc import Callable

    from mutants.mutant import Array

    Spoil = Callable[[Array, Realizations, float], None]


def interval(width: float) -> Spoil:
    """Move a share of the points in [0, width) by a half."""

    def spoil(out: Array, realizations: Realizations, strength: float) -> None:
        moved = (out[:, 0] < width) & (coin(out[:, 0]) < strength)
        out[:, 0] = np.where(moved, out[:, 0] + 0.5, out[:, 0])

    return spoil


def octants(out: Array, realizations: Realizations, strength: float) -> None:
    """Move a share of the points from octants of even parity to those of odd parity."""
    if out.shape[1] > 2:
        even = (out[:, :3] < 0.5).sum(axis=1) % 2 == 0
        out[:, 2] = np.where(even & (coin(out[:, 1]) < strength), (out[:, 2] + 0.5) % 1.0, out[:, 2])


def tied(out: Array, realizations: Realizations, strength: float) -> None:
    """Make dimension 2 of a share of the points the sum of the two before and of a shift of the pixel."""
    if out.shape[1] > 2:
        total = (out[:, 0] + out[:, 1] + per_key(realizations)) % 1.0
        out[:, 2] = np.where(coin(out[:, 2]) < strength, total, out[:, 2])


def lost(out: Array, realizations: Realizations, strength: float) -> None:
    """Lose the strata of a share of the sets."""
    rare = per_key(realizations)[:, 0] < strength
    out[rare, 0] = out[rare, 0] * 7.0 % 1.0


class Family(NamedTuple):
    """A kind of fault, the check that should find it, and how strong it is."""

    check: str
    base: str
    spoil: Spoil
    strengths: tuple[float, ...]


FAMILIES = {
    "half": Family("joint-uniformity", "random", interval(1 / 2), (0.002, 0.005, 0.01, 0.02)),
    "eighth": Family("joint-uniformity", "random", interval(1 / 8), (0.01, 0.03, 0.1)),
    "64th": Family("joint-uniformity", "random", interval(1 / 64), (0.03, 0.1)),
    "octants": Family("joint-uniformity", "random", octants, (0.005, 0.01, 0.02, 0.03)),
    "tied": Family("across-dimensions", "random", tied, (0.5, 0.6, 0.7)),
    "lost": Family("strata", "latin-hypercube", lost, (0.0003, 0.001, 0.003)),
}


def finds(family: Family, strength: float, key: int, *, quick: bool) -> bool:
    """Tell whether the check finds the fault, with the seeds of the check changed by ``key``."""
    subject = SamplerSubject(family.base, quick=quick)
    inner = subject.sampler

    def fill(out: Array, realizations: Realizations, count: int, start: int) -> None:
        other = Realizations.of_pixels(realizations.x, realizations.y, realizations.seed ^ key)
        inner.fill(out, other, count, start)
        family.spoil(out, other, strength)

    subject.sampler = SimpleNamespace(
        check=inner.check, prepare=inner.prepare, streams=inner.streams, trials=inner.trials, fill=fill
    )
    check = next(each for each in SUITES["sampler"] if each.name == family.check)
    try:
        check.function(subject)
    except CheckFailed:
        return True
    return False


def main() -> None:
    """Print the table; see the module."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("families", nargs="*", metavar="FAMILY", choices=[*FAMILIES, []])
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--runs", type=int, default=10)
    given = parser.parse_args()
    for name in given.families or FAMILIES:
        family = FAMILIES[name]
        for strength in family.strengths:
            found = sum(finds(family, strength, 7919 * run + 13, quick=not given.full) for run in range(given.runs))
            print(f"{family.check:<18} {name:<8} {strength:<7g} {found} of {given.runs}", flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
