"""What is decided before anything runs: dimensions, pixels, outputs, and what is too much."""

import math

import numpy as np
import pytest

import samplekit
from samplekit import _memory as memory
from samplekit._arguments import MOST_SAMPLES
from samplekit._configured.scene import ConfiguredScene
from samplekit._errors import SamplekitError, UsageError
from samplekit._integrate.plan import make_plan
from samplekit._registry import Plugin, Registration
from samplekit._specs import Option, SceneSpec


def plan(scene="disk", sampler="random", count=4, *, size=(8, 6), **more):
    return make_plan(samplekit.scene(scene), samplekit.sampler(sampler), count, size=size, **more)


class Blurred(samplekit.Scene):
    """Needs a lens where the aperture is open; forbids everything that a plan should not ask for."""

    def __init__(self, aperture):
        self.aperture = aperture

    def dimensions(self):
        return {"pixel": 2, "lens": 2, "time": 1} if self.aperture else {"pixel": 2}

    def value(self, points):
        raise AssertionError("a plan evaluates nothing")

    def exact(self, x_edges, y_edges):
        raise AssertionError("a plan computes no reference")


def blurred(aperture):
    purposes = (("pixel", 2), ("lens", 2), ("time", 1))
    spec = SceneSpec("blurred", f"{__name__}:Blurred", "", options=(Option("aperture", 0.0),), purposes=purposes)
    return ConfiguredScene(Registration(spec, Plugin("toys", "toys", "1"), spec.name), {"aperture": aperture})


def test_dimensions_are_those_that_the_scene_needs_with_these_options():
    assert blurred(0.0).dims == 2
    assert blurred(1.0).dims == 5
    assert blurred(1.0).blocks == (2, 2, 1)
    closed = make_plan(blurred(0.0), samplekit.sampler("n-rooks"), 4, size=(4, 4))
    assert closed.explain()[:2] == [
        "dimensions: 2 (pixel 2)",
        "left out: the dimensions of lens, time: not needed with these options",
    ]
    with pytest.raises(UsageError, match="n-rooks makes points in 2 dimensions, not 5"):
        make_plan(blurred(1.0), samplekit.sampler("n-rooks"), 4, size=(4, 4))


def test_edges_are_those_of_the_whole_image_as_stored():
    whole = plan(size=(7, 11))
    assert np.array_equal(whole.pixels.x_edges, [i / 7 for i in range(8)])
    assert np.array_equal(whole.pixels.y_edges, [j / 11 for j in range(12)])
    crop = plan(size=(7, 11), crop=(3, 5, 2, 4))
    assert np.array_equal(crop.pixels.x_edges, whole.pixels.x_edges[3:6])
    assert np.array_equal(crop.pixels.y_edges, whole.pixels.y_edges[5:10])
    assert len(crop.pixels) == 8


@pytest.mark.parametrize("size", [(1, 1), (3, 5), (49, 7), (640, 480)])
def test_edges_end_at_exactly_0_and_1(size):
    made = plan(size=size)
    assert made.pixels.x_edges[0] == made.pixels.y_edges[0] == 0.0
    assert made.pixels.x_edges[-1] == made.pixels.y_edges[-1] == 1.0
    assert made.pixels.window == (0, 0, *size)


def test_of_a_disk_only_the_rim_is_sampled():
    made = plan(size=(512, 512))
    assert 0 < made.pixels.sampled.size <= 0.02 * len(made.pixels)
    assert np.isnan(made.pixels.constant.ravel()[made.pixels.sampled]).all()
    assert set(np.unique(made.pixels.constant[~np.isnan(made.pixels.constant)])) == {0.0, 1.0}
    # The rim passes through the pixels that are sampled, and through no other.
    reference = samplekit.scene("disk").exact(made.pixels.x_edges, made.pixels.y_edges).ravel()
    cut = np.flatnonzero((reference > 0) & (reference < 1))
    assert np.isin(cut, made.pixels.sampled).all()
    assert made.pixels.sampled.size - cut.size <= 4


def test_full_samples_every_pixel():
    made = plan(size=(512, 512), full=True)
    assert made.pixels.sampled.size == 512 * 512
    assert "pixels: all sampled (--full)" in made.explain()


def test_a_scene_that_is_constant_everywhere_needs_no_samples():
    made = plan("disk:radius=0", size=(16, 16))
    assert made.pixels.sampled.size == 0
    assert "left out: 256 of 256 pixels (100.00 %), in which the scene is proven constant" in made.explain()
    assert "samples: 0 pixels x 4 = 0" in made.explain()


def test_what_is_left_out_is_explained():
    lines = plan(reference=False).explain()
    assert lines[0] == "dimensions: 2 (pixel 2)"
    assert "left out: the reference, the error and the metrics (--no-error)" in lines
    assert all("\n" not in line for line in lines)
    assert len(plan().explain()) == len(lines) - 1


@pytest.mark.parametrize(
    "size",
    [
        *[(0, 4), (4, 0), (-1, 4), (2.0, 4), (4, 2.5), ("4", 4), (True, 4), (None, 4), (2**31 + 1, 1), (math.inf, 4)],
        *[8, (8, 8, 8), (8,), "88", None],
    ],
)
def test_sizes_that_cannot_be_are_refused(size):
    with pytest.raises(UsageError, match="expected width and height from 1 to"):
        plan(size=size)


def test_sizes_may_be_integers_of_numpy():
    made = plan(size=(np.uint8(200), np.int64(3)))
    assert made.pixels.size == (200, 3)
    assert all(type(side) is int for side in made.pixels.size)


def test_counts_may_be_integers_of_numpy():
    made = plan("gaussian", count=np.uint8(200), size=(64, 64))
    assert made.pixels.sampled.size * made.count == 64 * 64 * 200


@pytest.mark.parametrize(
    "crop",
    [(8, 0, 1, 1), (0, 0, 9, 6), (0, 0, 0, 1), (-1, 0, 2, 2), (0, 5, 1, 2), (0.5, 0, 4, 4), (0, 0, 4), (), 5, "0044"],
)
def test_crops_that_are_not_inside_are_refused(crop):
    with pytest.raises(UsageError, match="inside the image of 8x6 pixels"):
        plan(crop=crop)


@pytest.mark.parametrize("seed", [-1, 2**64, 1.0, "1", None, True])
def test_seeds_that_cannot_be_are_refused(seed):
    with pytest.raises(UsageError, match="expected an integer from 0 to 18446744073709551615"):
        plan(seed=seed)


@pytest.mark.parametrize("count", [0, -1, 2.0, "4", None, True])
def test_counts_that_cannot_be_are_refused(count):
    with pytest.raises(UsageError, match="expected a positive integer"):
        plan(count=count)


def test_counts_that_the_sampler_does_not_make_are_refused_with_the_nearest():
    with pytest.raises(UsageError, match="not 1009: the nearest are 1008 and 1012"):
        plan(sampler="jittered", count=1009)
    with pytest.raises(UsageError, match="makes at most 1099511627776 points"):
        plan(sampler="halton", count=2**40 + 1, size=(1, 1))


def test_more_samples_than_weeks_of_work_are_a_slip_of_the_keyboard():
    assert plan(count=MOST_SAMPLES, size=(1, 1)).count == MOST_SAMPLES
    with pytest.raises(UsageError, match="at most"):
        plan(count=MOST_SAMPLES + 1, size=(1, 1))
    with pytest.raises(UsageError, match="at most"):
        plan(count=MOST_SAMPLES // 64 + 1, size=(8, 8))


def test_an_image_beyond_the_memory_is_refused_with_the_way_out(monkeypatch):
    with pytest.raises(SamplekitError, match=r"render it in parts with --crop X,Y,W,H"):
        plan(size=(10**6, 10**6))
    # A part of it is no more work than an image of that size.
    part = plan("gaussian", size=(2**31, 2**31), crop=(2**30, 2**30, 3, 2))
    assert part.pixels.sampled.size == len(part.pixels) == 6
    assert np.array_equal(part.pixels.x_edges, np.arange(2**30, 2**30 + 4) / 2**31)
    # What is free is not even asked for a small one.
    monkeypatch.setattr(memory, "_UNQUESTIONED_BYTES", 2**62)
    assert len(plan(size=(4096, 4096)).pixels) == 2**24


def test_nothing_is_computed_before_it_is_needed():
    made = make_plan(blurred(0.0), samplekit.sampler("random"), 4, size=(4, 4), reference=True)
    assert made.pixels.sampled.size == 16


class Lying(samplekit.Scene):
    """A scene whose methods give what the test says."""

    def __init__(self, what):
        self.what = what

    def constant(self, x_edges, y_edges):
        if self.what == "raises":
            raise ValueError("two\nlines")
        return {"none": None, "shape": np.zeros(3), "transposed": np.zeros((8, 6))}[self.what]


@pytest.mark.parametrize(
    ("what", "reason"),
    [("raises", "ValueError: two lines"), ("none", "shape"), ("shape", "shape"), ("transposed", "shape")],
)
def test_a_scene_that_cannot_tell_its_constant_pixels_is_named(what, reason):
    spec = SceneSpec("lying", f"{__name__}:Lying", "", options=(Option("what", ""),))
    scene = ConfiguredScene(Registration(spec, Plugin("toys", "toy-box", "1"), spec.name), {"what": what})
    made = make_plan(scene, samplekit.sampler("random"), 4, size=(8, 6))
    with pytest.raises(SamplekitError, match=reason) as error:
        _ = made.pixels.sampled
    assert "of plugin toys (toy-box 1) cannot tell constant pixels" in str(error.value)
    assert "\n" not in str(error.value)
