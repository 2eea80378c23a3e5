"""Points as the binary file that UTK, the uniform sampling toolkit, reads and writes: files that end in ``.bin``.

Twenty bytes of header: the letters ``UTK!``, four bytes of which the first is the type of a number (4: float32,
5: float64, 0 to 3: integers), and the numbers of sets, of points in each and of dimensions as uint32; then the numbers,
point by point and set by set, all of it little-endian (utk-team.github.io/utk/usingutk/ExeUtk, "Details for binary file
format"; include/utk/utils/PointsetIO.hpp in utk-team/utk, whose own writer stores the first set in place of all).
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._writing import data_writer

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit.files._writing import Writer

_HEADER = struct.Struct("<4sB3xIII")
_MAGIC = b"UTK!"
_FLOAT64 = 5
_TYPES: dict[int, np.dtype[Any]] = {4: np.dtype("<f4"), _FLOAT64: np.dtype("<f8")}
_INTEGERS = range(4)
_MOST = 2**32 - 1


def utk_binary_writer(points: NDArray[np.float64]) -> Writer:
    """Make a writer for `samplekit.files.write_group` of float64[R, N, D].

    Raises
    ------
    UsageError
        The number of sets, points or dimensions is above 2^32 - 1.
    """
    if max(points.shape) > _MOST:
        raise UsageError(f"a .bin file holds at most {_MOST} sets, points and dimensions, not {max(points.shape)}")
    return data_writer([_HEADER.pack(_MAGIC, _FLOAT64, *points.shape), np.ascontiguousarray(points, "<f8").data])


def read_utk_binary(path: Path) -> NDArray[np.float64]:
    """Read points float64[R, N, D].

    Raises
    ------
    UsageError
        The file is no binary file of UTK, or it holds integers.
    SamplekitError
        The file is damaged.
    """
    data = path.read_bytes()
    if not data.startswith(_MAGIC):
        raise UsageError("it is no binary file of UTK, which begins with 'UTK!'")
    if len(data) < _HEADER.size:
        raise SamplekitError("it is damaged: it ends within its header")
    _, code, *shape = _HEADER.unpack_from(data)
    if code in _INTEGERS:
        raise UsageError("it holds integers: expected numbers in [0, 1)")
    if code not in _TYPES:
        raise SamplekitError(f"it is damaged: {code} is no type of number")
    dtype = _TYPES[code]
    expected = _HEADER.size + shape[0] * shape[1] * shape[2] * dtype.itemsize
    if len(data) != expected:
        sizes = " x ".join(map(str, shape))
        raise SamplekitError(f"it is damaged: {sizes} numbers take {expected} bytes, and it has {len(data)}")
    numbers: NDArray[Any] = np.frombuffer(data, dtype, offset=_HEADER.size)
    return numbers.reshape(shape).astype(np.float64)
