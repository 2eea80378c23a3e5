"""Points of the subject made in another process: a fresh one, with another hash seed and number of threads."""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np

from samplekit._configured.sampler import ConfiguredSampler
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._quoting import reason
from samplekit._specs import SamplerSpec
from samplekit.testing._judge import judge_equal
from samplekit.testing._process import NoResultError, run_elsewhere
from samplekit.testing._result import CheckFailed
from samplekit.testing._subject import Array, SamplerSubject

_SECONDS = 120.0
_COUNT, _DIMS, _REALIZATIONS, _SEED = 64, 3, 8, 3


def judge_elsewhere(subject: SamplerSubject, source: str | SamplerSpec | ConfiguredSampler, when: str) -> None:
    """Raise unless another process makes the same points.

    Parameters
    ----------
    source
        What the other process receives, pickled: the recipe, so that it configures the sampler itself, or the sampler.
    when
        How the points were made there, as the beginning of a message.

    Raises
    ------
    CheckFailed
        The points differ, or the other process has none.
    """
    dims = subject.dims(_DIMS)
    (count,) = subject.counts(_COUNT, dims=dims)
    threads = "2" if os.environ.get("OMP_NUM_THREADS") == "1" else "1"
    environment = {"PYTHONHASHSEED": "4711", "OMP_NUM_THREADS": threads, "NUMBA_NUM_THREADS": "1", "TZ": "Asia/Tokyo"}
    try:
        (points,) = run_elsewhere(f"{__name__}:answer", source, count, dims, seconds=_SECONDS, environment=environment)
    except NoResultError as error:
        points = str(error)
    if isinstance(points, str):
        raise CheckFailed(f"{when}: {points}")
    judge_equal(subject, subject.sets(count, dims, _REALIZATIONS, seed=_SEED), points, count, when, seed=_SEED)


def answer(source: str | SamplerSpec | ConfiguredSampler, count: int, dims: int) -> Iterator[Array | str]:
    """Yield the points float64[R, D, N], or a text that says why there are none; this runs in the other process."""
    try:
        sampler = configured_sampler(source)
        sampler.prepare(count, dims)
        out = np.full((_REALIZATIONS, dims, count), np.nan)
        sampler.fill(out, sampler.trials(0, _REALIZATIONS, _SEED), count, 0)
        yield out
    except Exception as error:
        yield reason(error)
