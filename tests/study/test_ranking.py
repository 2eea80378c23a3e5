"""Targets, the best choices, flips by cost, crossings and sentences, against values that were worked out by hand."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import pytest

from samplekit._study.ranking import rank
from samplekit._study.results import Interval, Row, Seconds, Spread, Times
from samplekit._study.sentences import seconds_in_words, statements


def row(sampler, count, mse, time, width=1.1, scene="disk"):
    interval = Interval(mse, mse / width, mse * width)
    return Row(
        scene, sampler, count, [count], "", 2, count, 100, interval, interval, Interval(0.0), interval, Interval(0.0),
        None, None, None, 0.0, "exact", 0, None, time, True, "", [], None,
    )  # fmt: skip


def curve(sampler, constant, slope, seconds, counts=(4, 16, 64, 256)):
    return [row(sampler, n, constant * n**slope, seconds * n) for n in counts]


CHEAP = curve("cheap", 1.0, -1.0, 1e-9)
GOOD = curve("good", 1.0, -1.5, 5e-9)


def test_target_is_one_that_all_reach():
    assert rank(CHEAP + GOOD, None, 0.0).target == {"disk": pytest.approx(1 / 256)}
    assert rank(CHEAP + GOOD, 0.01, 0.0).target == {"disk": 0.01}


def test_time_to_target_follows_the_law_between_rows():
    cheap, good = rank(CHEAP + GOOD, 0.02, 0.0).to_target
    assert cheap.count == pytest.approx(50.0)
    assert cheap.seconds == pytest.approx(50e-9)
    assert good.count == pytest.approx(0.02 ** (-1 / 1.5))
    missed, _ = rank(CHEAP + GOOD, 1e-3, 0.0).to_target
    assert (missed.count, missed.seconds) == (None, None)
    assert "256" in missed.note
    assert rank(CHEAP, 0.5, 0.0).to_target[0].count == 4.0


def test_flip_is_where_the_times_are_equal():
    rows = CHEAP + GOOD
    found = rank(rows, 0.02, 0.0)
    (flip,) = found.flips
    times = [need.seconds + flip.cost * 1e-9 * need.count for need in found.to_target]
    assert times[0] == pytest.approx(times[1])
    assert (flip.below, flip.above, flip.leads) == ("cheap", "good", True)
    # The same flip if a part of the cost is in the times already.
    dearer = [row(r.sampler, r.count, r.mse.estimate, r.time + 2e-9 * r.samples) for r in rows]
    (again,) = rank(dearer, 0.02, 2.0).flips
    assert again.cost == pytest.approx(flip.cost, rel=1e-6)


def test_front_has_what_nothing_beats():
    choices = rank(CHEAP + GOOD, None, 0.0).front
    assert all(a.seconds < b.seconds and a.mse > b.mse for a, b in pairwise(choices))
    rows = {(r.time, r.mse.estimate): (r.sampler, r.count) for r in CHEAP + GOOD}
    unbeaten = {
        name
        for (time, mse), name in rows.items()
        if not any(t <= time and m <= mse and (t, m) != (time, mse) for t, m in rows)
    }
    assert {(choice.sampler, choice.count) for choice in choices} == unbeaten
    assert [choice.until for choice in choices] == [*(choice.seconds for choice in choices[1:]), None]


def test_crossing_lies_where_the_laws_are_equal():
    flat, steep = curve("flat", 0.1, -1.0, 1e-9), curve("steep", 1.0, -1.5, 1e-9, (4, 16, 64, 256, 1024))
    (crossing,) = rank([*flat, row("flat", 1024, 0.1 / 1024, 1e-6), *steep], None, 0.0).crossings
    assert (crossing.fewer, crossing.more) == ("flat", "steep")
    assert crossing.count == pytest.approx(100.0)
    assert (crossing.last, crossing.first) == (64, 256)


def test_overlapping_intervals_tell_no_crossing():
    wide = [row("a", 4, 1.0, 1.0, 3.0), row("a", 16, 0.1, 1.0, 3.0), row("b", 4, 0.8, 1.0), row("b", 16, 0.11, 1.0)]
    assert rank(wide, None, 0.0).crossings == []


def test_sentences_name_the_numbers():
    results = SimpleNamespace(**rank(CHEAP + GOOD, 0.02, 0.0)._asdict(), fits=[])
    words = [statement.sentence for statement in statements(results)]
    assert words[0].startswith("disk: for an mse of 0.02, good needs the fewest samples (13.6)")
    assert "cheap the least time (50 ns)" in words[0]
    assert len(words) == 3
    assert all(sentence.endswith(".") and "\n" not in sentence for sentence in words)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(2.5, "2.5 s"), (9.999e-4, "1 ms"), (1.25e-3, "1.25 ms"), (9.5e-4, "950 µs"), (3e-10, "0.3 ns")],
)
def test_times_in_words(seconds, text):
    assert seconds_in_words(seconds) == text


def test_front_does_not_take_turns_by_noise():
    clock = Seconds(Spread(1.0, 0.9, 1.1), Spread(1.0, 0.9, 1.1))
    one = row("one", 1, 0.1, 1.0)
    same_error = row("two", 1, 0.0999, 1.01)
    better = row("one", 4, 0.02, 2.0)
    as_fast = replace(
        row("two", 4, 0.01, 1.05), times=Times(clock, clock, clock, 0.0, 0.0, 9, 9, Interval(1.0, 0.9, 1.1))
    )
    assert [choice.sampler for choice in rank([one, same_error, better], None, 0.0).front] == ["one", "one"]
    timed = replace(one, times=Times(clock, clock, clock, 0.0, 0.0, 9, 9, Interval(1.0, 0.9, 1.1)))
    assert [(choice.sampler, choice.count) for choice in rank([timed, as_fast], None, 0.0).front] == [("two", 4)]
