"""Pixels, and sums over them, for the tests of scenes."""

import numpy as np
import pytest

LAST = 1.0 - 2.0**-53


def _boxes_of(x_edges, y_edges):
    """Boxes float64[4, P] of the pixels between edges, row after row: left, width, top, height."""
    left, top = np.meshgrid(x_edges[:-1], y_edges[:-1])
    width, height = np.meshgrid(np.diff(x_edges), np.diff(y_edges))
    return np.ascontiguousarray([left.ravel(), width.ravel(), top.ravel(), height.ravel()])


def _sums(scene, tile, boxes):
    out = np.full(tile.shape[0], np.nan)
    scene.sums(tile, boxes, out)
    return out


def _constant_pixels(scene, size):
    """What ``constant`` says of each pixel of a square image, and the mean of 32 of its samples, extreme ones too."""
    edges = np.arange(size + 1) / size
    special = np.array([0.0, 2.0**-53, 0.5, LAST])
    tile = np.random.default_rng(4).random((size**2, 2, 32))
    tile[:, :, :16] = np.stack(np.meshgrid(special, special)).reshape(2, -1)
    return scene.constant(edges, edges).ravel(), _sums(scene, tile, _boxes_of(edges, edges)) / 32


@pytest.fixture
def boxes_of():
    return _boxes_of


@pytest.fixture
def sums():
    return _sums


@pytest.fixture
def constant_pixels():
    return _constant_pixels
