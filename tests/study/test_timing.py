"""Run times, by a clock that the tests set: slow calls fix no lap, and what slows all rows alike changes no ratio."""

from dataclasses import dataclass, field, replace
from itertools import cycle, pairwise
from types import SimpleNamespace

import numpy as np
import pytest

import samplekit
from samplekit._integrate.loop import integrate
from samplekit._study import study, timing
from samplekit._study.combinations import list_combinations
from samplekit._study.request import ExecutionOptions, checked_request
from samplekit._study.resources import Resources
from samplekit._study.results import Interval
from samplekit._study.store import Store
from samplekit._study.study import Study
from samplekit._study.timing import LAP_SECONDS, ROUNDS, TimingRun, falling, run_round, typical_seconds

PIXELS = 64 * 64
IMAGES = checked_request(["zoneplate"], ["random", "r2"], [1, 4], 4, (64, 64), 0)


@dataclass
class Machine:
    """A machine whose calls take known seconds: those of the pixels, and what ``delay`` adds to each call."""

    pixel: float = 1e-6
    delay: object = lambda _: 0.0
    load: float = 1.0
    now: float = 0.0
    calls: list = field(default_factory=list)

    def integrate(self, scene, sampler, counts, realizations, boxes, *, clock):
        clock.start()
        self.now += len(realizations) * counts[-1] * self.pixel + self.delay(len(self.calls))
        self.calls.append(len(realizations))
        clock.stop(clock.points)

    @property
    def time(self):
        return SimpleNamespace(process_time=lambda: self.now, perf_counter=lambda: self.now * self.load)


@pytest.fixture
def machine(monkeypatch):
    def start(**how):
        made = Machine(**how)
        monkeypatch.setattr(timing, "integrate", made.integrate)
        monkeypatch.setattr(timing, "time", made.time)
        return made

    return start


def runs(request=IMAGES):
    resources = Resources()
    combinations, _ = list_combinations(request, resources)
    return [TimingRun(combination, request, resources) for combination in combinations]


@pytest.mark.parametrize("seconds", [0.002, 0.05, 10.0])
@pytest.mark.parametrize("slow", range(12))
def test_one_slow_call_does_not_fix_the_length_of_a_lap(machine, seconds, slow):
    machine(delay=lambda call: seconds if call == slow else 0.0)
    run = runs()[0]
    run.warm_up(LAP_SECONDS)
    totals = [sum(run.lap()[::2]) for _ in range(9)]
    assert np.median(totals) == pytest.approx(PIXELS * 1e-6)
    assert run.lap_seconds >= 0.7 * LAP_SECONDS


@pytest.mark.parametrize("pixel", [1e-8, 1e-6, 2e-5, 1e-3, 0.031])
def test_a_lap_has_at_least_64_pixels_unless_fewer_take_very_long(machine, pixel):
    made = machine(pixel=pixel)
    run = runs()[0]
    assert run.warm_up(LAP_SECONDS) == pytest.approx(PIXELS * pixel)
    made.calls.clear()
    run.lap()
    pixels = made.calls[-1] if pixel > 1e-6 else sum(made.calls)
    assert pixels * pixel >= 0.7 * LAP_SECONDS
    assert pixels >= 64 or pixels * pixel >= 16 * LAP_SECONDS


def test_pixels_of_a_lap_are_spread_over_the_image():
    run = runs()[0]
    rows = run._realizations.y
    assert len(rows) == len(np.unique(run._realizations.keys)) == PIXELS
    for first in range(0, PIXELS - 64, 64):
        assert np.all(np.histogram(rows[first : first + 64], 4, (0, 64))[0] >= 8)


@pytest.mark.parametrize(("width", "height"), [(1, 2), (3, 3), (5, 13), (100, 100)])
def test_no_pixel_is_timed_twice_as_often(width, height):
    run = runs(replace(IMAGES, size=(width, height)))[0]
    assert len(np.unique(run._realizations.keys)) == len(run._realizations) == min(width * height, 4096)
    assert run.sampled == width * height


def test_calls_that_are_slow_now_and_then_change_no_time(machine):
    def delay(call):
        return 0.0 if call % 50 else 0.002 + 0.048 * (call % 7) / 7

    machine(delay=delay)
    timings = runs()
    with_store = Store(None, {}, {}, "this one")
    for run in timings:
        run.warm_up(LAP_SECONDS)
    for number in range(ROUNDS):
        run_round(timings, number, 0.1, with_store, lambda _, __: None)
    found = typical_seconds({run.combination: with_store.laps(run.combination) for run in timings})
    for combination, seconds in found.items():
        assert seconds.estimate == pytest.approx(PIXELS * combination.count * 1e-6, rel=1e-3)
        assert seconds.high < 1.01 * seconds.estimate


def test_a_round_stops_in_time_and_slow_rows_leave_out_every_third(machine):
    machine(pixel=1e-4)
    timings = runs(replace(IMAGES, counts=(1, 64)))
    for run in timings:
        run.warm_up(LAP_SECONDS)
    with_store = Store(None, {}, {}, "this one")
    for number in range(1, ROUNDS + 1):
        run_round(timings, number, 0.1, with_store, lambda _, __: None)
    laps = {run.combination: with_store.laps(run.combination) for run in timings}
    assert {each.count: len(np.unique(own[:, 0])) for each, own in laps.items()} == {1: 9, 64: 6}
    assert all(seconds.low is not None for seconds in typical_seconds(laps).values())


@pytest.mark.parametrize(("load", "laps"), [(1.0, 20), (3.0, 20), (8.0, 10)])
def test_a_busy_machine_is_given_time_up_to_four_times_the_budget(machine, load, laps):
    made = machine()
    timings = runs()[:1]
    timings[0].warm_up(LAP_SECONDS)
    made.load = load
    taken = []
    with_store = SimpleNamespace(add_laps=lambda number, found: taken.extend(found))
    for number in (0, 3):
        run_round(timings, number, 9.5 * 9 / 8 * LAP_SECONDS, with_store, lambda _, __: None)
    assert len(taken) == laps


COMBINATIONS, _ = list_combinations(replace(IMAGES, counts=(1, 2, 3, 4, 5)), Resources())


def laps_of(totals, rounds):
    """Laps of the seconds float64[L], of which all are spent on points, in rounds of equal size."""
    laps = np.zeros((len(totals), 5))
    laps[:, 0] = np.repeat(np.arange(rounds), len(totals) // rounds)
    laps[:, 1] = totals
    return laps


def noisy_laps(rng, costs, rounds=ROUNDS, each=4):
    """Laps on a bad machine: a common drift by a factor of 2, own noise that lasts for a round, one lap in ten slow."""
    common = np.repeat(rng.uniform(0.0, np.log(2.0), rounds), each) + 0.1 * rng.standard_normal(rounds * each)
    found = {}
    for combination, cost in zip(COMBINATIONS, costs, strict=False):
        own = np.repeat(0.03 * rng.standard_normal(rounds), each) + 0.03 * rng.standard_normal(rounds * each)
        slow = np.where(rng.random(rounds * each) < 0.1, rng.uniform(1.0, 20.0, rounds * each), 0.0)
        found[combination] = laps_of(cost * (np.exp(common + own) + slow), rounds)
    return found


@pytest.mark.parametrize("rows", [2, 3, 10])
def test_intervals_of_equal_costs_overlap(rows):
    """In at least 95 % of comparisons: 2 % were seen outside, so 400 comparisons say less than 1 time in 10^4."""
    rng = np.random.default_rng(5)
    apart = 0
    for _ in range(400):
        one, two = list(typical_seconds(noisy_laps(rng, [1.0] * rows)).values())[:2]
        apart += one.high < two.low or two.high < one.low
    assert apart <= 20


@pytest.mark.parametrize("rows", [2, 3, 10])
def test_ratios_are_known_though_the_machine_changes(rows):
    rng = np.random.default_rng(6)
    ratios = []
    for _ in range(100):
        found = [each.estimate for each in typical_seconds(noisy_laps(rng, 1.0 + np.arange(rows))).values()]
        ratios.append(found[1] / found[0])
    assert np.median(ratios) == pytest.approx(2.0, rel=0.01)
    assert np.ptp(ratios) < 0.5


def test_a_row_alone_has_the_scatter_of_the_machine():
    """Its interval is wrong in at most 5 % of studies; of 400, 9 % would be seen less than once in 1000 times."""
    rng = np.random.default_rng(7)
    outside = 0
    for _ in range(400):
        (own,) = typical_seconds({COMBINATIONS[0]: laps_of(np.exp(rng.standard_normal(ROUNDS)), ROUNDS)}).values()
        outside += not own.low <= 1.0 <= own.high
    assert outside <= 36


def test_intervals_need_six_rounds():
    for rounds in range(1, 12):
        found = typical_seconds(noisy_laps(np.random.default_rng(rounds), [1.0, 2.0], rounds))
        for seconds in found.values():
            assert (seconds.low is None) == (seconds.high is None) == (rounds < 6)


def test_laps_without_time_and_rows_without_laps():
    one, two, three, *_ = COMBINATIONS
    zero, some = laps_of(np.zeros(9), 9), laps_of(np.full(9, 0.5), 9)
    none = np.empty((0, 5))
    assert typical_seconds({one: none}) == {}
    assert typical_seconds({one: zero, two: some, three: none}) == {one: Interval(0.0), two: Interval(0.5, 0.5, 0.5)}
    # The first row was measured again without the second.
    again = laps_of(np.full(18, 0.25), 18)
    assert typical_seconds({one: again, two: some})[one].estimate == pytest.approx(0.25)


def test_a_time_that_falls_is_found():
    r2 = [replace(each, sampler="r2") for each in COMBINATIONS[:3]]
    random = [replace(each, sampler="random") for each in COMBINATIONS[:4]]
    seconds = [*zip(random, (2.0, 3.0, 2.5, 3.5), strict=True), *zip(r2, (1.0, 1.5, 4.0), strict=True)]
    assert falling({each: Interval(own) for each, own in seconds}) == {random[2]: random[1]}


@pytest.fixture
def fake_laps(monkeypatch):
    """Let laps take seconds that a function of the combination returns; return what was measured in which round."""

    def start(cost):
        rounds = []
        monkeypatch.setattr(TimingRun, "lap", lambda self: (cost(self.combination), 0.0, 0.0, 0.0))

        def observed(timings, number, *rest):
            rounds.append((number, {(each.combination.sampler, each.combination.count) for each in timings}))
            run_round(timings, number, *rest)

        monkeypatch.setattr(study, "run_round", observed)
        return rounds

    return start


def test_a_time_that_falls_is_measured_again_and_said(fake_laps):
    fallen = {("r2", 4): 0.5}
    rounds = fake_laps(lambda each: fallen.get((each.sampler, each.count), float(each.count)))
    found = samplekit.compare(["random", "r2"], "disk", [1, 4, 16], trials=200, size=(1, 1), budget=0.0)
    everyone = {(sampler, count) for sampler in ("random", "r2") for count in (1, 4, 16)}
    assert [who for _, who in rounds] == ROUNDS * [everyone] + ROUNDS * [{("r2", 1), ("r2", 4)}]
    assert [number for number, _ in rounds] == list(range(1, 2 * ROUNDS + 1))
    notes = {(row.sampler, row.count): row.notes for row in found.rows}
    assert notes.pop(("r2", 4)) == ["takes less time than with 1 sample"]
    assert not any(notes.values())


def test_a_fall_within_the_intervals_is_said_to_be_one(fake_laps):
    seconds = cycle((0.9, 1.1, 0.99))
    fake_laps(lambda each: 1.0 if each.count == 1 else next(seconds))
    found = samplekit.compare("random", "disk", [1, 4], trials=200, size=(1, 1), budget=0.0)
    first, second = found.rows
    assert second.times.seconds.estimate == pytest.approx(0.99 * first.times.seconds.estimate)
    assert second.notes == ["takes less time than with 1 sample; the intervals of the two times overlap"]


@pytest.mark.parametrize("how", [{"threads": 1}, {"threads": 2}])
def test_rounds_are_spread_over_the_errors_and_no_worker_works_meanwhile(monkeypatch, how):
    """A round begins only when every job that was begun has ended and is in the store."""
    events, running = [], []
    carry_out, add = study.carry_out, Store.add

    def observed_job(job, resources, tick):
        running.append(job)
        found = carry_out(job, resources, tick)
        running.remove(job)
        return found

    def observed_add(self, job, sums):
        events.append("job")
        add(self, job, sums)

    def observed_round(timings, number, seconds, store, progress):
        events.append((number, len(running)))

    monkeypatch.setattr(study, "carry_out", observed_job)
    monkeypatch.setattr(Store, "add", observed_add)
    monkeypatch.setattr(study, "run_round", observed_round)
    monkeypatch.setattr("samplekit._study.jobs._MOST_TRIALS", 2)
    samplekit.compare(["random", "r2"], "disk", [16], trials=200, size=(1, 1), **how)
    rounds = [index for index, event in enumerate(events) if event != "job"]
    assert [events[index] for index in rounds] == [(number, 0) for number in range(1, ROUNDS + 1)]
    jobs = [second - first - 1 for first, second in pairwise(rounds)]
    assert rounds[0] == 0
    assert rounds[-1] == len(events) - 1
    assert min(jobs) >= 8
    assert max(jobs) <= min(jobs) + 1


def test_the_budget_is_a_tenth_of_the_time_for_errors_and_at_least_a_second(monkeypatch):
    budgets = []
    monkeypatch.setattr(study, "run_round", lambda _, __, seconds, *rest: budgets.append(seconds))
    samplekit.compare("random", "disk", [16], trials=4, size=(1, 1))
    assert budgets == pytest.approx([1.0 / ROUNDS] * ROUNDS)
    budgets.clear()
    samplekit.compare("random", "disk", [16], trials=4, size=(1, 1), budget=4.5)
    assert budgets == pytest.approx([0.5] * ROUNDS)
    budgets.clear()
    resources = Resources()
    with Study(IMAGES, ExecutionOptions(), resources, None, resume=False) as whole:
        now = iter(range(0, 10**6, 60))
        monkeypatch.setattr(study, "time", SimpleNamespace(perf_counter=lambda: float(next(now))))
        whole.run(lambda _, __, ___: None)
    assert sum(budgets) == pytest.approx(6.0, rel=0.2)


def test_a_study_that_goes_on_keeps_its_rounds(tmp_path):
    ask = {"trials": 4, "size": (1, 1), "budget": 0.0, "output": tmp_path}
    first = samplekit.compare(["random", "r2"], "disk", [16], **ask)
    second = samplekit.compare(["random", "r2"], "disk", [16], **ask, resume=True)
    assert [row.times.rounds for row in first.rows] == [6, 6]
    assert [row.times.rounds for row in second.rows] == [12, 12]


def test_the_faked_call_is_the_real_one(monkeypatch):
    """What the tests replace is called with these arguments."""
    seen = []
    monkeypatch.setattr(timing, "integrate", lambda *given, **named: seen.append(integrate(*given, **named)))
    run = runs()[0]
    run.warm_up(1e-9)
    assert seen[0].shape == (1, 1)
