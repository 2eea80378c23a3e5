"""Points as comma-separated text that reads back bit for bit: with a header and indices, or the coordinates alone.

The coordinates alone are what Samplin' Safari reads: every line is a point, the first line says how many dimensions
there are (src/sampler/CSVFile.cpp in wkjarosz/SamplinSafari, which would take a header for a point).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import numpy as np
    from numpy.typing import NDArray

_ROWS = 1 << 14
"""Points of a piece: enough that the pieces cost nothing, few enough that their text stays below some megabytes."""


def csv_text(
    points: NDArray[np.float64], progress: Callable[[int, int], None] = lambda _done, _total: None
) -> Iterator[str]:
    """Give the points as text in pieces, so that the whole of it is never in memory.

    Parameters
    ----------
    points
        float64[R, N, D].
    progress
        Called with the numbers of points done and to do.

    Yields
    ------
    str
        The header ``realisation,index,x0,x1,...``, then whole lines ending in a line feed. Numbers are the shortest
        that read back as the same float64.
    """
    realizations, count, dims = points.shape
    yield ",".join(["realisation", "index", *(f"x{d}" for d in range(dims))]) + "\n"
    for r in range(realizations):
        for start in range(0, count, _ROWS):
            rows = points[r, start : start + _ROWS].tolist()
            yield "".join(f"{r},{index},{','.join(map(repr, row))}\n" for index, row in enumerate(rows, start))
            progress(r * count + start + len(rows), realizations * count)


def plain_csv_text(
    points: NDArray[np.float64], progress: Callable[[int, int], None] = lambda _done, _total: None
) -> Iterator[str]:
    """Give one set float64[N, D] as text in pieces: a line a point, and nothing but its coordinates.

    ``progress`` is called with the numbers of points done and to do.
    """
    for start in range(0, len(points), _ROWS):
        rows = points[start : start + _ROWS].tolist()
        yield "".join(f"{','.join(map(repr, row))}\n" for row in rows)
        progress(start + len(rows), len(points))
