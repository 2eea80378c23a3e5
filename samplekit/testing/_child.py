"""What runs in the other process of ``elsewhere``: reads a request from its standard input, writes an answer to a file.

To force random bits it replaces the hash of samplekit's sampling tools before the sampler is imported, with kernels run
as plain Python, and NumPy's bit generators by one that gives the wanted words.
"""

from __future__ import annotations

import pickle
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._errors import SamplekitError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from samplekit.testing._subject import Recipe

ALL_ONES = 2**64 - 1


def main() -> None:
    """Answer one request."""
    request = pickle.loads(sys.stdin.buffer.read())
    answer: Any
    try:
        tasks: dict[str, Callable[..., Any]] = {"points": _points, "extremes": _extremes}
        answer = tasks[request.pop("task")](**request)
    except Exception as error:
        answer = RuntimeError(f"{type(error).__name__}: {' '.join(str(error).split())}")
    Path(sys.argv[1]).write_bytes(pickle.dumps(answer))


def _points(recipe: Recipe, pickle: bytes | str, request: tuple[int, int, int, int]) -> dict[str, Any]:
    from samplekit._configured.sampler import sampler as configure

    answers: dict[str, Any] = {}
    sources: dict[str, Callable[[], Any]] = {"recipe": lambda: configure(recipe)}
    if isinstance(pickle, bytes):
        sources["pickle"] = lambda: _unpickled(pickle)
    else:
        answers["pickle"] = pickle
    for name, make in sources.items():
        try:
            count, dims, realizations, seed = request
            source = make()
            source.prepare(count, dims)
            out = np.full((realizations, dims, count), np.nan)
            source.fill(out, Realizations.of_trials(0, realizations, seed), count, 0)
            answers[name] = out
        except Exception as error:
            answers[name] = f"{type(error).__name__}: {' '.join(str(error).split())}"
    return answers


def _unpickled(data: bytes) -> Any:
    return pickle.loads(data)


def _extremes(recipe: Recipe, dims: int, counts: list[int]) -> list[tuple[str, int, NDArray[np.float64]]]:
    from samplekit._configured.sampler import sampler as configure
    from samplekit.kernels import _hashing as hashing

    warnings.simplefilter("ignore")
    word = np.uint64(0)

    def constant(*_: object) -> np.uint64:
        return word

    # Samplers take these by name when they are imported, which they are not yet.
    vars(hashing).update(mix64=constant, hash_index=constant)
    vars(np.random).update(Philox=lambda *_, **__: forced_generator(int(word)))
    setattr(Realizations, "random_words", lambda self, number: np.full((len(self), number), word))  # noqa: B010
    made = []
    sampler = configure(recipe)
    for pattern, bits in (("ones", ALL_ONES), ("zeros", 0)):
        word = np.uint64(bits)
        for count in counts:
            out = np.full((2, dims, count), np.nan)
            try:
                sampler.fill(out, Realizations.of_trials(0, 2, 0), count, 0)
            except SamplekitError:
                # Values outside [0, 1) are what is looked for; anything else would fail without force as well.
                if not np.isfinite(out).all():
                    continue
            made.append((pattern, count, out))
    return made


def forced_generator(word: int) -> np.random.MT19937:
    """A Mersenne twister whose next 624 words are all ones, or zeros: 312 doubles of 1 - 2^-53, or 0.

    Tempering is linear and one to one on 32-bit words: the state is the tempered word solved back.
    """
    target = word & 0xFFFFFFFF
    columns = [_temper(1 << bit) for bit in range(32)]
    state = 0
    # Gauss-Jordan over GF(2): rows are images of the bits, with the bits that make them.
    rows = [(image, 1 << bit) for bit, image in enumerate(columns)]
    for bit in range(32):
        pivot = next(i for i in range(bit, 32) if rows[i][0] >> bit & 1)
        rows[bit], rows[pivot] = rows[pivot], rows[bit]
        for i in range(32):
            if i != bit and rows[i][0] >> bit & 1:
                rows[i] = (rows[i][0] ^ rows[bit][0], rows[i][1] ^ rows[bit][1])
    for bit in range(32):
        if target >> bit & 1:
            state ^= rows[bit][1]
    generator = np.random.MT19937(0)
    generator.state = {
        "bit_generator": "MT19937",
        "state": {"key": np.full(624, state, np.uint32), "pos": 0},
    }
    return generator


def _temper(y: int) -> int:
    """The tempering of Matsumoto and Nishimura 1998, "Mersenne twister", section 2.1."""
    y ^= y >> 11
    y ^= (y << 7) & 0x9D2C5680
    y ^= (y << 15) & 0xEFC60000
    return (y ^ y >> 18) & 0xFFFFFFFF


if __name__ == "__main__":
    main()
