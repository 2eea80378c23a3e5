"""Points as NumPy's own array file: shape, type and every bit."""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._writing import data_writer

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit.files._writing import Writer

_MAGIC = b"\x93NUMPY"
_HEADERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


def npy_writer(points: NDArray[np.float64]) -> Writer:
    """Make a writer for `samplekit.files.write_group` of float64[R, N, D], to be read with `numpy.load`."""
    points = np.ascontiguousarray(points)
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, np.lib.format.header_data_from_array_1_0(points))
    return data_writer([header.getvalue(), points.data])


def read_npy(path: Path) -> NDArray[np.float64]:
    """Read points float64[R, N, D] from an array [R, N, D] or [N, D] of floating-point numbers.

    Raises
    ------
    UsageError
        The file is of another kind, or its array is; Python objects are never unpickled.
    SamplekitError
        The file is damaged.
    """
    with path.open("rb") as file:
        if file.read(len(_MAGIC)) != _MAGIC:
            raise UsageError("it is no array file of NumPy")
        file.seek(0)
        try:
            header = _HEADERS[np.lib.format.read_magic(file)]
            shape, fortran, dtype = header(file)
        except Exception as error:  # what a damaged header makes of the parser has many types
            raise SamplekitError(f"it is damaged: its header cannot be read ({type(error).__name__})") from None
        data = file.read()
    if dtype.kind != "f":
        raise UsageError(f"it holds {'Python objects' if dtype.hasobject else dtype}: expected floating-point numbers")
    if len(shape) not in (2, 3):
        sizes = ", ".join(map(str, shape))
        raise UsageError(f"its array has shape [{sizes}]: expected [points, dimensions] or [sets, points, dimensions]")
    if min(shape) < 1:
        raise UsageError("it holds no points")
    expected = math.prod(shape) * dtype.itemsize
    if len(data) != expected:
        raise SamplekitError(f"it is damaged: its numbers take {expected} bytes, and it has {len(data)}")
    array = np.frombuffer(data, dtype).reshape(shape, order="F" if fortran else "C")
    return np.ascontiguousarray(array if len(shape) == 3 else array[None], np.float64)
