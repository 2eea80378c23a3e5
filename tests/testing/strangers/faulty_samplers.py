"""The samplers of the plugin ``faulty``."""

import os
import time

import numpy as np

from samplekit import Sampler, UsageError


class Plain(Sampler):
    def draw(self, count, dims, rng):
        return rng.random((count, dims))


class Picky(Plain):
    def check(self, count, dims, blocks):
        if count >= 50:
            raise UsageError("fewer than 50 points only")


class Hangs(Plain):
    def draw(self, count, dims, rng):
        while count == 5:
            time.sleep(0.01)
        return super().draw(count, dims, rng)


class Crashes(Plain):
    def draw(self, count, dims, rng):
        if count == 5:
            os.abort()
        return super().draw(count, dims, rng)


class Exits(Plain):
    def draw(self, count, dims, rng):
        if count == 5:
            os._exit(7)
        return super().draw(count, dims, rng)


KEPT = []


class EatsMemory(Plain):
    def draw(self, count, dims, rng):
        if count == 5:
            for _ in range(100):
                KEPT.append(np.ones(1 << 23))
                time.sleep(0.02)
        return super().draw(count, dims, rng)


class Prints(Plain):
    def draw(self, count, dims, rng):
        # Past Python's own sys.stdout, as C libraries do.
        os.write(1, b"drawing\n")
        return super().draw(count, dims, rng)
