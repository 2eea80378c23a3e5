"""The expected spectrum: realisations in blocks, spread over threads, merged in their order.

Blocks, and the order in which they are merged, depend on the number of realisations alone, so that results do not
depend on threads. An interrupt stops every block after its current transform; what is done by then can be kept.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit import Realizations, SamplekitError, check_threads
from samplekit_spectrum.exponentials import add_sums
from samplekit_spectrum.frequencies import Cube, Frequencies, Listed
from samplekit_spectrum.moments import Moments
from samplekit_spectrum.sets import CHUNK, Sets, Source
from samplekit_spectrum.transform import LARGEST_WHOLE, Chunks, by_products, few_points, of_pair, of_slab, slabs

if TYPE_CHECKING:
    from numpy.typing import NDArray

Progress = Callable[[int, int], None]

_MOST_BLOCKS = 128
_LARGEST_BLOCK = 64
_BATCH_VALUES = 2**21


@dataclass(frozen=True, eq=False)
class View:
    """A spectrum of the sets projected on ``axes``, at ``frequencies``; ``weights`` as :class:`Moments` takes them."""

    axes: tuple[int, ...]
    frequencies: Frequencies
    weights: NDArray[np.float64] | None = None


@dataclass
class _Work:
    """State that the threads share."""

    stop: threading.Event
    lock: threading.Lock
    done: int = 0

    def tick(self, realizations: int) -> None:
        with self.lock:
            self.done += realizations


def expectations(
    source: Source,
    views: list[View],
    realizations: int,
    *,
    first: int = 0,
    threads: int | None = None,
    progress: Progress = lambda _, __: None,
    keep_interrupted: bool = False,
) -> list[Moments]:
    """The moments of each view over realisations first to first + realizations.

    Parameters
    ----------
    source, views
        Whose spectra, and which.
    realizations, first
        How many, and the number of the first.
    threads
        None: one for each processor. Results do not depend on it.
    progress
        Called with the numbers of realisations done and to do.
    keep_interrupted
        At an interrupt, return the moments of what is done instead of raising, if there is any.

    Raises
    ------
    UsageError
        The sampler cannot make such sets.
    SamplekitError
        The sampler failed, or there is too little memory.
    """
    source.sampler.check(source.count, source.dims)
    blocks = _blocks(first, realizations)
    workers = min(check_threads(threads), len(blocks))
    workers = _affordable(workers, source, views)
    source.sampler.prepare(source.count, source.dims)
    rings = [view.frequencies.rings() for view in views]
    work = _Work(threading.Event(), threading.Lock())
    totals = [Moments(ring, view.weights) for ring, view in zip(rings, views, strict=True)]
    waiting = iter(enumerate(blocks))
    running: dict[Future[list[Moments]], int] = {}
    finished: dict[int, list[Moments]] = {}
    merged = 0
    interrupted = False
    with ThreadPoolExecutor(workers) as pool:
        try:
            while True:
                # No block is started that would have to wait long for its turn to be merged.
                while len(running) < workers and (job := next(waiting, None)) is not None:
                    running[pool.submit(_block, source, views, rings, *job[1], work)] = job[0]
                if not running:
                    break
                ready, _ = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
                for future in ready:
                    finished[running.pop(future)] = future.result()
                while merged in finished:
                    _merge(totals, finished.pop(merged))
                    merged += 1
                progress(work.done, realizations)
        except KeyboardInterrupt:
            work.stop.set()
            interrupted = True
            for future, number in running.items():
                finished[number] = future.result()
            for number in sorted(finished):
                _merge(totals, finished[number])
        except BaseException:
            work.stop.set()
            raise
    if interrupted and not (keep_interrupted and totals[0].realizations > 0):
        raise KeyboardInterrupt
    return totals


def _merge(totals: list[Moments], block: list[Moments]) -> None:
    for total, moments in zip(totals, block, strict=True):
        total.merge(moments)


def _blocks(first: int, realizations: int) -> list[tuple[int, int]]:
    """Ranges of realisations: an even number in each, so that they pair up."""
    # A merge costs a few passes over the means: blocks are as long as they can be and still keep some threads busy.
    least = 2 if realizations <= 16 else 4 if realizations <= 64 else 8
    length = min(max(2 * -(-realizations // (2 * _MOST_BLOCKS)), least), _LARGEST_BLOCK)
    stop = first + realizations
    return [(start, min(start + length, stop)) for start in range(first, stop, length)]


def _affordable(workers: int, source: Source, views: list[View]) -> int:
    """As many threads as there is memory for.

    Raises
    ------
    SamplekitError
        There is too little for one.
    """
    import psutil

    kept = 40 * sum(view.frequencies.half for view in views)
    largest = max((v.frequencies.side * v.frequencies.row for v in views if isinstance(v.frequencies, Cube)), default=0)
    transform = 80 * min(largest, LARGEST_WHOLE)
    points = 8 * source.dims * 2 * (min(source.count, CHUNK) if source.sampler.streams else source.count) * 4
    available = 0.8 * psutil.virtual_memory().available
    each = kept + transform + points
    if kept + each > available:
        need, there = (kept + each) / 2**30, available / 2**30
        raise SamplekitError(
            f"this spectrum needs {need:.1f} GiB of memory and {there:.1f} are free: choose fewer frequencies or points"
        )
    return max(1, min(workers, int((available - kept) // each)))


def _block(
    source: Source, views: list[View], rings: list[NDArray[np.int32]], start: int, stop: int, work: _Work
) -> list[Moments]:
    block = [Moments(ring, view.weights) for ring, view in zip(rings, views, strict=True)]
    paired = any(
        isinstance(view.frequencies, Cube) and not few_points(view.frequencies, source.count) for view in views
    )
    batch = 2 if paired else max(2, min(_LARGEST_BLOCK, _BATCH_VALUES // (source.count * source.dims), _widest(views)))
    for begin in range(start, stop, batch):
        if work.stop.is_set():
            break
        members = min(batch, stop - begin)
        sets = Sets(source, Realizations.of_trials(begin, begin + members, source.seed))
        for view, moments in zip(views, block, strict=True):
            _add(view, moments, sets, members)
        work.tick(members)
    return block


def _widest(views: list[View]) -> int:
    """Realisations whose amplitudes fit into 64 MB."""
    return int(2**22 // max(min(view.frequencies.half, 2**22) for view in views))


def _add(view: View, moments: Moments, sets: Sets, members: int) -> None:
    cube, count = view.frequencies, sets.count
    if not isinstance(cube, Cube):
        moments.add([(0, _listed(cube, sets.of(view.axes), members))], members, count, exact_dc=False)
    elif few_points(cube, count):
        moments.add(((slab.start, by_products(sets.of(view.axes), cube, slab)) for slab in slabs(cube)), members, count)
    elif cube.side * cube.row <= LARGEST_WHOLE:
        moments.add_pair(of_pair(sets.of(view.axes), cube), members, count)
    else:
        for member in range(members):
            single = sets.of(view.axes, member)
            moments.add(((slab.start, of_slab(single, cube, slab)) for slab in slabs(cube)), 1, count)


def _listed(frequencies: Listed, chunks: Chunks, members: int) -> NDArray[np.complex128]:
    sums = np.zeros((members, frequencies.half), np.complex128)
    for points in chunks():
        for member in range(members):
            # Of listed frequencies x comes first.
            add_sums(frequencies.vectors, np.ascontiguousarray(points[member, ::-1]), sums[member])
    return sums
