"""Points of the subject with all its random bits forced to ones, or to zeros: they lie at the edges of their cells.

Another process replaces the hash of samplekit's sampling tools before the sampler is imported, with kernels that run as
plain Python, and NumPy's bit generators by one that gives the wanted words. Other sources of numbers are not forced.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._errors import SamplekitError
from samplekit.testing._process import NoResultError, run_elsewhere
from samplekit.testing._result import CheckFailed, NotApplicable

if TYPE_CHECKING:
    from collections.abc import Iterator

    from samplekit.testing._subject import Array, Recipe, SamplerSubject

_SECONDS = 60.0
_COUNTS = (1, 2, 3, 7, 16, 64, 97, 100)
_STATES = {0: 0, 2**64 - 1: 0x12DD9BB3}
"""States of a Mersenne twister that tempering turns into a word of zeros or of ones.

Matsumoto and Nishimura 1998, "Mersenne twister", section 2.1; tempering is one to one.
"""


def forced_extremes(subject: SamplerSubject) -> list[tuple[str, Array]]:
    """Make points with all random bits ones, and with all of them zeros.

    Returns
    -------
    For each count and kind of bits, which bits were forced, as the end of a message, and the points float64[R, D, N].

    Raises
    ------
    CheckFailed
        The sampler raises, or ends the process, where its random bits are constant.
    NotApplicable
        It gives no answer: a sampler that rejects points may loop for ever when its bits are constant.
    """
    dims = subject.dims(2)
    counts = subject.counts(*_COUNTS, dims=dims)
    request = (f"{__name__}:answer", subject.recipe, dims, counts)
    extremes: list[tuple[str, Array]] = []
    try:
        (extremes,) = run_elsewhere(*request, seconds=_SECONDS, environment={"NUMBA_DISABLE_JIT": "1"})
    except NoResultError as error:
        if error.problem.startswith("hangs"):
            raise NotApplicable(f"passed otherwise, but could not be judged with forced random bits: {error}") from None
        raise CheckFailed(f"with forced random bits: {error}") from None
    return extremes


def answer(recipe: Recipe, dims: int, counts: list[int]) -> Iterator[list[tuple[str, Array]]]:
    """Make the points; this runs in the other process."""
    from samplekit.kernels import _hashing as hashing

    warnings.simplefilter("ignore")
    word = np.uint64(0)

    def constant(*_: object) -> np.uint64:
        return word

    # Samplers take these by name when they are imported, which they are not yet.
    vars(hashing).update(mix64=constant, hash_index=constant)
    vars(np.random).update(Philox=lambda *_, **__: _constant_generator(int(word)))
    setattr(Realizations, "random_words", lambda self, number: np.full((len(self), number), word))  # noqa: B010
    made = []
    sampler = configured_sampler(recipe)  # type: ignore[arg-type]
    for pattern, bits in (("ones", 2**64 - 1), ("zeros", 0)):
        word = np.uint64(bits)
        for count in counts:
            out = np.full((2, dims, count), np.nan)
            try:
                sampler.fill(out, sampler.trials(0, 2, 0), count, 0)
            except SamplekitError:
                # Values outside [0, 1) are what the checks look for; any other error is seen without forced bits too.
                if not np.isfinite(out).all():
                    continue
            made.append((f" with random bits all {pattern}", out))
    yield made


def _constant_generator(word: int) -> np.random.MT19937:
    """Return a Mersenne twister whose next 624 words are all ones, or zeros: 312 doubles of 1 - 2^-53, or 0."""
    generator = np.random.MT19937(0)
    generator.state = {
        "bit_generator": "MT19937",
        "state": {"key": np.full(624, _STATES[word], np.uint32), "pos": 0},
    }
    return generator
