"""The subject of a run: a sampler whose points are drawn through one door, counted, and never trusted."""

from __future__ import annotations

import contextlib
import time
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._errors import InvalidPointsError, SamplekitError, UsageError
from samplekit._specs import SamplerSpec
from samplekit.testing._declared import counts_of, dims_of, most_dims
from samplekit.testing._result import CheckFailed, CounterExample

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from samplekit._configured.sampler import ConfiguredSampler

Recipe = str | SamplerSpec
"""What a user writes (``"sobol+owen"``), or the declaration of a sampler that is not installed."""

_LARGEST_KEPT = 1 << 14
_SMALL = 4096
_LARGEST_COUNTS = ((0.02, 1 << 17), (0.2, 1 << 12), (1.0, 1 << 10))
"""Seconds that 256 points take at most, and the largest set that is then judged; work may grow as the square."""
_SECONDS_A_REQUEST = 1.5
_SECONDS_A_QUICK_REQUEST = 0.15


class Subject:
    """A sampler under judgement.

    Parameters
    ----------
    recipe
        What makes the sampler, here and in other processes: what a user writes, or the declaration of one that is not
        installed.
    quick
        Smaller samples, and no other processes.
    """

    def __init__(self, recipe: Recipe, *, quick: bool = False) -> None:
        self.recipe = recipe
        self.sampler = sampler = configured_sampler(recipe)
        self.spec = sampler.spec
        self.text = sampler.text
        self.quick = quick
        self.drawn = 0
        self.hints: list[str] = []
        self.notes: list[str] = []
        self._prepared: set[tuple[int, int]] = set()

    def dims(self, wanted: int) -> int:
        """The number of dimensions nearest to ``wanted`` that is declared."""
        return dims_of(self.spec, wanted)

    def counts(self, *wanted: int, dims: int) -> list[int]:
        """The declared counts nearest to those wanted, without those that would take a slow sampler too long."""
        affordable = tuple(count for count in wanted if count <= 256 or count <= self.largest_count)
        return counts_of(self.spec, affordable or (256,), dims, lambda count: self.makes(count, dims))

    def makes(self, count: int, dims: int) -> bool:
        """Whether the sampler accepts a request: an orthogonal array of s^2 points has at most s + 1 dimensions, say.

        What it may not refuse is judged by the check of its limits.
        """
        try:
            self.sampler.check(count, dims)
        except UsageError:
            return False
        return True

    def most_dims(self, limit: int) -> int:
        """The largest number of dimensions up to ``limit`` in which it makes some count up to 4096."""
        high = most_dims(self.spec, limit)
        if self.spec.counts.depends_on_dims:
            return high
        counts = [count for count in range(_SMALL, 0, -1) if self.spec.counts.allows(count, high)]
        low = min(self.dims(1), high)
        while low < high:
            middle = (low + high + 1) // 2
            if any(self.makes(count, middle) for count in counts):
                low = middle
            else:
                high = middle - 1
        return low

    @cached_property
    def largest_count(self) -> int:
        """The size of set up to which this sampler is judged: less for one that takes long for 256 points."""
        dims = self.dims(2)
        small, count = (counts_of(self.spec, (wanted,), dims)[0] for wanted in (16, 256))
        # What is compiled is compiled for the small set; what is prepared for each count is counted in part.
        self.sets(small, dims, 1)
        began = time.process_time()
        self.sets(count, dims, 1)
        prepared = time.process_time()
        self.sets(count, dims, 1, first=1)
        seconds = max(time.process_time() - prepared, (prepared - began) / 16)
        largest = next((size for limit, size in _LARGEST_COUNTS if seconds < limit), 256)
        if largest < _LARGEST_COUNTS[0][1]:
            self.note(f"slow sampler ({seconds:.2g} s for {count} points): judged on sets of up to {largest} points")
        return largest

    def fill(
        self,
        realizations: Realizations,
        count: int,
        dims: int,
        start: int = 0,
        points: int | None = None,
        *,
        sampler: ConfiguredSampler | None = None,
        unwritten_ok: bool = False,
    ) -> NDArray[np.float64]:
        """Points start to start + points of each set, float64[R, D, n], as the sampler wrote them.

        Raises
        ------
        CheckFailed
            The sampler raised, or left values unwritten.
        """
        source = sampler or self.sampler
        number = count - start if points is None else points
        if sampler is None and (count, dims) not in self._prepared:
            source.prepare(count, dims)
            self._prepared.add((count, dims))
        out = np.full((len(realizations), dims, number), np.nan)
        try:
            source.fill(out, realizations, count, start)
        except UsageError as error:
            raise CheckFailed(f"refuses what it declares: {error}", self.request(count, dims, realizations)) from None
        except InvalidPointsError as error:
            # Rendering refuses values outside [0, 1); here they are evidence.
            if not np.isfinite(out).all():
                raise CheckFailed(str(error), self.request(count, dims, realizations)) from None
        except SamplekitError as error:
            raise CheckFailed(str(error), self.request(count, dims, realizations)) from None
        self.drawn += len(realizations) * number
        if not unwritten_ok and np.isnan(out).any():
            row, _, point = (int(i) for i in np.argwhere(np.isnan(out))[0])
            raise CheckFailed(
                "left a value unwritten, or wrote NaN",
                self.example(out, count, seed=realizations.seed, row=row, indices=(point,), start=start),
            )
        return out

    def sets(
        self, count: int, dims: int, realizations: int = 1, *, seed: int = 0, first: int = 0
    ) -> NDArray[np.float64]:
        """Whole sets float64[R, D, N] of the realisations first to first + R."""
        return self.fill(Realizations.of_trials(first, first + realizations, seed), count, dims)

    def independent(self, first: int, stop: int, seed: int = 0) -> Realizations:
        """Realisations that know nothing of each other: pixels of different blocks, where pixels share a sequence."""
        x = np.arange(first, stop, dtype=np.int64) * (self.spec.screen_block or 1)
        return Realizations.of_pixels(x, np.zeros_like(x), seed)

    def request(self, count: int, dims: int, realizations: Realizations) -> CounterExample:
        """A counter-example that names the request alone."""
        return CounterExample(self.text, count, dims, realizations.seed, int(realizations.x[0]))

    def example(
        self,
        values: NDArray[np.float64],
        count: int,
        *,
        seed: int = 0,
        row: int = 0,
        first: int = 0,
        start: int = 0,
        indices: tuple[int, ...] = (),
        axes: tuple[int, ...] = (),
        box: tuple[tuple[float, float], ...] = (),
    ) -> CounterExample:
        """A counter-example in row ``row`` of ``values`` float64[R, D, n]; ``indices`` count from ``start``."""
        points = values[row].T
        places = tuple(tuple(float(x) for x in points[i, list(axes) or slice(None)][:8]) for i in indices)
        kept = points.copy() if points.size <= _LARGEST_KEPT else None
        return CounterExample(
            self.text,
            count,
            int(values.shape[1]),
            seed,
            first + row,
            tuple(start + i for i in indices),
            places,
            axes,
            box,
            kept,
        )

    def affordable(self, wanted: int, count: int, dims: int, least: int = 64) -> int:
        """``wanted`` realisations, or a power of four fewer where the sampler is slow; says so in a note.

        The ladder keeps results comparable: two machines differ only where one is four times slower. Time is the
        processor's, so that a busy machine judges as an idle one does.
        """
        self.fill(Realizations.of_trials(0, 1, 0), count, dims)
        seconds = self._seconds_a_set(8, count, dims)
        if seconds < 1e-3:
            # So few sets measure what a call costs, not a set.
            seconds = self._seconds_a_set(256, count, dims)
        budget = _SECONDS_A_QUICK_REQUEST if self.quick else _SECONDS_A_REQUEST
        realizations = wanted
        while realizations // 4 >= least and realizations * seconds > budget:
            realizations //= 4
        if realizations < wanted:
            self.note(f"slow sampler: {realizations} realisations of {count} points in place of {wanted}")
        return realizations

    def _seconds_a_set(self, sets: int, count: int, dims: int) -> float:
        began = time.process_time()
        self.fill(Realizations.of_trials(0, sets, 0), count, dims)
        return (time.process_time() - began) / sets

    def note(self, text: str) -> None:
        """What a reader should know of how the judgement was made."""
        if text not in self.notes:
            self.notes.append(text)

    def hint(self, text: str) -> None:
        """Advice that is no failure."""
        self.hints.append(text)


@contextlib.contextmanager
def raising_is_failing(what: str) -> Iterator[None]:
    """Turn any exception inside into a failed check, with its kind and text."""
    try:
        yield
    except CheckFailed:
        raise
    except Exception as error:
        raise CheckFailed(f"{what}: {type(error).__name__}: {' '.join(str(error).split())}") from error
