"""The mean over points of a scene's value, whatever the tile, the block and the door by which points come."""

import math

import numpy as np
import pytest

import samplekit
from samplekit._configured.sampler import ConfiguredSampler
from samplekit._configured.scene import ConfiguredScene
from samplekit._errors import SamplekitError, UsageError
from samplekit._integrate.loop import Clock, count_invalid_samples, integrate, mean_of_constant, unit_square
from samplekit._registry import Plugin, Registration
from samplekit._specs import Option, SamplerSpec, SceneSpec

COUNTS = (1, 3, 1000, 1024, 1025, 5000)
"""Below, at and beyond the block of 1024, and several blocks of which the last is not full."""
TOYS = Plugin("toys", "toys", "1")


def a_scene(name, target, **options):
    declared = tuple(Option(option, value) for option, value in options.items())
    return ConfiguredScene(
        Registration(SceneSpec(name, f"{__name__}:{target}", "", options=declared), TOYS, name), options
    )


def a_sampler(name, target):
    return ConfiguredSampler(Registration(SamplerSpec(name, f"{__name__}:{target}", ""), TOYS, name), {})


class Drawn(samplekit.Sampler):
    """The slow door: a whole set at once."""

    def draw(self, count, dims, rng):
        return rng.random((count, dims))


class Filled(samplekit.Sampler):
    """The fast door: golden-ratio points shifted by the key."""

    def fill(self, out, realizations, count, start):
        _, dims, points = out.shape
        index = np.arange(start, start + points) * 0.6180339887498949
        shift = (realizations.keys >> np.uint64(40)) * 2.0**-24
        out[:] = (shift[:, None, None] + (index + np.arange(dims)[:, None] / 7)) % 1.0


class Sum(samplekit.Scene):
    """The sum of all coordinates, in as many dimensions as there are."""

    def __init__(self, dims):
        self.dims = dims

    def dimensions(self):
        return {"pixel": 2, "direction": self.dims - 2} if self.dims > 2 else {"pixel": 2}

    def value(self, points):
        assert points.shape[0] == self.dims
        return points.sum(axis=0)


class Constant(samplekit.Scene):
    def __init__(self, value):
        self.number = value

    def value(self, points):
        return np.full(points.shape[1], self.number)


class Holes(samplekit.Scene):
    """NaN left of 0.1, infinite in the next tenth, minus infinite in the third."""

    def value(self, points):
        tenths = np.floor(points[0] * 10)
        return np.select([tenths == 0, tenths == 1, tenths == 2], [np.nan, np.inf, -np.inf], points[1])


def centred(x, y, cx=0.4523, cy=0.5317):
    return (x - cx) ** 2 + (y - cy) ** 2


VALUES = {
    "disk": lambda x, y: centred(x, y) < 0.3**2,
    "disk:radius=0.2,cx=0.1,cy=0.9": lambda x, y: centred(x, y, 0.1, 0.9) < 0.2**2,
    "gaussian": lambda x, y: np.exp(-centred(x, y) / (2 * 0.1**2)),
    "gaussian:sigma=0.3,cx=0": lambda x, y: np.exp(-centred(x, y, 0.0) / (2 * 0.3**2)),
    "zoneplate:k=20": lambda x, y: 0.5 + 0.5 * np.cos(20 * centred(x, y, 0, 0)),
    "step": lambda x, y: (x < 0.5) * 1.0,
    "step:angle=30,offset=0.7": lambda x, y: math.cos(math.pi / 6) * x + 0.5 * y < 0.7,
    "checker": lambda x, y: (np.floor(8 * x) + np.floor(8 * y)) % 2 == 0,
    "checker:cells=5": lambda x, y: (np.floor(5 * x) + np.floor(5 * y)) % 2 == 0,
    "bilinear": lambda x, y: x * y,
}
"""The scenes' values, written down a second time."""


def mean(value, points):
    """The mean float64[R] over points float64[R, n, 2], each from a sum that is rounded once."""
    return np.array([math.fsum(np.asarray(value(*one.T), float)) / len(one) for one in points])


@pytest.mark.parametrize("scene", VALUES)
@pytest.mark.parametrize("sampler", ["random", "hammersley", "sobol+owen", "halton+shift", "latin-hypercube"])
def test_an_estimate_is_the_mean_over_the_points(scene, sampler):
    for count in COUNTS:
        points = samplekit.points(sampler, count, 2, realizations=3, seed=7)
        estimates = samplekit.estimate(scene, sampler, count, realizations=3, seed=7)
        np.testing.assert_allclose(estimates, mean(VALUES[scene], points), rtol=0, atol=1e-14)


def test_phases_of_a_thousand_radians_are_as_exact_as_they_can_be():
    def value(x, y):
        return 0.5 + 0.5 * np.cos(1024 * centred(x, y, 0, 0))

    for count in COUNTS:
        estimates = samplekit.estimate("zoneplate", "random", count, realizations=3)
        # A unit in the last place of a phase of 2048 is 2.3e-13.
        expected = mean(value, samplekit.points("random", count, 2, realizations=3))
        np.testing.assert_allclose(estimates, expected, rtol=0, atol=5e-13)


@pytest.mark.parametrize("sampler", ["jittered", "multi-jittered", "correlated-multi-jittered", "regular", "n-rooks"])
def test_samplers_of_grids_likewise(sampler):
    for count in (1, 2, 1024, 5184):
        points = samplekit.points(sampler, count, 2, realizations=2)
        estimates = samplekit.estimate("gaussian", sampler, count, realizations=2)
        np.testing.assert_allclose(estimates, mean(VALUES["gaussian"], points), rtol=0, atol=1e-14)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("door", ["Drawn", "Filled"])
@pytest.mark.parametrize("dims", [2, 5])
def test_points_of_a_plugin_give_the_same_by_either_door(count, door, dims):
    sampler, scene = a_sampler("toy", door), a_scene("sum", "Sum", dims=dims)
    points = samplekit.points(sampler, count, dims, realizations=4)
    expected = [math.fsum(one.sum(axis=1)) / count for one in points]
    np.testing.assert_allclose(samplekit.estimate(scene, sampler, count, realizations=4), expected, rtol=1e-15, atol=0)


@pytest.mark.parametrize("sampler", ["sobol+owen", Drawn, Filled])
@pytest.mark.parametrize("count", [3, 1025])
def test_no_estimate_depends_on_the_tile(sampler, count):
    source = samplekit.sampler(sampler) if isinstance(sampler, str) else a_sampler("toy", sampler.__name__)
    scene = samplekit.scene("gaussian")
    boxes = unit_square(11)
    trials = source.trials(0, 11, 3)

    def means(tile_bytes):
        return integrate(scene, source, (count,), trials, boxes, tile_bytes=tile_bytes)[0]

    expected = means(2**30)
    for tile_bytes in (1, 16 * count, 48 * count, 100_000):
        assert np.array_equal(means(tile_bytes), expected)


def test_an_estimate_does_not_depend_on_those_that_are_asked_for_with_it():
    many = samplekit.estimate("gaussian", "random", 100, realizations=1000)
    assert np.array_equal(samplekit.estimate("gaussian", "random", 100, realizations=7), many[:7])
    assert np.unique(many).size == 1000
    assert not np.isin(samplekit.estimate("gaussian", "random", 100, realizations=7, seed=1), many).any()


@pytest.mark.parametrize("value", [0.1, -1 / 3, 1e300, 5e-324, -0.0, 0.0, 1.0, math.pi])
def test_the_mean_of_a_constant_is_that_of_as_many_samples_to_the_bit(value):
    scene = a_scene("constant", "Constant", value=value)
    for count in COUNTS:
        source = samplekit.sampler("random")
        (sampled,) = integrate(scene, source, (count,), source.trials(0, 1, 0), unit_square(1))
        computed = np.array([mean_of_constant(value, count)])
        assert np.array_equal(computed.view(np.uint64), sampled.view(np.uint64))


def test_estimates_are_independent_where_pixels_share_a_sequence():
    """The mean of 64 estimates has 1/64 of their variance: its chi-square over 400 seeds, within 5 standard errors."""
    scene, square = samplekit.scene("gaussian"), np.array([0.0, 1.0])
    estimates = np.array([samplekit.estimate(scene, "z-sobol", 4, realizations=64, seed=seed) for seed in range(400)])
    error = estimates - scene.reference(square, square).image[0, 0]
    ratio = 64 * (error.mean(axis=1) ** 2).mean() / (error**2).mean()
    assert abs(ratio - 1.0) < 5 * np.sqrt(2 / 400)


def test_the_mean_of_a_constant_takes_no_time_at_any_count():
    assert mean_of_constant(0.1, 2**48 - 1) == pytest.approx(0.1, rel=1e-15)


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("sampler", ["random", "sobol+owen", Drawn])
def test_every_sample_that_is_not_finite_is_counted(count, sampler):
    source = samplekit.sampler(sampler) if isinstance(sampler, str) else a_sampler("toy", sampler.__name__)
    trials = source.trials(0, 3, 0)
    counted = count_invalid_samples(a_scene("holes", "Holes"), source, count, trials, unit_square(3))
    points = samplekit.points(source, count, 2, realizations=3)
    assert counted == np.count_nonzero(points[:, :, 0] < 0.3)


def test_an_invalid_estimate_says_so():
    estimates = samplekit.estimate(a_scene("holes", "Holes"), "random", 1000, realizations=5)
    assert np.isnan(estimates).all()


def test_seconds_are_summed_and_ticks_count_the_samples():
    clock, done = Clock(), []
    scene, sampler, trials = (
        samplekit.scene("disk"),
        samplekit.sampler("random"),
        samplekit.sampler("random").trials(0, 10, 0),
    )
    integrate(scene, sampler, (3000,), trials, unit_square(10), clock=clock, tick=done.append, tile_bytes=2**15)
    assert sum(done) == 30000
    assert clock.points[0] > 0
    assert clock.scene[0] > 0


@pytest.mark.parametrize("realizations", [0, -1, 2.0, "3", None, True])
def test_numbers_of_realizations_that_cannot_be_are_refused(realizations):
    with pytest.raises(UsageError, match="realizations"):
        samplekit.estimate("disk", "random", 4, realizations=realizations)


def test_requests_that_the_sampler_cannot_serve_are_refused():
    with pytest.raises(UsageError, match="the nearest are 96 and 98"):
        samplekit.estimate("disk", "jittered", 97)
    with pytest.raises(UsageError, match="seed"):
        samplekit.estimate("disk", "jittered", 96, seed=-1)
    with pytest.raises(UsageError, match=r"makes points in 1 dimension.*, not 2"):
        samplekit.estimate("disk", "van-der-corput", 4)


class Wrong(samplekit.Scene):
    def __init__(self, what):
        self.what = what

    def value(self, points):
        if self.what == "raises":
            raise ArithmeticError("two\nlines")
        return {"none": None, "scalar": 1.0, "matrix": points, "short": points[0, 1:], "text": np.array(["a"])}[
            self.what
        ]


@pytest.mark.parametrize(
    ("what", "reason"),
    [
        ("raises", "ArithmeticError: two lines"),
        ("none", "shape"),
        ("scalar", "shape"),
        ("matrix", "shape"),
        ("short", "shape"),
        ("text", "ValueError"),
    ],
)
def test_a_scene_that_cannot_be_evaluated_is_named(what, reason):
    with pytest.raises(SamplekitError, match=reason) as error:
        samplekit.estimate(a_scene("wrong", "Wrong", what=what), "random", 16)
    assert str(error.value).startswith("scene wrong of plugin toys (toys 1) cannot be evaluated")
    assert "\n" not in str(error.value)
