"""Hits."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NO_HITS, FEW_HITS = "no hits", "few hits"
FEWEST_HITS = 5.0


def effective_hits(estimates: NDArray[np.float64], rounding: float = 0.0) -> float:
    distances = np.abs(estimates - np.sort(estimates)[estimates.size // 2])
    distances = np.where(distances <= rounding, 0.0, distances)
    largest = float(distances.max(initial=0.0))
    if not largest > 0.0:
        return 0.0
    distances = distances / largest
    return float(distances.sum() ** 2 / (distances @ distances))
