"""Check the request for a spectrum, its projections and frequencies, before any work is done."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit import UsageError
from samplekit_spectrum.frequencies import Cube, Frequencies, FrequencyList

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

LARGEST_REACH = 2**20
LARGEST_FREQUENCY = 2.0**40


def default_reach(count: int, dims: int) -> int:
    """Return the reach up to where most spectra are flat: about four times the mean frequency of the points."""
    least, most = {1: (32, 4096), 2: (32, 512), 3: (8, 32)}[dims]
    return int(min(max(2 ** math.ceil(math.log2(4.0 * count ** (1.0 / dims))), least), most))


def check_integer(value: object, what: str, most: int, least: int = 1) -> None:
    """Raise unless ``value`` is an integer from ``least`` to ``most``."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise UsageError(f"{what} {value}: expected an integer from {least} to {most}")


def axes_of(projects: Sequence[Sequence[int] | None], dims: int | None) -> tuple[list[tuple[int, ...]], int]:
    """Return the dimensions of each projection, and the number of dimensions of the sets.

    Raises
    ------
    UsageError
        A projection is not on one to three different dimensions of the sets.
    """
    if dims is not None:
        check_integer(dims, "dims", 2**20)
    size = int(dims) if dims is not None else max((max(project) + 1 for project in projects if project), default=2)
    if size > 3 and any(project is None for project in projects):
        raise UsageError(f"a spectrum in {size} dimensions cannot be taken: choose two or three of them to project on")
    axes = [tuple(range(size)) if project is None else tuple(map(int, project)) for project in projects]
    for chosen in axes:
        shown = f"projection {','.join(map(str, chosen))}"
        if not 1 <= len(chosen) <= 3 or len(set(chosen)) != len(chosen) or min(chosen) < 0:
            raise UsageError(f"{shown}: expected up to three different dimensions, from 0")
        if max(chosen) >= size:
            raise UsageError(f"{shown}: the sets have {size} dimensions, 0 to {size - 1}")
    return axes, size


def frequencies_of(
    count: int, dims: int, max_frequency: int | None, step: float, listed: ArrayLike | None
) -> Frequencies:
    """Return the listed frequencies, or all multiples of ``step`` up to ``max_frequency`` times ``step``.

    Raises
    ------
    UsageError
        The frequencies are too large, or have another number of dimensions, or the settings exclude each other.
    """
    if listed is not None:
        if max_frequency is not None or step != 1.0:
            raise UsageError("listed frequencies and a largest frequency or a step exclude each other")
        vectors = np.atleast_2d(np.asarray(listed, np.float64))
        if vectors.ndim != 2 or vectors.shape[1] != dims or vectors.size == 0:
            raise UsageError(f"frequencies of shape {list(vectors.shape)}: expected [K, {dims}]")
        if not np.all(np.abs(vectors) <= LARGEST_FREQUENCY):
            raise UsageError("a frequency is not finite, or larger than 2^40")
        return FrequencyList(np.ascontiguousarray(vectors))
    if not (isinstance(step, (int, float)) and 0.0 < step <= LARGEST_FREQUENCY):
        raise UsageError(f"step {step}: expected a number above 0, up to 2^40")
    reach = default_reach(count, dims) if max_frequency is None else max_frequency
    check_integer(reach, "max-frequency", LARGEST_REACH)
    return Cube(dims, int(reach), float(step))
