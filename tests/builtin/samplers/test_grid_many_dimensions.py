"""Grids in hundreds of dimensions: made, or refused at once."""

import pytest

import samplekit
from samplekit import UsageError


def test_many_dimensions_of_a_grid():
    assert samplekit.points("jittered", 1, 2000).shape == (1, 1, 2000)


def test_the_nearest_grid_in_many_dimensions_is_found_soon():
    with pytest.raises(UsageError, match="65536 and 131072"):
        samplekit.points("jittered", 100003, 100)
