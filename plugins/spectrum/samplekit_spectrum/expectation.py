"""The expected spectrum: threads transform blocks of realisations, which are merged in their order.

The blocks and their order depend on the number of realisations alone, so results do not depend on the number of
threads. An interrupt stops every block after its current transform. What is done by then can be kept.
"""

from __future__ import annotations

import threading
from collections import deque
from concurrent.futures import ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit import SamplekitError, check_threads
from samplekit_spectrum.frequencies import Cube, Frequencies
from samplekit_spectrum.moments import Moments
from samplekit_spectrum.point_sets import CHUNK, PointSets, Source
from samplekit_spectrum.transform import LARGEST_WHOLE, amplitudes, few_points

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Future

    import numpy as np
    from numpy.typing import NDArray

_MOST_BLOCKS = 128
_LARGEST_BLOCK = 64
_BATCH_VALUES = 2**21
_BATCH_AMPLITUDES = 2**22
"""Coordinates, and amplitudes of a projection, that a thread holds at once if there are few points: 16 and 64 MB."""


@dataclass(frozen=True, eq=False)
class Projection:
    """Which spectrum is computed: that of the sets projected on ``axes``, at ``frequencies``.

    ``weights`` are those of :class:`Moments`.
    """

    axes: tuple[int, ...]
    frequencies: Frequencies
    weights: NDArray[np.float64] | None = None


class SharedState:
    """State that the threads share: whether they are to stop, and how many realisations are done."""

    def __init__(self) -> None:
        self.stop = threading.Event()
        self.done = 0
        self._lock = threading.Lock()

    def add(self, realizations: int) -> None:
        """Count realisations as done."""
        with self._lock:
            self.done += realizations


def expectations(
    source: Source,
    projections: Sequence[Projection],
    realizations: int,
    *,
    first: int = 0,
    threads: int | None = None,
    progress: Callable[[int, int], None] = lambda _, __: None,
    keep_interrupted: bool = False,
) -> list[Moments]:
    """Return the moments of each projection over realisations first to first + realizations.

    Parameters
    ----------
    source, projections
        The sets, which the sampler can make, and the spectra to compute.
    realizations, first
        Number of realisations, and the number of the first one.
    threads
        Number of threads; None: one for each processor. Results do not depend on it.
    progress
        Called with the numbers of realisations done and to do.
    keep_interrupted
        If an interrupt arrives and at least one realisation is done, return the moments so far instead of raising.

    Raises
    ------
    UsageError
        The number of threads is out of range.
    SamplekitError
        The sampler failed, or there is too little memory.
    """
    blocks = _blocks(first, realizations)
    workers = _affordable(min(check_threads(threads), len(blocks)), source, projections)
    source.sampler.prepare(source.count, source.dims)
    rings = [projection.frequencies.rings() for projection in projections]
    state = SharedState()
    totals = _moments(projections, rings)
    waiting = iter(blocks)
    futures: deque[Future[list[Moments]]] = deque()
    with ThreadPoolExecutor(workers) as pool:
        try:
            while True:
                # One block more than there are threads, so that no thread waits for a block to be merged.
                while len(futures) <= workers and (block := next(waiting, None)) is not None:
                    futures.append(pool.submit(block_moments, source, projections, rings, *block, state))
                if not futures:
                    return totals
                wait([futures[0]], timeout=0.2)
                while futures and futures[0].done():
                    _merge(totals, futures.popleft().result())
                progress(state.done, realizations)
        except KeyboardInterrupt:
            state.stop.set()
            for future in futures:
                _merge(totals, future.result())
            if keep_interrupted and totals[0].realizations > 0:
                return totals
            raise
        except BaseException:
            state.stop.set()
            raise


def _moments(projections: Sequence[Projection], rings: list[NDArray[np.int32]]) -> list[Moments]:
    return [Moments(ring, projection.weights) for ring, projection in zip(rings, projections, strict=True)]


def _merge(totals: list[Moments], block: list[Moments]) -> None:
    for total, moments in zip(totals, block, strict=True):
        total.merge(moments)


def _blocks(first: int, realizations: int) -> list[tuple[int, int]]:
    """Divide the realisations into ranges, each with an even number of them so that they form pairs."""
    # A merge costs a few passes over the means, so blocks are as long as they can be while they keep threads busy.
    least = 2 if realizations <= 16 else 4 if realizations <= 64 else 8
    length = min(max(2 * -(-realizations // (2 * _MOST_BLOCKS)), least), _LARGEST_BLOCK)
    stop = first + realizations
    return [(start, min(start + length, stop)) for start in range(first, stop, length)]


def _affordable(workers: int, source: Source, projections: Sequence[Projection]) -> int:
    """Return the number of threads for which there is memory, at most ``workers``.

    Raises
    ------
    SamplekitError
        There is too little memory for one thread.
    """
    import psutil

    cubes = [projection.frequencies for projection in projections]
    kept = 40 * sum(cube.half for cube in cubes)
    transform = 80 * min(max(cube.size if isinstance(cube, Cube) else 0 for cube in cubes), LARGEST_WHOLE)
    points = 8 * source.dims * 2 * (min(source.count, CHUNK) if source.sampler.streams else source.count) * 4
    available = 0.8 * psutil.virtual_memory().available
    each = kept + transform + points
    if kept + each > available:
        need, there = (kept + each) / 2**30, available / 2**30
        raise SamplekitError(
            f"this spectrum needs {need:.1f} GiB of memory and {there:.1f} are free: choose fewer frequencies or points"
        )
    return max(1, min(workers, int((available - kept) // each)))


def block_moments(
    source: Source,
    projections: Sequence[Projection],
    rings: list[NDArray[np.int32]],
    start: int,
    stop: int,
    state: SharedState,
) -> list[Moments]:
    """Return the moments of each projection over realisations ``start`` to ``stop``, or over fewer if interrupted."""
    block = _moments(projections, rings)
    frequencies = [projection.frequencies for projection in projections]
    if any(isinstance(cube, Cube) and not few_points(cube, source.count) for cube in frequencies):
        # The non-uniform FFT transforms pairs.
        batch = 2
    else:
        fitting = _BATCH_AMPLITUDES // max(min(cube.half, _BATCH_AMPLITUDES) for cube in frequencies)
        batch = max(2, min(_LARGEST_BLOCK, _BATCH_VALUES // (source.count * source.dims), fitting))
    for begin in range(start, stop, batch):
        if state.stop.is_set():
            break
        end = min(begin + batch, stop)
        sets = PointSets(source, begin, end)
        for projection, moments in zip(projections, block, strict=True):
            cube = projection.frequencies
            parts = amplitudes(sets, projection.axes, cube)
            moments.add(parts, end - begin, source.count, exact_dc=isinstance(cube, Cube))
        state.add(end - begin)
    return block
