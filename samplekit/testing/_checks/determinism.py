"""The same request gives the same points, whatever was asked before and wherever; another seed gives others."""

from __future__ import annotations

import itertools
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import sampler as configured_sampler
from samplekit.testing._elsewhere import judge_elsewhere
from samplekit.testing._judge import judge_equal
from samplekit.testing._result import CheckFailed, conformance_check
from samplekit.testing._subject import SamplerSubject

_REALIZATIONS = 70


@conformance_check("determinism", 3)
def check_determinism(subject: SamplerSubject) -> None:
    """The points are the same, bit for bit, again, in another order, in chunks, in another thread and process."""
    dims = subject.dims(3)
    for count in subject.counts(1, 7, 64, 100, dims=dims):
        _judge_repeated_requests(subject, count, dims)
    if not subject.quick:
        judge_elsewhere(subject, subject.recipe, "in another process")


def _judge_repeated_requests(subject: SamplerSubject, count: int, dims: int) -> None:
    asked = Realizations.of_trials(0, _REALIZATIONS, 0)
    whole = subject.fill(asked, count, dims)
    judge_equal(subject, whole, subject.fill(asked, count, dims), count, "when asked again")
    _ask_for_something_else(subject, count, dims)
    judge_equal(subject, whole, subject.fill(asked, count, dims), count, "after other requests")
    fresh = subject.fill(asked, count, dims, sampler=configured_sampler(subject.recipe))
    judge_equal(subject, whole, fresh, count, "from a fresh sampler")
    reverse = subject.fill(asked[::-1], count, dims)[::-1]
    judge_equal(subject, whole, reverse, count, "with the realisations in reverse order")
    for chunk in (1, 7, 64):
        pieces = [subject.fill(asked[i : i + chunk], count, dims) for i in range(0, _REALIZATIONS, chunk)]
        judge_equal(subject, whole, np.concatenate(pieces), count, f"in chunks of {chunk} realisations")
    with ThreadPoolExecutor(1) as thread:
        in_a_thread = thread.submit(subject.fill, asked, count, dims).result()
    judge_equal(subject, whole, in_a_thread, count, "in another thread")
    if not (asked.keys == Realizations.of_trials(0, _REALIZATIONS, 0).keys).all():
        raise CheckFailed("changes the keys of the realisations that it was given")


def _ask_for_something_else(subject: SamplerSubject, count: int, dims: int) -> None:
    for other in subject.counts(count + 1, 2 * count, dims=dims):
        subject.sets(other, dims, 3, seed=9, first=5)
    subject.sets(subject.counts(count, dims=subject.dims(1))[0], subject.dims(1), 2, seed=1)


@conformance_check("seed", 4)
def check_seed(subject: SamplerSubject) -> None:
    """Another seed gives other points if the sampler is declared randomised, the same points if it is not."""
    dims = subject.dims(2)
    count = subject.counts(16, dims=dims)[0]
    seeds = (0, 1, 2, 2**31, 2**32, 2**32 + 1, 2**53 + 1, 2**63, 2**64 - 1)
    made = {seed: subject.sets(count, dims, 2, seed=seed) for seed in seeds}
    if not subject.spec.randomized:
        undeclared = "though it is declared not randomised"
        for seed in seeds:
            judge_equal(subject, made[0], made[seed], count, f"with seed {seed}, {undeclared}")
        judge_equal(subject, made[0][:1], made[0][1:], count, f"in realisation 1, {undeclared}")
        return
    for first, second in itertools.combinations(seeds, 2):
        if (made[first][0] == made[second][0]).all():
            raise CheckFailed(
                f"seeds {first} and {second} give the same points, though it is declared randomised",
                subject.example(made[first], count, seed=first, indices=(0,)),
            )
