"""Keep means over pixels that took long in the cache folder: see :func:`samplekit.files.cached_array`."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from samplekit.quadrature import _pixel_means as adaptive

Array = NDArray[np.float64]

_QUICK = 2**13
"""Number of pixels that take less than a second."""


def kept_means(
    parameters: str,
    sources: tuple[str, ...],
    function: adaptive.Function,
    x_edges: Array,
    y_edges: Array,
    *,
    known: Array,
    curves: adaptive.Curves,
    largest: float,
    orders: tuple[int, int] = (3, 5),
    tolerance: float = 1e-6,
) -> Array:
    """Return the means of :func:`pixel_means`, from the cache if there are many and they are there.

    Parameters
    ----------
    parameters, sources
        Everything that the function depends on: its parameters, and the files that hold its code. The name of the
        first file is part of the name of the kept file.
    function, x_edges, y_edges, known, curves, largest, orders, tolerance
        As for :func:`pixel_means`.
    """

    def make() -> Array:
        return adaptive.pixel_means(
            function,
            x_edges,
            y_edges,
            known=known,
            curves=curves,
            largest=largest,
            orders=orders,
            tolerance=tolerance,
        )[0]

    if np.count_nonzero(np.isnan(known)) <= _QUICK:
        return make()
    from samplekit.files._cache import cached_array

    digest = hashlib.sha256(f"{parameters} {largest} {orders} {tolerance}".encode())
    for array in (x_edges, y_edges, known):
        digest.update(str(array.shape).encode() + array.tobytes())
    package = Path(adaptive.__file__).parent.parent
    files = [Path(adaptive.__file__), package / "quadrature" / "_pieces.py", *map(Path, sources)]
    for path in [*files, *sorted((package / "kernels").glob("*.py"))]:
        digest.update(path.read_bytes())
    return cached_array(
        Path(sources[0]).stem.replace("_", "-"),
        digest.hexdigest(),
        make,
        lambda kept: kept.shape == known.shape and kept.dtype == np.float64,
    )
