from fractions import Fraction

import numpy as np
import pytest


def _exact_cells(x, cells):
    """The integers floor(x cells), in rational arithmetic wherever rounding could matter."""
    scaled = x * float(cells)
    found = np.floor(scaled).astype(np.int64)
    if cells & (cells - 1) == 0:
        return found  # scaling by a power of 2 does not round
    near = np.abs(scaled - np.rint(scaled)) <= 4 * np.spacing(float(cells))
    found[near] = [int(Fraction(value) * cells) for value in x[near].tolist()]
    return found


def _rounded_cells(x, cells):
    """The cells between edges i / cells rounded to float64: where unscrambled fractions such as 1/3 lie on an edge."""
    return np.searchsorted(np.arange(cells + 1) / cells, x, side="right") - 1


@pytest.fixture
def exact_cells():
    return _exact_cells


@pytest.fixture
def rounded_cells():
    return _rounded_cells
