"""An integrand: its power spectrum, its mean and its energy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Coefficients = Callable[[NDArray[Any], NDArray[Any]], NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Integrand:
    """An integrand over the unit square.

    Attributes
    ----------
    name
        The scene's text.
    mean, energy
        The integrals of f and of f^2. The variance of one random sample is energy - mean^2.
    power
        |f(m)|^2 for integer frequencies (mx, my) other than 0, two arrays int64 of one shape.
    reach
        Largest |m|_inf at which ``power`` may be called; None: any.
    axes_only
        True if f(m) is 0 at all m off the axes.
    approximate, aliasing
        True without a closed form; and then about the error of the sum of ``power``, from halving the resolution.
    """

    name: str
    mean: float
    energy: float
    power: Coefficients
    reach: int | None = None
    axes_only: bool = False
    approximate: bool = False
    aliasing: float = 0.0

    @property
    def variance(self) -> float:
        """Variance of one random sample: by Parseval's identity, the sum of |f(m)|^2 over all m other than 0."""
        return max(self.energy - self.mean**2, 0.0)
