"""Sentences: they say what the intervals tell, name no winner beyond them, and never contradict each other."""

from types import SimpleNamespace

import pytest

from samplekit._study.results import Choice, Crossing, Fit, Flip, Interval, Lead, ToTarget
from samplekit._study.sentences import seconds_in_words, statements

OPEN = Interval(None)


def said(needs=(), front=(), flips=(), crossings=(), fits=()):
    results = SimpleNamespace(
        target={"disk": 0.01}, to_target=list(needs), front=list(front), flips=list(flips), crossings=list(crossings),
        fits=list(fits),
    )  # fmt: skip
    sentences = [statement.sentence for statement in statements(results)]
    assert all(sentence.endswith(".") and "\n" not in sentence for sentence in sentences)
    return sentences


def need(sampler, count, seconds=OPEN):
    return ToTarget("disk", sampler, 0.01, count, seconds)


def test_a_winner_is_named_where_its_interval_is_apart():
    good = need("good", Interval(20.0, 18.0, 22.0), Interval(2e-6, 1.8e-6, 2.2e-6))
    cheap = need("cheap", Interval(1020.0, 900.0, 1100.0), Interval(1e-6, 0.9e-6, 1.1e-6))
    assert said([good, cheap]) == [
        "disk: the target is an mse of 0.01; good needs the fewest samples; cheap needs the least time.",
        "disk, good: needs 20 samples (18 to 22) and 2 µs (1.8 µs to 2.2 µs).",
        "disk, cheap: needs 1020 samples (900 to 1100) and 1 µs (900 ns to 1.1 µs).",
    ]


def test_those_whose_intervals_overlap_are_named_together():
    needs = [
        need("a", Interval(816.0, 700.0, 950.0)),
        need("b", Interval(1020.0, 900.0, 1200.0)),
        need("c", Interval(None, 4096.0)),
    ]
    first, *_ = said(needs)
    assert (
        first
        == "disk: the target is an mse of 0.01; the intervals do not tell which of a and b needs the fewest samples."
    )


def test_names_may_hold_any_letters():
    needs = [need("file:path={x}.csv", Interval(20.0, 18.0, 22.0)), need("b", Interval(90.0, 80.0, 99.0))]
    assert "file:path={x}.csv needs the fewest samples" in said(needs)[0]


@pytest.mark.parametrize(
    ("count", "text"),
    [
        (Interval(None, None, 16.0), "needs at most 16 samples"),
        (Interval(None, 256.0), "needs more than 256 samples"),
        (Interval(27.2), "needs 27.2 samples (without an interval)"),
        (Interval(27.2, 20.0), "needs 27.2 samples (at least 20)"),
        (Interval(27.2, None, 30.0), "needs 27.2 samples (at most 30)"),
        (Interval(27.2, 27.2, 27.2), "needs 27.2 samples"),
        (Interval(None, None, 1.0), "needs at most 1 sample"),
        (Interval(None, 1.0), "needs more than 1 sample"),
        (Interval(None, 20.0, 30.0), "needs between 20 and 30 samples"),
        (OPEN, "these rows do not tell how many samples it needs"),
    ],
)
def test_bounds_are_said_as_bounds(count, text):
    assert said([need("one", count)])[1] == f"disk, one: {text}."


def test_without_intervals_nobody_wins():
    first, *_ = said([need("a", Interval(816.0)), need("b", Interval(1020.0))])
    assert first == "disk: the target is an mse of 0.01; no interval tells which sampler needs the fewest samples."


def test_each_pair_has_one_sentence_about_where_either_is_better():
    leads = [Lead("r2", 1, 1), Lead("jittered", 2, 4)]
    assert "r2 has the smaller error at 1 sample, " in said(crossings=[Crossing("disk", ("r2", "jittered"), leads)])[1]
    leads = [Lead("jittered", 16, 32), Lead("sobol", 64, 256), Lead("jittered", 4096, 4096)]
    _, second = said(crossings=[Crossing("disk", ("jittered", "sobol"), leads)])
    assert second == (
        "disk: jittered has the smaller error from 16 to 32 and at 4096 samples,"
        " sobol has the smaller error from 64 to 256 samples."
    )


def test_flips_have_intervals_and_only_leaders_are_said():
    flips = [Flip("disk", 0.01, Interval(42.0, 40.0, 44.5), "a", "b", leads) for leads in (True, False)]
    assert said(flips=flips)[1:] == [
        "disk: from an extra cost of 42 ns a sample on (40 to 44.5), b needs less time than a."
    ]


def test_budgets_name_the_best_only_where_it_is_alone():
    front = [
        Choice("disk", ["a"], 1e-6, 2e-6),
        Choice("disk", ["a", "b"], 2e-6, 3e-6),
        Choice("disk", ["b"], 3e-6, None),
    ]
    assert said(front=front)[1] == (
        "disk: the best sampler for a budget of time is a from 1 µs to 2 µs, b from 3 µs on;"
        " for other budgets the intervals do not tell."
    )
    assert said(front=[front[1]])[1] == "disk: for every budget of time the best sampler is a or b."
    apart = [Choice("disk", ["a"] if k % 2 else ["a", "b"], 1e-6 * (k + 1), 1e-6 * (k + 2)) for k in range(20)]
    assert said(front=apart)[1].startswith("disk: for some budgets of time the best sampler is a;")
    many = [Choice("disk", ["ab"[k % 2]], 1e-6 * (k + 1), 1e-6 * (k + 2)) for k in range(9)]
    assert said(front=many)[1] == "disk: the best sampler changes with the budget of time among a and b."


def test_slopes_have_intervals():
    def fit(slope):
        return Fit("disk", "one", slope, 1.0, 0.0, 4, 64, [4, 16, 64], {}, "worst", -1.5)

    assert (
        "falls as N^-1.48 (-1.60 to -1.36; theory: N^-1.5)"
        in said([need("one", OPEN)], fits=[fit(Interval(-1.48, -1.6, -1.36))])[1]
    )
    for unsure in (Interval(-1.48), Interval(-1.0, -2.5, 0.5)):
        assert "do not tell how fast" in said([need("one", OPEN)], fits=[fit(unsure)])[1]


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(2.5, "2.5 s"), (9.999e-4, "1 ms"), (1.25e-3, "1.25 ms"), (9.5e-4, "950 µs"), (3e-10, "0.3 ns")],
)
def test_times_in_words(seconds, text):
    assert seconds_in_words(seconds) == text
