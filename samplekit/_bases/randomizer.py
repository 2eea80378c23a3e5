"""The randomizer: makes a random realisation of any point set, by changing the points' coordinates alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit._bases.realizations import Realizations


class Randomizer:
    """Base of all randomizers.

    Examples
    --------
    >>> import numpy as np, samplekit
    >>> class Mirror(samplekit.Randomizer):
    ...     def apply(self, points, realizations, bases):
    ...         points[:] = np.nextafter(1.0, 0.0) - points
    """

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...]) -> None:
        """Randomise ``points`` float64[R, D, n] in place: by coordinate, key and dimension alone.

        ``bases``: the base in which each dimension's digits were built.
        """
        raise NotImplementedError(f"{type(self).__name__} defines no apply")
