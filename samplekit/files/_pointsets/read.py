"""Read points from a file of the kind that its ending says: whatever `write_points` writes.

``.npy`` is NumPy's, ``.bin`` is UTK's, anything else is text.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._pointsets.write import PICTURES
from samplekit.files._writing import shown

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
        No such file, a folder, a file of another kind; values outside [0, 1) or NaN; rows of different lengths.
    SamplekitError
        The file is damaged.
    """
    try:
        if path.exists() and not path.is_file():  # opening a pipe would wait for its writer
            raise UsageError("it is a folder" if path.is_dir() else "it is not a regular file")
        points = _read(path)
        if points.size == 0:
            raise UsageError("it holds no points")
        _check_values(points)
    except (OSError, ValueError) as error:
        reason = (isinstance(error, OSError) and error.strerror) or str(error)
        raise UsageError(f"cannot read {shown(path)}: {reason}") from None
    except MemoryError:
        raise SamplekitError(f"cannot read {shown(path)}: no memory for so many points") from None
    except SamplekitError as error:
        raise type(error)(f"cannot read {shown(path)}: {error}") from None
    return points


def _read(path: Path) -> NDArray[np.float64]:
    ending = path.suffix.lower()
    if ending == ".npy":
        from samplekit.files._pointsets.npy import read_npy

        return read_npy(path)
    if ending == ".bin":
        from samplekit.files._pointsets.utk_binary import read_utk_binary

        return read_utk_binary(path)
    if ending in PICTURES:
        raise UsageError("a picture does not hold the numbers of its points: expected .npy, .bin, or numbers as text")
    from samplekit.files._pointsets.text import read_text

    return read_text(path)


def _check_values(points: NDArray[np.float64]) -> None:
    inside = (points >= 0.0) & (points < 1.0)  # NaN is neither
    if inside.all():
        return
    index, point, dimension = (int(i) for i in np.argwhere(~inside)[0])
    value = float(points[index, point, dimension])
    raise UsageError(f"set {index}, point {point}, dimension {dimension} is {value!r}: expected values in [0, 1)")
