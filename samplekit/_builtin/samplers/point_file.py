"""Point sets from a file, to be analysed and rendered with like those of any sampler.

The file has R sets of N points in D dimensions (see :func:`samplekit.files.read_points` for its formats); no other N
and D can be made. Pixel (x, y) takes the set (x + a y + seed) modulo R. Here a is the number nearest to R divided by
the golden ratio that has no factor in common with R. So the pixels of a row, like trials, take one set after the other,
beginning with the set whose number is the seed; pixels with the same set lie on a lattice, far from each other.
"""

from __future__ import annotations

import hashlib
from dataclasses import replace
from itertools import count as count_from
from math import gcd
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from samplekit import Exactly, Realizations, Sampler, SamplerSpec, UsageError, parse_choice
from samplekit.files import read_points

Array = NDArray[np.float64]

_GOLDEN = (1 + 5**0.5) / 2


def row_step(sets: int) -> int:
    """Return by how many sets the first set of a row differs from that of the row above it."""
    nearest = round(sets / _GOLDEN)
    return next(a for d in count_from() for a in (nearest - d, nearest + d) if a >= 1 and gcd(a, sets) == 1)


class PointFile(Sampler):
    """The points of a file, in its order.

    Parameters
    ----------
    path
        The file, as on the command line.

    Raises
    ------
    UsageError
        The command line cannot express the path, or the file cannot be read.
    """

    def __init__(self, path: str) -> None:
        _check_text(path)
        self.path = path
        points = read_points(Path(path))
        self.sets, self.count, self.dims = points.shape
        self.points = np.ascontiguousarray(points.transpose(0, 2, 1))

    def refine(self, spec: SamplerSpec) -> SamplerSpec:
        """Declare the counts and dimensions of the file; its sets are random if there are several."""
        several = self.sets > 1
        return replace(
            spec,
            dimensions=(self.dims, self.dims),
            counts=Exactly(self.count),
            randomized=several,
            period=self.sets if several else None,
        )

    def check(self, count: int, dims: int, blocks: tuple[int, ...]) -> None:
        """Raise unless the file has sets of ``count`` points in ``dims`` dimensions.

        Raises
        ------
        UsageError
            The file has other sets: names them.
        """
        if (count, dims) != (self.count, self.dims):
            raise UsageError(f"{self.path} has {self._describe_sets()}, not {count} points in {dims}")

    def notes(self, count: int, dims: int) -> list[str]:
        """Say what the file contains, and which set a pixel takes."""
        digest = hashlib.sha256(self.points.tobytes()).hexdigest()[:16]
        note = f"points from a file: {self._describe_sets()}, sha256 of the numbers {digest}..."
        if self.sets == 1:
            return [note, "every pixel has the same points"]
        return [note, f"pixel (x, y) takes set (x + {row_step(self.sets)} y + seed) modulo {self.sets}"]

    def _describe_sets(self) -> str:
        sets = "one set" if self.sets == 1 else f"{self.sets} sets"
        return f"{sets} of {self.count} points in {self.dims} dimensions"

    def fill(self, out: Array, realizations: Realizations, count: int, start: int) -> None:
        """Write points of the sets; see :meth:`Sampler.fill`."""
        _, dims, points = out.shape
        self.check(count, dims, ())
        # Below 2^64: coordinates and the step are below 2^32.
        row = realizations.y % self.sets * row_step(self.sets)
        chosen = (realizations.x + row + realizations.seed % self.sets) % self.sets
        np.take(self.points[:, :, start : start + points], chosen, axis=0, out=out, mode="clip")


def _check_text(path: str) -> None:
    """Refuse a path that the command line cannot express: the text that is stored must choose the same file again.

    Raises
    ------
    UsageError
        The path has a comma, which ends an option, a plus sign before a letter, which begins a randomizer, or a space
        at its start or end.
    """
    try:
        choice = parse_choice(f"file:path={path}", "sampler")
        same = choice.options == {"path": path} and choice.randomizer is None
    except UsageError:
        same = False
    if not same:
        raise UsageError(
            f"file: path {path!r}: in NAME:option=value,...+RANDOMIZER a comma ends a value and a plus sign before a"
            " letter begins a randomizer: rename the file, or go to its folder"
        )
