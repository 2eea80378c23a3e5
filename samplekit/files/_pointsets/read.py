"""Read points from a file of the kind that its ending says: whatever `write_points` writes.

``.npy`` is NumPy's, ``.bin`` is UTK's, anything else is text.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._pointsets.npy import read_npy
from samplekit.files._pointsets.text import read_text
from samplekit.files._pointsets.utk_binary import read_utk_binary
from samplekit.files._pointsets.write import PICTURES
from samplekit.files._reading import errors_naming

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray


def read_points(path: Path) -> NDArray[np.float64]:
    """Read point sets.

    Parameters
    ----------
    path
        A file with sets of equal numbers of points.

    Returns
    -------
    float64[R, N, D], each of R, N and D at least 1, in [0, 1).

    Raises
    ------
    UsageError
        There is no such file, or it is a folder or of another kind; values are outside [0, 1) or NaN; rows differ in
        length.
    SamplekitError
        The file is damaged.
    """
    with errors_naming(path):
        points = _read(path)
        if points.size == 0:
            raise UsageError("it holds no points")
        _check_values(points)
        return points


def _read(path: Path) -> NDArray[np.float64]:
    ending = path.suffix.lower()
    if ending in PICTURES:
        raise UsageError("a picture does not hold the numbers of its points: expected .npy, .bin, or numbers as text")
    return {".npy": read_npy, ".bin": read_utk_binary}.get(ending, read_text)(path)


def _check_values(points: NDArray[np.float64]) -> None:
    inside = (points >= 0.0) & (points < 1.0)  # NaN is neither
    if inside.all():
        return
    index, point, dimension = (int(i) for i in np.argwhere(~inside)[0])
    value = float(points[index, point, dimension])
    raise UsageError(f"set {index}, point {point}, dimension {dimension} is {value!r}: expected values in [0, 1)")
