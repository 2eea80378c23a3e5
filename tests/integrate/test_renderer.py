"""The image depends on nothing but the request: not on threads, tiles, the part asked for, or what is left out."""

import functools
import threading
import time
import tracemalloc

import numpy as np
import pytest

import samplekit
from samplekit._bases.realizations import Realizations
from samplekit._configured.sampler import ConfiguredSampler
from samplekit._configured.scene import ConfiguredScene
from samplekit._errors import SamplekitError, UsageError
from samplekit._integrate import rendering
from samplekit._integrate.plan import make_plan
from samplekit._registry import Plugin, Registration, Registry
from samplekit._specs import Option, SamplerSpec, SceneSpec

TOYS = Plugin("toys", "toys", "1")
OUR_SCENES = Registry().plugins[0].offers["scene"]
VARIANTS = (
    "disk:radius=0",
    "disk:radius=1e-3",
    "disk:radius=5",
    "disk:radius=0.25,cx=0.5,cy=0.5",
    "gaussian:sigma=1e-4",
    "gaussian:sigma=1e9",
    "gaussian:sigma=0.01,cx=2",
    "zoneplate:k=0",
    "zoneplate:k=1e-9",
    "zoneplate:k=1e6",
    "step:angle=90",
    "step:angle=30,offset=0.7",
    "step:offset=-1",
    "step:offset=1e150",
    "checker:cells=1",
    "checker:cells=7",
    "checker:cells=48",
    "checker:cells=1048576",
)


def a_scene(name, target, **options):
    declared = tuple(Option(option, value) for option, value in options.items())
    return ConfiguredScene(
        Registration(SceneSpec(name, f"{__name__}:{target}", "", options=declared), TOYS, name), options
    )


def a_sampler(target):
    return ConfiguredSampler(Registration(SamplerSpec("toy", f"{__name__}:{target}", ""), TOYS, "toy"), {})


def rendered(plan, *, tile_bytes=None, **how):
    """The rendering of a plan, in tiles of another size than the usual one."""
    with pytest.MonkeyPatch.context() as patch:
        if tile_bytes is not None:
            for function in (rendering.integrate, rendering.pixels_per_tile):
                patch.setattr(rendering, function.__name__, functools.partial(function, tile_bytes=tile_bytes))
        return rendering.render_plan(plan, **how)


def image(scene, sampler, count, size, *, crop=None, full=False, seed=0, **how):
    scene = samplekit.scene(scene) if isinstance(scene, str) else scene
    sampler = samplekit.sampler(sampler) if isinstance(sampler, str) else sampler
    plan = make_plan(scene, sampler, count, size=size, crop=crop, seed=seed, full=full, reference=False)
    return rendered(plan, **how).image


def same(a, b):
    return a.shape == b.shape and np.array_equal(a.view(np.uint64), b.view(np.uint64))


class Drawn(samplekit.Sampler):
    """The slow door: a whole set at once."""

    def draw(self, count, dims, rng):
        return rng.random((count, dims))


class DrawnInParts(Drawn):
    """The same points by the fast door."""

    def fill(self, out, realizations, count, start):
        Drawn.__base__.fill(self, out, realizations, count, start)


class Edges(samplekit.Sampler):
    """The last float64 before 1, or 0: where rounding could carry a sample over the pixel's edge."""

    def fill(self, out, *_):
        out[:] = (1.0 - 2.0**-53, 0.0)[out.shape[2] % 2]


class Broken(samplekit.Sampler):
    """Works for the first rows of the image."""

    def fill(self, out, realizations, count, start):
        if (realizations.y > 3).any():
            raise ValueError("no such row")
        out[:] = 0.5


class Holes(samplekit.Scene):
    """The value ``bad`` where x < 1/4, y elsewhere."""

    def __init__(self, bad):
        self.bad = float(bad)

    def value(self, points):
        return np.where(points[0] < 0.25, self.bad, points[1])

    def exact(self, x_edges, y_edges):
        return np.multiply.outer(0.5 * (y_edges[1:] + y_edges[:-1]), np.ones(x_edges.size - 1))


class Secret(samplekit.Scene):
    """A scene that gives no reference."""

    def value(self, points):
        return points[0]

    def exact(self, x_edges, y_edges):
        raise LookupError("two\nlines")


# --- what the image does not depend on -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("scene", "sampler", "count"),
    [
        ("zoneplate", "random", 5),
        ("gaussian", "sobol+owen", 1025),
        ("disk", "jittered", 6),
        ("checker:cells=7", "halton+shift", 3),
        ("bilinear", "latin-hypercube", 1025),
        ("step:angle=30", "Drawn", 7),
        ("gaussian", "Drawn", 1500),
    ],
)
def test_threads_and_tiles_leave_no_trace(scene, sampler, count):
    sampler = a_sampler(sampler) if sampler == "Drawn" else sampler
    expected = image(scene, sampler, count, (33, 17), threads=1)
    for threads in (1, 2, 7):
        for tile_bytes in (1, 16 * count * 5, 2**17, 2**26):
            assert same(image(scene, sampler, count, (33, 17), threads=threads, tile_bytes=tile_bytes), expected)
    assert same(image(scene, sampler, count, (33, 17)), expected)


@pytest.mark.parametrize("scene", ["zoneplate", "disk", "checker:cells=7"])
@pytest.mark.parametrize("sampler", ["random", "hammersley+owen"])
def test_a_crop_equals_the_same_pixels_of_the_whole(scene, sampler):
    whole = image(scene, sampler, 9, (45, 31), seed=5)
    for x, y, w, h in [(0, 0, 45, 31), (0, 0, 1, 1), (44, 30, 1, 1), (7, 11, 20, 3), (0, 30, 45, 1), (44, 0, 1, 31)]:
        part = image(scene, sampler, 9, (45, 31), crop=(x, y, w, h), seed=5)
        assert same(part, np.ascontiguousarray(whole[y : y + h, x : x + w]))


@pytest.mark.parametrize("scene", [*OUR_SCENES, *VARIANTS])
def test_pixels_left_out_are_as_if_they_had_been_sampled(scene):
    for size, count in [((48, 40), 1), ((31, 17), 3), ((5, 7), 1000), ((2, 3), 1024), ((4, 4), 1025), ((3, 2), 5000)]:
        assert same(image(scene, "random", count, size), image(scene, "random", count, size, full=True))


def test_pixels_of_samplers_that_touch_the_edges_likewise():
    for scene in (*(name for name in OUR_SCENES if samplekit.scene(name).dims == 2), *VARIANTS):
        for count in (1, 2):
            for size in ((49, 51), (48, 40)):
                arguments = scene, a_sampler("Edges"), count, size
                assert same(image(*arguments), image(*arguments, full=True)), scene


def test_an_image_is_the_same_twice_and_another_with_another_seed():
    first = image("zoneplate", "random", 4, (16, 16))
    assert same(first, image("zoneplate", "random", 4, (16, 16)))
    assert not np.isin(image("zoneplate", "random", 4, (16, 16), seed=1), first).any()


# --- what the image is -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sampler", ["random", "jittered", "sobol+owen", "hammersley"])
@pytest.mark.parametrize("count", [1, 16, 1024, 4096])
def test_a_pixel_is_the_mean_over_its_own_points(sampler, count):
    rendered = image("gaussian", sampler, count, (5, 3), seed=9)
    source = samplekit.sampler(sampler)
    y, x = np.divmod(np.arange(15), 5)
    points = np.empty((15, 2, count))
    source.fill(points, Realizations.of_pixels(x, y, 9), count, 0)
    u, v = (x[:, None] + points[:, 0]) / 5, (y[:, None] + points[:, 1]) / 3
    expected = np.exp(-((u - 0.4523) ** 2 + (v - 0.5317) ** 2) / 0.02).mean(axis=1)
    np.testing.assert_allclose(rendered.ravel(), expected, rtol=0, atol=1e-14)


@pytest.mark.parametrize("count", [1, 3, 1000, 1024, 1025, 5000])
def test_points_drawn_whole_give_the_image_of_the_same_points_in_parts(count):
    expected = image("zoneplate:k=100", a_sampler("DrawnInParts"), count, (3, 2))
    assert same(image("zoneplate:k=100", a_sampler("Drawn"), count, (3, 2)), expected)


def test_x_goes_right_and_y_goes_down():
    rendered = samplekit.render("step:offset=0.5", "regular", 4, size=(4, 2))
    assert rendered.image.tolist() == [[1, 1, 0, 0]] * 2
    rendered = samplekit.render("step:angle=90,offset=0.5", "regular", 4, size=(4, 2))
    assert rendered.image.tolist() == [[1] * 4, [0] * 4]


def test_every_pixel_is_told_apart_by_its_error():
    rendered = samplekit.render("bilinear", "random", 4, size=(40, 30), seed=2)
    assert np.array_equal(rendered.error, rendered.image - rendered.reference)
    assert rendered.image.dtype == rendered.reference.dtype == np.float64
    assert rendered.image.shape == rendered.reference.shape == (30, 40)
    assert rendered.metrics["mse"] == pytest.approx(np.mean(rendered.error**2), rel=1e-12)
    assert np.unique(rendered.error).size == 1200


@pytest.mark.parametrize("scene", OUR_SCENES)
def test_one_pixel_is_an_image(scene):
    rendered = samplekit.render(scene, "random", 1, size=(1, 1), error=scene in ("disk", "zoneplate", "bilinear"))
    assert rendered.image.shape == (1, 1)
    assert np.isfinite(rendered.image).all()
    assert rendered.metrics["samples"] == rendered.metrics["pixels_sampled"] == 1


def test_what_comes_with_an_image():
    rendered = samplekit.render("disk", "jittered", 6, size=(32, 20), crop=(3, 4, 10, 5), ssim=False)
    metrics = rendered.metrics
    for name in ("mse", "rmse", "mae", "max_error", "bias", "psnr"):
        assert isinstance(metrics[name], float)
    assert metrics["dims"] == 2
    assert metrics["pixels_sampled"] + metrics["pixels_left_out"] == 50
    assert metrics["samples"] == 6 * metrics["pixels_sampled"]
    assert {"points", "scene", "reference", "total"} <= set(rendered.seconds)
    assert all(seconds >= 0 for seconds in rendered.seconds.values())
    assert rendered.plan.pixels.window == (3, 4, 10, 5)


class Compiled(samplekit.Scene):
    """A scene whose first call takes long, as if it compiled a kernel."""

    seconds = 0.2

    def value(self, points):
        time.sleep(self.seconds)
        self.seconds = 0.0
        return points[0]


@pytest.mark.parametrize("threads", [1, 2])
def test_what_the_first_call_takes_is_set_up(threads):
    made = samplekit.render(a_scene("toy", "Compiled"), "random", 1, size=(4, 3), threads=threads, error=False)
    assert made.seconds["setup"] >= 0.2 > made.seconds["points"] + made.seconds["scene"]
    assert made.threads == made.as_json()["threads"] == threads


def test_the_reference_is_left_out_with_all_that_needs_it():
    scene = a_scene("toy", "Secret")
    rendered = samplekit.render(scene, "random", 4, size=(4, 3), error=False)
    assert rendered.reference is rendered.error is None
    assert "mse" not in rendered.metrics
    assert rendered.seconds["reference"] == 0
    reason = r"scene toy of plugin toys \(toys 1\) cannot give its reference: LookupError: two lines"
    with pytest.raises(SamplekitError, match=reason):
        samplekit.render(scene, "random", 4, size=(4, 3))


# --- values that are not finite --------------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", ["nan", "inf", "-inf"])
@pytest.mark.parametrize("error", [True, False])
@pytest.mark.parametrize("count", [4, 1500])
def test_values_that_are_not_finite_are_counted_and_shown(bad, error, count):
    scene = a_scene("holes", "Holes", bad=bad)
    rendered = samplekit.render(scene, "random", count, size=(8, 3), error=error)
    assert rendered.metrics["invalid_pixels"] == 6
    assert rendered.metrics["invalid_samples"] == 6 * count
    assert not np.isfinite(rendered.image[:, :2]).any()
    assert np.isfinite(rendered.image[:, 2:]).all()
    if error:
        assert rendered.metrics["mse"] == pytest.approx(np.mean(rendered.error[:, 2:] ** 2))


def test_only_the_bad_samples_of_a_pixel_are_counted():
    # The hole is the left half of the left pixel.
    rendered = samplekit.render(a_scene("holes", "Holes", bad="nan"), "regular", 16, size=(2, 1))
    assert rendered.metrics["invalid_pixels"] == 1
    assert rendered.metrics["invalid_samples"] == 8


def test_a_sound_image_has_no_invalid_samples():
    assert "invalid_samples" not in samplekit.render("disk", "random", 4, size=(8, 8)).metrics


# --- threads, progress, failures -------------------------------------------------------------------------------------


@pytest.mark.parametrize("threads", [0, -1, 1025, 2.0, "2", True])
def test_numbers_of_threads_that_cannot_be_are_refused(threads):
    with pytest.raises(UsageError, match="expected an integer from 1 to 1024"):
        image("disk", "random", 4, (8, 8), threads=threads)


@pytest.mark.parametrize("threads", [1, 2])
def test_progress_rises_to_all_samples(threads):
    seen = []
    plan = make_plan(samplekit.scene("gaussian"), samplekit.sampler("random"), 1500, size=(20, 20), reference=False)
    rendered(plan, threads=threads, tile_bytes=2**16, progress=lambda done, total: seen.append((done, total)))
    done = [number for number, _ in seen]
    assert done == sorted(done)
    assert done[-1] == 400 * 1500
    assert {total for _, total in seen} == {400 * 1500}
    assert len(seen) > 10


@pytest.mark.parametrize("threads", [1, 3])
def test_a_sampler_that_fails_in_the_middle_ends_the_work_with_one_error(threads):
    before = threading.active_count()
    with pytest.raises(SamplekitError, match=r"sampler toy of plugin toys \(toys 1\) failed: ValueError: no such row"):
        image("gaussian", a_sampler("Broken"), 4, (64, 64), threads=threads, tile_bytes=4096)
    assert threading.active_count() == before


@pytest.mark.parametrize("threads", [1, 3])
def test_an_interrupt_stops_the_other_threads(threads):
    ticks = []

    def interrupted(done, total):
        ticks.append(done)
        if len(ticks) == 3:
            raise KeyboardInterrupt

    began = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        image("gaussian", "random", 2**20, (64, 64), threads=threads, progress=interrupted)
    # All of it would be 131072 ticks, and take a minute.
    assert time.perf_counter() - began < 30
    assert len(ticks) < 13107


def test_memory_does_not_grow_with_the_samples():
    def peak(count):
        tracemalloc.reset_peak()
        # One thread: of two, one may do all the work and the other allocate nothing.
        image("gaussian", "random", count, (64, 64), threads=1)
        return tracemalloc.get_traced_memory()[1]

    tracemalloc.start()
    try:
        peak(256)
        few, many = peak(256), peak(16384)
    finally:
        tracemalloc.stop()
    assert many < 1.2 * few
