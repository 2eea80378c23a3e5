"""Jobs and trials: a trial depends on nothing else, and the prefixes of a progressive set share one draw."""

import numpy as np
import pytest

import samplekit
from samplekit._integrate.loop import integrate, unit_square
from samplekit._metrics import metrics
from samplekit._study.combinations import list_combinations
from samplekit._study.jobs import Job, batch_of, missing_ranges, split
from samplekit._study.request import checked_request
from samplekit._study.resources import Resources
from samplekit._study.trials import BLURRED, ERROR, INVALID, PAIRS, PRODUCT, SQUARE, TRIALS, carry_out, seed_of


def job(sampler, counts, first, last, *, batch=1, size=(1, 1), scene="disk", seed=5):
    return Job(scene, sampler, counts, first, last, batch, size, seed)


@pytest.mark.parametrize(("sampler", "counts"), [("sobol+owen", (3, 16, 1500)), ("jittered", (60,))])
def test_blocks_of_trials_are_parts_of_the_whole(sampler, counts):
    resources = Resources()
    whole = carry_out(job(sampler, counts, 0, 24, batch=4), resources)
    parts = [carry_out(job(sampler, counts, first, first + 8, batch=4), Resources()) for first in (0, 8, 16)]
    assert np.array_equal(whole, np.concatenate(parts, axis=1))
    single = carry_out(job(sampler, counts, 0, 24), resources)
    assert np.allclose(single.reshape(len(counts), 6, 4, -1).sum(axis=2), whole, rtol=1e-14, atol=0.0)


def test_images_are_those_of_renderings():
    sums = carry_out(job("sobol+owen", (4, 9), 0, 3, size=(24, 16)), Resources())
    for row, count in enumerate((4, 9)):
        errors = []
        for trial in range(3):
            image = samplekit.render("disk", "sobol+owen", count, size=(24, 16), seed=seed_of(5, trial))
            errors.append(image.error)
            expected = image.metrics["mse"], image.metrics["bias"], image.metrics["blurred_mse"]
            assert sums[row, trial, [SQUARE, ERROR, BLURRED]] == pytest.approx(expected, rel=1e-9)
        assert sums[row, 0, PRODUCT] == pytest.approx((errors[0] * errors[1]).mean(), rel=1e-9)
        assert sums[row, :, PAIRS].tolist() == [1.0, 0.0, 0.0]


def test_images_have_seeds_of_their_own():
    assert seed_of(5, 0) == 5
    assert len({seed_of(seed, trial) for seed in range(50) for trial in range(50)}) == 2500
    assert 0 <= seed_of(2**64 - 1, 7) < 2**64


def test_prefixes_are_the_estimates_of_their_own_sets():
    scene, sampler = samplekit.scene("gaussian"), samplekit.sampler("sobol+owen")
    realizations = sampler.trials(0, 50, 1, scene.blocks)
    boxes = unit_square(50)
    counts = (1, 7, 1024, 2048, 2500, 4096)
    found = integrate(scene, sampler, counts, realizations, boxes)
    for row, count in zip(found, counts, strict=True):
        (own,) = integrate(scene, sampler, (count,), realizations, boxes)
        assert row == pytest.approx(own, rel=1e-13)


def test_trials_have_no_end_at_the_largest_coordinate():
    """4099 pixels apart, 1 047 809 trials fill a row."""
    sums = carry_out(job("z-sobol", (4,), 1_047_800, 1_047_820), Resources())
    assert sums[0, :, TRIALS].tolist() == [1.0] * 20


def test_trials_of_samplers_that_spread_error_over_pixels_are_independent():
    # Neighbouring pixels' errors of z-sobol go against each other by design. 4 standard deviations of a correlation.
    errors = carry_out(job("z-sobol", (16,), 0, 4000), Resources())[0, :, ERROR]
    assert abs(np.corrcoef(errors[:-1], errors[1:])[0, 1]) < 4.0 / np.sqrt(4000)


def test_values_that_are_not_finite_are_counted(plugins):
    plugins.module(
        "holes",
        """
        import numpy as np
        from samplekit import Scene

        class Holes(Scene):
            def value(self, points):
                return np.where(points[0] < 0.01, np.nan, 0.5)

            def exact(self, x_edges, y_edges):
                return np.full((y_edges.size - 1, x_edges.size - 1), 0.5)
        """,
    )
    plugins.offer("holed", "scene", 'SceneSpec("holes", "holes:Holes", "NaN at the left")')
    square = carry_out(job("random", (4,), 0, 1000, scene="holes"), Resources())[0]
    assert 10 < square[:, INVALID].sum() == 1000 - square[:, TRIALS].sum() < 90
    assert square[:, SQUARE].max() == 0.0
    image = carry_out(job("random", (4,), 0, 1, scene="holes", size=(50, 2)), Resources())[0, 0]
    assert image[INVALID] == 2.0
    assert (image[TRIALS], image[SQUARE]) == (1.0, 0.0)
    found = samplekit.compare("random", "holes", 4, trials=50, size=(1, 1), times=False)
    assert found.rows[0].invalid_pixels > 0


def test_batches_are_few_and_even():
    for trials in (1, 2, 1024, 1025, 5000, 10**6):
        batch = batch_of(trials)
        assert -(-trials // batch) <= 1024
        assert batch == 1 or batch % 2 == 0


def test_jobs_fill_the_gaps_and_no_more():
    assert missing_ranges([[(4, 8), (10, 12)]], 15, 2) == [(0, 4), (8, 10), (12, 15)]
    assert missing_ranges([[]], 3, 1) == [(0, 3)]
    assert missing_ranges([[(0, 3)]], 3, 1) == []
    # The counts of one draw need the trials that any of them lacks.
    assert missing_ranges([[(0, 8)], [(0, 2), (4, 8)], []], 8, 2) == [(0, 8)]
    assert missing_ranges([[(0, 4), (6, 8)], [(0, 2), (4, 8)]], 8, 2) == [(2, 6)]


def test_jobs_share_out_what_is_missing():
    request = checked_request(["disk"], ["random", "sobol"], [4, 8], 100, (1, 1), 0)
    combinations, _ = list_combinations(request, Resources())
    random = [combination for combination in combinations if combination.sampler == "random"]
    jobs = split(request, random, lambda _: [(30, 40)], dict.fromkeys(random, 0.03), 2)
    assert {job.counts for job in jobs} == {(4, 8)}
    trials = sorted((job.first, job.last) for job in jobs)
    assert sum(last - first for first, last in trials) == 90
    assert missing_ranges([trials], 100, 1) == [(30, 40)]
    assert all(first % 2 == 0 for first, _ in trials)
    assert max(last - first for first, last in trials) <= 14


def test_metrics_and_rows_agree():
    rows = samplekit.compare("jittered", "zoneplate:k=50", 4, trials=6, size=(12, 10), times=False).rows
    errors = [samplekit.render("zoneplate:k=50", "jittered", 4, size=(12, 10), seed=seed_of(0, t)) for t in range(6)]
    expected = np.mean([metrics(r.image, r.reference)["mse"] for r in errors])
    assert rows[0].mse.estimate == pytest.approx(expected, rel=1e-12)
    assert rows[0].variance.estimate + rows[0].squared_bias.estimate == pytest.approx(expected, rel=1e-12)
