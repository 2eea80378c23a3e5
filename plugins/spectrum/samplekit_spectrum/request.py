"""The request for a spectrum: its projections and frequencies, checked before any work is done."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit import UsageError
from samplekit_spectrum.frequencies import Cube, Frequencies, Listed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

LARGEST_REACH = 2**20
LARGEST_FREQUENCY = 2.0**40


def default_reach(count: int, dims: int) -> int:
    """The reach that shows a spectrum up to where it is flat: about four times the mean frequency of the points."""
    most = {1: 4096, 2: 512, 3: 32}[dims]
    least = {1: 32, 2: 32, 3: 8}[dims]
    wanted = 4.0 * count ** (1.0 / dims)
    return int(min(max(2 ** math.ceil(math.log2(max(wanted, 1.0))), least), most))


def check_integer(value: object, what: str, most: int, least: int = 1) -> None:
    """Raise unless ``value`` is an integer from ``least`` to ``most``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise UsageError(f"{what} {value}: expected an integer from {least} to {most}")


def axes_of(projects: Sequence[Sequence[int] | None], dims: int | None) -> tuple[list[tuple[int, ...]], int]:
    """The dimensions of each projection, and those of the sets."""
    if dims is not None:
        check_integer(dims, "dims", 2**20)
    least = max((max(project) + 1 for project in projects if project), default=2)
    size = int(dims) if dims is not None else least
    axes = []
    for project in projects:
        if project is None:
            if size > 3:
                raise UsageError(
                    f"a spectrum in {size} dimensions cannot be taken: choose two or three of them to project on"
                )
            axes.append(tuple(range(size)))
            continue
        pair = tuple(int(axis) for axis in project)
        if not 1 <= len(pair) <= 3 or len(set(pair)) != len(pair) or min(pair) < 0:
            raise UsageError(
                f"projection {','.join(map(str, pair))}: expected up to three different dimensions, from 0"
            )
        if max(pair) >= size:
            raise UsageError(f"projection {','.join(map(str, pair))}: the sets have {size} dimensions, 0 to {size - 1}")
        axes.append(pair)
    return axes, size


def frequencies_of(
    count: int, dims: int, max_frequency: int | None, step: float, listed: ArrayLike | None
) -> Frequencies:
    """The listed frequencies, or all multiples of ``step`` up to ``max_frequency`` times it."""
    if listed is not None:
        if max_frequency is not None or step != 1.0:
            raise UsageError("listed frequencies and a largest frequency or a step exclude each other")
        vectors = np.atleast_2d(np.asarray(listed, np.float64))
        if vectors.ndim != 2 or vectors.shape[1] != dims or vectors.size == 0:
            raise UsageError(f"frequencies of shape {list(vectors.shape)}: expected [K, {dims}]")
        if not np.all(np.abs(vectors) <= LARGEST_FREQUENCY):
            raise UsageError("a frequency is not finite, or larger than 2^40")
        return Listed(np.ascontiguousarray(vectors))
    if not (isinstance(step, (int, float)) and 0.0 < step <= LARGEST_FREQUENCY):
        raise UsageError(f"step {step}: expected a number above 0, up to 2^40")
    reach = default_reach(count, dims) if max_frequency is None else max_frequency
    check_integer(reach, "max-frequency", LARGEST_REACH)
    return Cube(dims, int(reach), float(step))
