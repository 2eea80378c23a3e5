"""The subject of the checks: a sampler or a scene. It counts the points that are drawn, and trusts no plugin."""

from __future__ import annotations

import heapq
import math
import time
from bisect import bisect_left
from collections.abc import Iterator
from functools import cached_property
from itertools import takewhile
from typing import Any

import numpy as np
from numpy.typing import NDArray

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import ConfiguredSampler
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._configured.scene import ConfiguredScene
from samplekit._configured.scene import scene as configured_scene
from samplekit._errors import InvalidPointsError, SamplekitError, UsageError
from samplekit._specs import SamplerSpec, SceneSpec
from samplekit.testing._forced_bits import forced_extremes
from samplekit.testing._result import CheckFailed, CounterExample, Kind, NotApplicable

Array = NDArray[np.float64]
Recipe = str | SamplerSpec | SceneSpec
"""What a user writes (``"sobol+owen"``), or the declaration of a sampler or scene that is not installed."""

_LARGEST_KEPT = 1 << 14
_LARGEST_JUDGED = 1 << 20
_SMALL = 4096
_MOST_GRID_DIMS = 12
"""A grid of two cells along each of this many dimensions has 4096 cells."""
_LARGEST_COUNTS = ((5e-4, _LARGEST_JUDGED), (0.02, 1 << 17), (0.2, 1 << 12), (1.0, 1 << 10))
"""Seconds that 256 points take at most, and the largest set that is then judged; work may grow as the square."""
_SECONDS_A_REQUEST = 1.5
_SECONDS_A_QUICK_REQUEST = 0.15


def spread_counts(largest: int, each: int) -> list[int]:
    """Return counts at all scales up to ``largest``: ``each`` in every octave that nobody would choose, rising.

    Faults begin at sizes where an author has chosen a limit, such as a power of two, or anywhere else.
    """
    rng = np.random.default_rng(97)
    octaves = range(1, max(largest, 2).bit_length())
    return sorted({min(int(2.0 ** (k + rng.random())), largest) for k in octaves for _ in range(each)})


class Subject:
    """What samplers and scenes that are judged have in common.

    Parameters
    ----------
    recipe
        What makes the subject, here and in other processes.
    configured
        The sampler or scene.
    quick
        Smaller samples, and no other processes.

    Attributes
    ----------
    drawn
        Number of points drawn so far.
    hints, notes
        Lists to which a check adds advice that is no failure, and remarks on how the subject was judged.
    """

    def __init__(self, recipe: Recipe, configured: ConfiguredSampler | ConfiguredScene, *, quick: bool) -> None:
        self.recipe = recipe
        self.spec = configured.spec
        self.text = configured.text
        self.plugin = configured.plugin
        self.quick = quick
        self.drawn = 0
        self.hints: list[str] = []
        self.notes: list[str] = []

    def note(self, text: str) -> None:
        """Add a remark on how the subject was judged, once."""
        if text not in self.notes:
            self.notes.append(text)


class SceneSubject(Subject):
    """A scene that is judged; see :class:`Subject`."""

    spec: SceneSpec

    def __init__(self, recipe: str | SceneSpec, *, quick: bool = False) -> None:
        self.scene = configured_scene(recipe)
        self.dims = self.scene.dims
        super().__init__(recipe, self.scene, quick=quick)

    def values(self, u: Array, box: Array) -> Array:
        """Return the integrand float64[M] at samples ``u`` float64[D, M] of the pixel ``box``.

        The box is left, width, top, height. Each sample is a pixel of one sample: a sum of one value is that value.
        """
        return self.sums(u.T[:, :, None], np.repeat(box[:, None], u.shape[1], axis=1))

    def sums(self, tile: Array, boxes: Array) -> Array:
        """Return the sum float64[P] over the samples of each pixel of a tile; the scene gets copies of the arrays."""
        self.drawn += tile.shape[0] * tile.shape[2]
        out = np.full(len(tile), np.nan)
        self.scene.sums(tile.copy(), boxes.copy(), out)
        return out

    def mean(self, u: Array, box: Array) -> float:
        """Return the mean over samples; the sum is rounded once."""
        return math.fsum(self.values(u, box).tolist()) / int(u.shape[1])


class SamplerSubject(Subject):
    """A sampler that is judged; see :class:`Subject`."""

    recipe: str | SamplerSpec
    spec: SamplerSpec

    def __init__(self, recipe: str | SamplerSpec, *, quick: bool = False) -> None:
        self.sampler = configured_sampler(recipe)
        super().__init__(recipe, self.sampler, quick=quick)
        self._prepared: set[tuple[int, int]] = set()
        self._extremes: list[tuple[str, Array]] | CheckFailed | NotApplicable | None = None

    def dims(self, wanted: int) -> int:
        """Return the declared number of dimensions nearest to ``wanted``."""
        least, most = self.spec.dimensions
        return max(least, wanted if most is None else min(wanted, most))

    def allows(self, count: int, dims: int) -> bool:
        """Tell whether sets of ``count`` points are declared."""
        return count <= self.spec.largest_index + 1 and self.spec.counts.allows(count, dims)

    def makes(self, count: int, dims: int, blocks: tuple[int, ...] = ()) -> bool:
        """Tell whether the sampler accepts a request: it may refuse some of what the rule for counts allows.

        An orthogonal array of s^2 points has at most s + 1 dimensions. The check ``limits`` judges refusals.
        """
        try:
            self.sampler.check(count, dims, blocks)
        except UsageError:
            return False
        return True

    def counts(self, *wanted: int, dims: int) -> list[int]:
        """Return for each wanted count the nearest that is declared and that the sampler makes: rising, each once.

        Counts that would take a slow sampler too long are left out.
        """
        affordable = [count for count in wanted if count <= 256 or count <= self.largest_count]
        near = (self._nearest_count(min(count, self.spec.largest_index + 1), dims) for count in affordable or [256])
        return sorted({count for count in near if count is not None})

    def _nearest_count(self, wanted: int, dims: int) -> int | None:
        """Return the nearest count up to 2^20, the smaller of two that are as near; None if there is none."""
        rising = takewhile(lambda count: count <= _LARGEST_JUDGED, self.spec.counts.rising(wanted, dims))
        falling = self._falling(min(wanted, _LARGEST_JUDGED) + 1, dims)
        nearest_first = heapq.merge(falling, rising, key=lambda count: abs(count - wanted))
        return next((count for count in nearest_first if self.makes(count, dims)), None)

    def _falling(self, count: int, dims: int) -> Iterator[int]:
        below = self.spec.counts.below(count, dims)
        while below is not None:
            yield below
            below = self.spec.counts.below(below, dims)

    def most_dims(self, limit: int) -> int:
        """Return the largest number of dimensions up to ``limit`` in which it makes some count up to 4096.

        A sampler whose grid spans all dimensions is asked for at most 12: two cells along each of them.
        """
        high = self.dims(limit)
        if self.spec.counts.depends_on_dims:
            return min(high, max(self.spec.dimensions[0], _MOST_GRID_DIMS))
        counts = [count for count in range(_SMALL, 0, -1) if self.spec.counts.allows(count, high)]
        low = self.dims(1)

        def refuses_all(dims: int) -> bool:
            return not any(self.makes(count, dims) for count in counts)

        return low + bisect_left(range(low + 1, high + 1), True, key=refuses_all)

    @cached_property
    def largest_count(self) -> int:
        """The largest set that is judged: smaller for a sampler that takes long for 256 points."""
        dims = self.dims(2)
        small, count = (self.counts(wanted, dims=dims)[0] for wanted in (16, 256))
        # Kernels are compiled for the small set; what is prepared for each count is counted in part.
        self.sets(small, dims, 1)
        began = time.process_time()
        self.sets(count, dims, 1)
        prepared = time.process_time()
        self.sets(count, dims, 1, first=1)
        seconds = max(time.process_time() - prepared, (prepared - began) / 16)
        largest = next((size for limit, size in _LARGEST_COUNTS if seconds < limit), 256)
        if largest < _LARGEST_COUNTS[1][1]:
            self.note(f"slow sampler ({seconds:.2g} s for {count} points): judged on sets of up to {largest} points")
        return largest

    @property
    def slow(self) -> bool:
        """Whether sets take so long that only small ones, of few counts and seeds, are judged."""
        return self.largest_count < _LARGEST_COUNTS[1][1]

    def fill(
        self,
        realizations: Realizations,
        count: int,
        dims: int,
        start: int = 0,
        points: int | None = None,
        *,
        sampler: ConfiguredSampler | None = None,
    ) -> Array:
        """Return points start to start + points of each set, float64[R, D, n], as the sampler wrote them.

        Raises
        ------
        CheckFailed
            The sampler raised, or left values unwritten.
        """
        if sampler is None and (count, dims) not in self._prepared:
            self.sampler.prepare(count, dims)
            self._prepared.add((count, dims))
        out = np.full((len(realizations), dims, count - start if points is None else points), np.nan)
        self.write(out, realizations, count, start, sampler or self.sampler)
        return out

    def write(self, out: Array, realizations: Realizations, count: int, start: int, sampler: ConfiguredSampler) -> None:
        """Have a sampler write the points from ``start`` on into ``out`` float64[R, D, n].

        Raises
        ------
        CheckFailed
            The sampler raised, or left values unwritten.
        """
        try:
            sampler.fill(out, realizations, count, start)
        except InvalidPointsError:
            # Rendering refuses values outside [0, 1); here the checks look for them.
            pass
        except SamplekitError as error:
            refusal = "refuses what it declares: " if isinstance(error, UsageError) else ""
            pixel = int(realizations.x[0]), int(realizations.y[0])
            example = self.request(count, out.shape[1], realizations.seed, pixel)
            raise CheckFailed(f"{refusal}{error}", example) from None
        self.drawn += out.shape[0] * out.shape[2]
        wrong = ~np.isfinite(out)
        if wrong.any():
            row, _, point = (int(i) for i in np.argwhere(wrong)[0])
            raise CheckFailed(
                f"{int(np.count_nonzero(wrong))} of {out.size} values are not written, or not finite",
                self.example(out, count, seed=realizations.seed, row=row, indices=(point,), start=start),
            )

    def sets(self, count: int, dims: int, realizations: int = 1, *, seed: int = 0, first: int = 0) -> Array:
        """Return whole sets float64[R, D, N] of the realisations first to first + R."""
        return self.fill(self.sampler.trials(first, first + realizations, seed), count, dims)

    def independent_sets(self, realizations: int, count: int, dims: int, batch: int) -> Iterator[Array]:
        """Yield independent sets, float64[at most ``batch``, D, N] at a time."""
        for first in range(0, realizations, batch):
            yield self.fill(self.sampler.trials(first, min(first + batch, realizations), 0), count, dims)

    def request(
        self, count: int, dims: int, seed: int = 0, realization: int | tuple[int, int] = 0, **details: Any
    ) -> CounterExample:
        """Return a counter-example that names a request, and what else is known."""
        return CounterExample(self.text, count, dims, seed, realization, **details)

    def example(
        self,
        values: Array,
        count: int,
        *,
        seed: int = 0,
        row: int = 0,
        first: int = 0,
        start: int = 0,
        indices: tuple[int, ...] = (),
        axes: tuple[int, ...] = (),
        **details: Any,
    ) -> CounterExample:
        """Return a counter-example in row ``row`` of ``values`` float64[R, D, n].

        ``first`` is the realisation of row 0; ``indices`` count from point ``start`` of the set.
        """
        points = values[row].T
        return self.request(
            count,
            int(values.shape[1]),
            seed,
            first + row,
            indices=tuple(start + i for i in indices),
            coordinates=tuple(tuple(float(x) for x in points[i, list(axes) or slice(None)][:8]) for i in indices),
            axes=axes,
            points=points.copy() if points.size <= _LARGEST_KEPT else None,
            start=start,
            **details,
        )

    def affordable(self, wanted: int, count: int, dims: int, least: int = 64, share: float = 1.0) -> int:
        """Return ``wanted`` realisations, or a power of four fewer where the sampler is slow; a note says so.

        ``share``: the time that these realisations may take, relative to that of a usual request.

        In steps of four, two machines give the same results unless one is about four times slower. The time is that of
        the processor, so that a busy machine gives the results of an idle one.
        """
        self.sets(count, dims)
        seconds = self._seconds_a_set(8, count, dims)
        if seconds < 1e-3:
            # The time of so few sets is that of the calls, not that of the sets.
            seconds = self._seconds_a_set(256, count, dims)
        budget = share * (_SECONDS_A_QUICK_REQUEST if self.quick else _SECONDS_A_REQUEST)
        realizations = wanted
        while realizations // 4 >= least and realizations * seconds > budget:
            realizations //= 4
        if realizations < wanted:
            self.note(f"slow sampler: {realizations} realisations of {count} points in place of {wanted}")
        return realizations

    def _seconds_a_set(self, sets: int, count: int, dims: int) -> float:
        began = time.process_time()
        self.sets(count, dims, sets)
        return (time.process_time() - began) / sets

    @property
    def extremes(self) -> list[tuple[str, Array]]:
        """Points made with all random bits ones, and zeros; none in a quick run. See :func:`forced_extremes`."""
        if self._extremes is None:
            try:
                self._extremes = [] if self.quick else forced_extremes(self)
            except (CheckFailed, NotApplicable) as problem:
                # Other checks that ask give the same answer, without the time that it takes.
                self._extremes = problem
        if isinstance(self._extremes, Exception):
            raise self._extremes
        return self._extremes


def make_subject(recipe: Recipe, kind: Kind, *, quick: bool = False) -> SamplerSubject | SceneSubject:
    """Return the subject of a recipe.

    Raises
    ------
    UsageError
        An unknown name or option.
    """
    return (SamplerSubject if kind == "sampler" else SceneSubject)(recipe, quick=quick)  # type: ignore[arg-type]
