"""Points of the subject made in another process: a fresh one, with another hash seed."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit._quoting import reason
from samplekit.testing._judge import judge_equal
from samplekit.testing._process import NoResultError, OtherProcess
from samplekit.testing._result import CheckFailed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from samplekit._specs import SamplerSpec
    from samplekit.testing._subject import Array, SamplerSubject

_SECONDS = 120.0
_COUNT, _DIMS, _REALIZATIONS, _SEED = 64, 3, 8, 3


def judge_elsewhere(subject: SamplerSubject, source: str, when: str) -> None:
    """Raise unless another process makes the same points from this source; see :func:`points_elsewhere`."""
    other = subject.elsewhere[source]
    if isinstance(other, str):
        raise CheckFailed(f"{when}: {other}")
    _, dims, count = other.shape
    judge_equal(subject, subject.sets(count, dims, _REALIZATIONS, seed=_SEED), other, count, when, seed=_SEED)


def points_elsewhere(subject: SamplerSubject) -> dict[str, Array | str]:
    """Make points in another process from two sources.

    Returns
    -------
    ``recipe``: from a sampler that is configured there; ``pickle``: from this process's sampler, pickled and sent. Each
    is float64[R, D, N], or a text that says why there are no points.
    """
    dims = subject.dims(_DIMS)
    (count,) = subject.counts(_COUNT, dims=dims)
    try:
        pickled: bytes | str = pickle.dumps(subject.sampler)
    except Exception as error:
        pickled = f"cannot be pickled: {reason(error)}"
    sources = {"recipe": subject.recipe, "pickle": pickled}
    other = OtherProcess(
        f"{__name__}:answer", sources, count, dims, seconds=_SECONDS, environment={"PYTHONHASHSEED": "4711"}
    )
    try:
        made: dict[str, Array | str] = other.one_result()
    except NoResultError as error:
        return dict.fromkeys(sources, str(error))
    return made


def answer(sources: dict[str, str | SamplerSpec | bytes], count: int, dims: int) -> Iterator[dict[str, Array | str]]:
    """Make the points from each source, or say why not; this runs in the other process."""
    made: dict[str, Array | str] = {}
    for name, source in sources.items():
        if name == "pickle" and isinstance(source, str):
            made[name] = source
            continue
        try:
            sampler = pickle.loads(source) if isinstance(source, bytes) else configured_sampler(source)
            sampler.prepare(count, dims)
            out = np.full((_REALIZATIONS, dims, count), np.nan)
            sampler.fill(out, Realizations.of_trials(0, _REALIZATIONS, _SEED), count, 0)
            made[name] = out
        except Exception as error:
            made[name] = reason(error)
    yield made
