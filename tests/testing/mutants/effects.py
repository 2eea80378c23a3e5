"""Mutants that do more than write points."""

from __future__ import annotations

import os
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


class SilencesNumpy(Mutant):
    """Turns off NumPy's warnings for everybody, from the first call on."""

    base, caught_by = "random", "purity"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        np.seterr(all="ignore")


class SharedBuffer(Mutant):
    """Makes sets in a buffer that two threads write at once."""

    base, caught_by = "random", "purity"

    def __init__(self) -> None:
        super().__init__()
        self.buffers: dict[tuple[int, ...], Array] = {}

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        buffer = self.buffers.setdefault(out.shape, np.empty_like(out))
        self.inner.fill(buffer, realizations, count, start)
        time.sleep(0.0005)
        out[:] = buffer


class DependsOnTheThreads(Mutant):
    """Has other points where the environment asks for one thread."""

    base, caught_by = "random", "determinism"

    def spoil(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        if os.environ.get("OMP_NUM_THREADS") == "1":
            out[:, 0] = (out[:, 0] + 0.5) % 1.0
