"""A reference image, and how exact it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Reference:
    """A reference image.

    Attributes
    ----------
    image
        float64[h, w].
    error
        Bound of its error beyond rounding, in any pixel; 0: exact.
    numerical
        The bound is an estimate of adaptive quadrature: the scene gives no reference of its own.

    Examples
    --------
    >>> import numpy as np
    >>> from samplekit import Reference
    >>> Reference(np.zeros((4, 4))).kind
    'exact'
    """

    image: NDArray[np.float64]
    error: float = 0.0
    numerical: bool = False

    @property
    def kind(self) -> str:
        """How exact it is, in words."""
        if self.numerical:
            return f"adaptive quadrature, estimated within {self.error:.1g}"
        return f"within {self.error:g}" if self.error else "exact"
