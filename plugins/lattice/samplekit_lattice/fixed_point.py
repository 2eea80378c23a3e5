"""Points as 64-bit fractions, where a shift modulo 1 is an addition that wraps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import Realizations


def shifted(fractions: NDArray[np.uint64], realizations: Realizations) -> NDArray[np.float64]:
    """``fractions`` uint64[D, n] plus a random shift for each realisation and dimension: float64[R, D, n] in [0, 1)."""
    shifts = realizations.random_words(fractions.shape[0])
    moved = fractions + shifts[:, :, None]
    return (moved >> np.uint64(11)).astype(np.float64) * 2.0**-53
