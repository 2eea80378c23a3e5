"""An axis of a chart, linear or logarithmic: where values go, and which are marked."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from samplekit._drawing.drawing import label, round_ticks

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Axis:
    """Values from ``low`` to ``high`` along an axis.

    Attributes
    ----------
    low, high
        Finite, low < high; above 0 if logarithmic.
    name
        What it says beside the axis.
    base
        None: linear. 10 or 2: logarithmic, with marks at powers of it.
    """

    low: float
    high: float
    name: str = ""
    base: int | None = None

    def share(self, values: ArrayLike) -> NDArray[np.float64]:
        """How far along the axis values are, from 0 at ``low`` to 1 at ``high``."""
        array = np.asarray(values, np.float64)
        if self.base is None:
            return (array - self.low) / (self.high - self.low)
        return np.log(array / self.low) / math.log(self.high / self.low)

    def ticks(self, most: int = 6) -> list[tuple[float, str]]:
        """Values to mark, about ``most`` at the most, and how they are written."""
        if self.base is None:
            return [(value, label(value)) for value in round_ticks(self.low, self.high, most)]
        first = math.ceil(math.log(self.low, self.base) - 1e-9)
        last = math.floor(math.log(self.high, self.base) + 1e-9)
        step = max(1, -(-(last - first + 1) // most))
        exponents: Sequence[int] = range(first + -first % step, last + 1, step)
        return [(float(self.base) ** exponent, self._written(exponent)) for exponent in exponents]

    def _written(self, exponent: int) -> str:
        if self.base == 2 and 0 <= exponent < 20:
            return str(2**exponent)
        return label(10.0**exponent) if self.base == 10 else f"{self.base}^{exponent}"


def spanning(values: ArrayLike, name: str = "", base: int | None = None, room: float = 0.04) -> Axis:
    """Make the axis that holds all values that can be drawn, with ``room`` (a part of its length) at either end.

    Values that are not finite, or not above 0 on a logarithmic axis, cannot be drawn; without any that can the axis
    goes from 0 to 1, or from 1 to 10.
    """
    array = np.asarray(values, np.float64).ravel()
    array = array[np.isfinite(array) & ((array > 0.0) if base is not None else True)]
    if not array.size:
        return Axis(0.0, 1.0, name) if base is None else Axis(1.0, 10.0, name, base)
    low, high = float(array.min()), float(array.max())
    if base is None:
        margin = room * ((high - low) or max(abs(high), 1.0))
        return Axis(low - margin, high + margin, name)
    if low == high:
        return Axis(low / base, high * base, name, base)
    factor = (high / low) ** room
    return Axis(low / factor, high * factor, name, base)
