"""Scenes that give values alone: their references, and what is said of them."""

import json
import math

import numpy as np
import pytest

import samplekit
from samplekit import Scene, UsageError
from samplekit._builtin.scenes.depth_of_field import DepthOfField
from samplekit._builtin.scenes.disk import Disk
from samplekit._builtin.scenes.zoneplate import ZonePlate
from samplekit._threads import requesting
from samplekit.quadrature._numerical import numerical_means, numerical_means_at


class PlainDisk(Scene):
    def value(self, points):
        return (points[0] - 0.4523) ** 2 + (points[1] - 0.5317) ** 2 < 0.09


class Rings(Scene):
    def value(self, points):
        return 0.5 + 0.5 * np.cos(200.0 * (points[0] ** 2 + points[1] ** 2))


class Blurred(Scene):
    """x + lens, squared, times time: the mean over lens and time is (x^2 + x + 1/3) / 2 (over y nothing varies)."""

    def dimensions(self):
        return {"pixel": 2, "lens": 2, "time": 1}

    def value(self, points):
        return (points[0] + points[2]) ** 2 * points[4]


class Hidden(Scene):
    """The layers of depth of field, through kernels alone."""

    def dimensions(self):
        return {"pixel": 2, "lens": 2}

    def sums(self, tile, boxes, out):
        DepthOfField().sums(tile, boxes, out)


def test_an_edge_is_found_and_the_estimate_holds():
    edges = np.arange(25) / 24
    reference = numerical_means(PlainDisk(), edges, edges)
    error = np.abs(reference.image - Disk().exact(edges, edges))
    assert error.max() < 1e-4
    assert math.sqrt((error**2).mean()) < 2e-6
    assert error.max() <= reference.error < 2e-3
    assert reference.numerical


@pytest.mark.slow
def test_errors_are_those_that_the_page_for_authors_states():
    edges = np.arange(257) / 256
    reference = numerical_means(PlainDisk(), edges, edges)
    error = np.abs(reference.image - Disk().exact(edges, edges))
    assert error.max() < 2e-4
    assert math.sqrt((error**2).mean()) == pytest.approx(1.4e-6, rel=0.05)
    assert reference.error == pytest.approx(1.1e-3, rel=0.05)
    edges = np.arange(65) / 64
    reference = numerical_means(Hidden(), edges, edges)
    assert np.abs(reference.image - DepthOfField().exact(edges, edges)).max() == pytest.approx(0.04, rel=0.1)
    assert reference.error == pytest.approx(0.06, rel=0.1)


def test_a_smooth_scene_far_beyond_the_tolerance():
    edges = np.arange(25) / 24
    reference = numerical_means(Rings(), edges, edges)
    assert np.abs(reference.image - ZonePlate(k=200.0).exact(edges, edges)).max() < 1e-8


def test_further_dimensions():
    edges = np.arange(9) / 8
    reference = numerical_means(Blurred(), edges, edges)
    a, b = edges[:-1], edges[1:]
    squares = (b**3 - a**3) / 3 / (b - a)
    np.testing.assert_allclose(reference.image[0], (squares + 0.5 * (a + b) + 1 / 3) / 2, rtol=1e-12)
    assert reference.error < 1e-12
    x = np.array([0.2, 0.7])
    at = numerical_means_at(Blurred(), x, np.array([0.5]))
    np.testing.assert_allclose(at.image[0], (x**2 + x + 1 / 3) / 2, rtol=1e-12)


def test_steps_in_further_dimensions_are_confessed():
    edges = np.arange(9) / 8
    reference = numerical_means(Hidden(), edges, edges)
    error = np.abs(reference.image - DepthOfField().exact(edges, edges))
    assert error.max() <= reference.error
    assert 0.01 < reference.error < 0.5


class Crowded(Scene):
    def dimensions(self):
        return {"pixel": 2, "lens": 14}

    def value(self, points):
        return points[0]


def test_too_many_dimensions_are_refused_in_one_line():
    edges = np.arange(5) / 4
    with pytest.raises(UsageError, match="16 dimensions takes too long") as caught:
        numerical_means(Crowded(), edges, edges)
    assert "\n" not in str(caught.value)


@pytest.fixture
def stranger():
    """A configured scene that is a stranger's plain disk."""
    scene = samplekit.scene("disk")
    scene._scene = PlainDisk()
    return scene


def test_metrics_and_metadata_say_that_it_is_no_exact_reference(stranger):
    result = samplekit.render(stranger, "random", 4, size=(16, 16))
    assert 0 < result.metrics["reference_error"] < 1e-2
    described = result.describe()
    assert described["reference"].startswith("adaptive quadrature, estimated within")
    assert described["metrics"]["reference_error"] == result.metrics["reference_error"]
    json.dumps(described, allow_nan=False)
    exact = samplekit.render("disk", "random", 4, size=(16, 16))
    assert "reference_error" not in exact.metrics
    assert exact.describe()["reference"] == "exact"
    bounded = samplekit.render("ambient-occlusion", "random", 4, size=(4, 4))
    assert bounded.metrics["reference_error"] == 1e-8
    assert bounded.describe()["reference"] == "within 1e-08"
    assert samplekit.render("disk", "random", 4, size=(4, 4), error=False).describe()["reference"] == ""


def test_it_is_the_same_on_any_number_of_processors():
    edges = np.arange(65) / 64
    with requesting(3):
        many = numerical_means(Rings(), edges, edges).image
    with requesting(1):
        np.testing.assert_array_equal(numerical_means(Rings(), edges, edges).image, many)
