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


@pytest.fixture
def exact_cells():
    return _exact_cells
