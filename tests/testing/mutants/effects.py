"""Mutants that do more than write points."""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING

import numpy as np

from mutants.mutant import Mutant

if TYPE_CHECKING:
    from mutants.mutant import Array
    from samplekit import Realizations


class TouchesTheGlobalGenerator(Mutant):
    """Draws from NumPy's global generator, and throws it away."""

    base, caught_by = "random", "purity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        np.random.random()  # noqa: NPY002 - the fault


class SeedsPythonsGenerator(Mutant):
    """Seeds Python's global generator."""

    base, caught_by = "random", "purity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        random.seed(1)


class PrintsToStdout(Mutant):
    """Prints to standard output, where results go."""

    base, caught_by = "random", "purity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        print("filling", out.shape)  # noqa: T201 - the fault


class SharedScratch(Mutant):
    """Keeps a scratch array between calls, which two threads write at once."""

    base, caught_by = "random", "purity"

    def __init__(self) -> None:
        super().__init__()
        self.scratch = 0.0

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        self.scratch += 2.0**-40
        mine = self.scratch
        time.sleep(0.0005)
        if self.scratch != mine:
            out[0, 0, 0] = 0.5
        self.scratch = mine - 2.0**-40


class CannotBePickled(Mutant):
    """Holds a function that no other process can be sent."""

    base, caught_by = "random", "purity"

    def __init__(self) -> None:
        super().__init__()
        self.identity = lambda x: x
