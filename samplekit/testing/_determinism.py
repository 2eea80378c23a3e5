"""The same request gives the same points, whatever was asked before and wherever; another seed gives others."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit.testing._elsewhere import ElsewhereError, points_elsewhere
from samplekit.testing._result import CheckFailed, check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.testing._subject import Subject

REALIZATIONS = 70
ELSEWHERE_REALIZATIONS = 8


def judge_equal(
    subject: Subject, whole: NDArray[np.float64], other: NDArray[np.float64], count: int, seed: int, when: str
) -> None:
    """Raise unless two arrays float64[R, D, N] are equal bit for bit; -0.0 is not 0.0, and NaN is equal to itself."""
    different = whole.view(np.uint64) != other.view(np.uint64)
    if not different.any():
        return
    row, dimension, point = (int(i) for i in np.argwhere(different)[0])
    raise CheckFailed(
        f"{float(whole[row, dimension, point])!r} in dimension {dimension}, but {float(other[row, dimension, point])!r}"
        f" {when}; {int(np.count_nonzero(different.any(axis=(1, 2))))} of {len(whole)} sets differ",
        subject.example(whole, count, seed=seed, row=row, indices=(point,)),
    )


@check("determinism", 3, tolerance="bit for bit")
def check_determinism(subject: Subject) -> None:
    """The same points when asked again, in another order, one by one, in chunks, in another thread and process."""
    dims = subject.dims(3)
    for count in subject.counts(1, 7, 64, 100, dims=dims):
        asked = Realizations.of_trials(0, REALIZATIONS, 0)
        whole = subject.fill(asked, count, dims)

        def judge(
            other: NDArray[np.float64], when: str, whole: NDArray[np.float64] = whole, count: int = count
        ) -> None:
            judge_equal(subject, whole, other, count, 0, when)

        judge(subject.fill(asked, count, dims), "when asked again")
        _ask_for_something_else(subject, count, dims)
        judge(subject.fill(asked, count, dims), "after other requests")
        judge(subject.fill(asked, count, dims, sampler=configured_sampler(subject.recipe)), "from a fresh sampler")
        backwards = np.arange(REALIZATIONS - 1, -1, -1)
        reverse = Realizations.of_pixels(backwards, np.zeros_like(backwards), 0)
        judge(subject.fill(reverse, count, dims)[::-1], "with the realisations in reverse order")
        for chunk in (1, 7, 64):
            pieces = [subject.fill(asked[i : i + chunk], count, dims) for i in range(0, REALIZATIONS, chunk)]
            judge(np.concatenate(pieces), f"in chunks of {chunk} realisations")
        judge(_in_a_thread(subject, asked, count, dims), "in another thread")
        if not (asked.keys == Realizations.of_trials(0, REALIZATIONS, 0).keys).all():
            raise CheckFailed("changes the keys of the realisations that it was given")
    if not subject.quick:
        count = subject.counts(64, dims=dims)[0]
        whole = subject.sets(count, dims, ELSEWHERE_REALIZATIONS, seed=3)
        try:
            other = points_elsewhere(subject, (count, dims, ELSEWHERE_REALIZATIONS, 3))["recipe"]
        except ElsewhereError as error:
            raise CheckFailed(f"in another process: {error}") from None
        if isinstance(other, str):
            raise CheckFailed(f"in another process: {other}")
        judge_equal(subject, whole, other, count, 3, "in another process")


def _ask_for_something_else(subject: Subject, count: int, dims: int) -> None:
    for other in subject.counts(count + 1, 2 * count, dims=dims):
        subject.sets(other, dims, 3, seed=9, first=5)
    subject.sets(subject.counts(count, dims=subject.dims(1))[0], subject.dims(1), 2, seed=1)


def _in_a_thread(subject: Subject, asked: Realizations, count: int, dims: int) -> NDArray[np.float64]:
    answers: list[NDArray[np.float64] | CheckFailed] = []

    def run() -> None:
        try:
            answers.append(subject.fill(asked, count, dims))
        except CheckFailed as failed:
            answers.append(failed)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    if not answers:
        raise CheckFailed("raised in another thread")
    if isinstance(answers[0], CheckFailed):
        raise answers[0]
    return answers[0]


@check("seed", 4)
def check_seed(subject: Subject) -> None:
    """Another seed gives other points if the sampler is declared randomised, the same points if it is not."""
    dims = subject.dims(2)
    count = subject.counts(16, dims=dims)[0]
    seeds = (0, 1, 2, 2**31, 2**32, 2**32 + 1, 2**53 + 1, 2**63, 2**64 - 1)
    made = {seed: subject.sets(count, dims, 2, seed=seed) for seed in seeds}
    if not subject.spec.randomized:
        for seed in seeds:
            judge_equal(
                subject, made[0], made[seed], count, 0, f"with seed {seed}, though it is declared not randomised"
            )
        judge_equal(
            subject, made[0][:1], made[0][1:], count, 0, "in realisation 1, though it is declared not randomised"
        )
        return
    for first in seeds:
        for second in seeds:
            if first < second and (made[first][0] == made[second][0]).all():
                raise CheckFailed(
                    f"seeds {first} and {second} give the same points, though it is declared randomised",
                    subject.example(made[first], count, seed=first, indices=(0,)),
                )
