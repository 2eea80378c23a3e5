"""Points as the text that UTK, the uniform sampling toolkit, reads and writes: files that end in ``.dat``.

A line a point, its coordinates separated by spaces; a line ``#`` between one realisation and the next, none after the
last (utk-team.github.io/utk/usingutk/ExeUtk, "File formats"; include/utk/utils/PointsetIO.hpp in utk-team/utk, whose
reader would take an empty line for a point). `samplekit.files._pointsets.text` reads it back.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy as np
    from numpy.typing import NDArray

_ROWS = 1 << 14


def utk_text(
    points: NDArray[np.float64], progress: Callable[[int, int], None] = lambda _done, _total: None
) -> Iterator[str]:
    """Give points float64[R, N, D] as text in pieces; numbers are the shortest that read back as the same float64.

    ``progress`` is called with the numbers of points done and to do.
    """
    realizations, count, _ = points.shape
    for r in range(realizations):
        if r > 0:
            yield "#\n"
        for start in range(0, count, _ROWS):
            rows = points[r, start : start + _ROWS].tolist()
            yield "".join(f"{' '.join(map(repr, row))}\n" for row in rows)
            progress(r * count + start + len(rows), realizations * count)
