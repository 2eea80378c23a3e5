"""Points as NumPy's own array file: shape, type and every bit."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit.errors import SamplekitError

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit.images.files import Writer


def npy_writer(points: NDArray[np.float64]) -> Writer:
    """Make a writer for `samplekit.images.files.write_group` of float64[R, N, D], to be read with `numpy.load`."""
    points = np.ascontiguousarray(points, np.float64)

    def write(temporary: Path) -> None:
        # An open file, for given a path NumPy may change its ending.
        with temporary.open("wb") as file:
            np.save(file, points, allow_pickle=False)
        try:
            stored = np.load(temporary, allow_pickle=False)
        except (ValueError, EOFError) as error:
            raise SamplekitError(f"what was written cannot be read back: {error}") from None
        # As integers: NaN equals itself, and -0 is not 0.
        if stored.shape != points.shape or not np.array_equal(stored.view(np.uint64), points.view(np.uint64)):
            raise SamplekitError("what was read back is not what was written")

    return write
