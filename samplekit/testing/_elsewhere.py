"""The subject in other processes: freshly started, with another hash seed; and with its random bits forced.

A process is started anew, never forked, and answers through a file: what the sampler prints cannot disturb the answer.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary

from samplekit.testing._declared import counts_of, dims_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit.testing._subject import Recipe, Subject

_SECONDS = 120.0
_EXTREME_SECONDS = 60.0
EXTREME_COUNTS = (1, 2, 3, 7, 16, 64, 97, 100)


@dataclass(frozen=True, eq=False)
class Extreme:
    """Points made while all random bits were ``pattern``: "ones" or "zeros"."""

    pattern: str
    count: int
    values: NDArray[np.float64]


class ElsewhereError(Exception):
    """The other process gave no answer; the message says why."""


_answers: WeakKeyDictionary[Any, dict[str, Any]] = WeakKeyDictionary()


def ask(request: dict[str, Any], *, seconds: float, environment: dict[str, str]) -> Any:
    """Run ``samplekit.testing._child`` on a request and give its answer.

    Raises
    ------
    ElsewhereError
        It hung, died or raised.
    """
    with tempfile.TemporaryDirectory(prefix="samplekit-") as folder:
        answer = Path(folder) / "answer"
        try:
            done = subprocess.run(
                [sys.executable, "-m", "samplekit.testing._child", str(answer)],
                input=pickle.dumps(request),
                capture_output=True,
                timeout=seconds,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path)), **environment},
                check=False,
            )
        except subprocess.TimeoutExpired:
            raise ElsewhereError(f"no answer from another process in {seconds:g} s") from None
        if not answer.exists():
            lines = done.stderr.decode(errors="replace").strip().splitlines()
            raise ElsewhereError(f"another process ended with status {done.returncode}: {lines[-1] if lines else ''}")
        result = pickle.loads(answer.read_bytes())
    if isinstance(result, Exception):
        raise ElsewhereError(str(result))
    return result


def points_elsewhere(subject: Subject, request: tuple[int, int, int, int]) -> dict[str, Any]:
    """The points of (count, dims, realisations, seed) made in another process, twice.

    Returns
    -------
    ``recipe``: by the sampler made there from its name or declaration; ``pickle``: by this sampler, pickled and
    sent. Each is float64[R, D, N], or a text that says why there are none.
    """
    kept = _answers.setdefault(subject, {})
    if "points" not in kept:
        try:
            pickled: bytes | str = pickle.dumps(subject.sampler)
        except Exception as error:
            pickled = f"cannot be pickled: {type(error).__name__}: {error}"
        payload = {"task": "points", "recipe": subject.recipe, "pickle": pickled, "request": request}
        kept["points"] = ask(payload, seconds=_SECONDS, environment={"PYTHONHASHSEED": "4711"})
    return dict(kept["points"])


def forced_extremes(subject: Subject) -> list[Extreme]:
    """Points made with all random bits ones, and zeros: from samplekit's hashing and from NumPy's generators.

    What a sampler draws by other means is not forced. Where constant bits make it loop for ever, as they may one that
    rejects, a note says so.
    """
    kept = _answers.setdefault(subject, {})
    if "extremes" not in kept:
        dims = dims_of(subject.spec, 2)
        counts = counts_of(subject.spec, EXTREME_COUNTS, dims)
        payload = {"task": "extremes", "recipe": subject.recipe, "dims": dims, "counts": counts}
        try:
            made = ask(payload, seconds=_EXTREME_SECONDS, environment={"NUMBA_DISABLE_JIT": "1"})
        except ElsewhereError as error:
            subject.note(f"not judged with forced random bits: {error}")
            made = []
        kept["extremes"] = [Extreme(*each) for each in made]
    return list(kept["extremes"])


def recipe_text(recipe: Recipe) -> str:
    """The subject's name as a user writes it."""
    return recipe if isinstance(recipe, str) else recipe.name
