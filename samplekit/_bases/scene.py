"""The scene: an integrand over the unit square, and over lens, time and direction, with its exact mean over pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray


class Scene:
    """Base of all scenes. Options arrive by keyword, parsed; dashes in their names are underscores here.

    A scene defines either ``value``, in NumPy, or ``sums``, a compiled kernel, which is faster. Everything else has
    defaults: without ``exact`` the reference is integrated numerically, with an estimate of its error.

    Attributes
    ----------
    reference_error
        Bound of the error of ``exact`` in any pixel, beyond rounding; 0: exact.
    finite_variance
        Whether the square of the integrand has a finite integral; where not, a standard error means nothing.
    finite_kurtosis
        Whether the fourth power of the integrand has a finite integral; where not, squared errors have no standard
        error.
    value_range
        A lower and an upper bound of the integrand over the unit square; None: not known. Where no sample found what
        makes up an error, it is all that bounds the error.

    Examples
    --------
    >>> import samplekit
    >>> class Ramp(samplekit.Scene):
    ...     def value(self, points):
    ...         x, y = points
    ...         return x
    """

    reference_error: float = 0.0
    finite_variance: bool = True
    finite_kurtosis: bool = True
    value_range: tuple[float, float] | None = None

    def notes(self) -> list[str]:
        """Return sentences that a user of this scene should read: ``--explain`` shows them, the image keeps them."""
        return []

    def dimensions(self) -> Mapping[str, int]:
        """Dimensions needed with these options, by purpose and in their order: ``{"pixel": 2}``."""
        return {"pixel": 2}

    def value(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """The integrand float64[M] at ``points`` float64[D, M]: rows x, y in the scene, the others in [0, 1)."""
        raise NotImplementedError(f"{type(self).__name__} defines neither value nor sums")

    def sums(self, tile: NDArray[np.float64], boxes: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Sum the integrand over the samples of each pixel.

        Parameters
        ----------
        tile
            float64[P, D, n], n <= 1024, C order: for each pixel samples in [0, 1)^D, dimension by dimension;
            dimensions 0 and 1 are the place within the pixel.
        boxes
            float64[4, P], C order: left edge, width, top edge, height of each pixel. Sample u is at left + u * width.
        out
            float64[P], receives the sums.
        """
        from samplekit.kernels import row_sums

        pixels, dims, count = tile.shape
        points = np.empty((dims, pixels * count))
        points[0] = (boxes[0][:, None] + tile[:, 0] * boxes[1][:, None]).ravel()
        points[1] = (boxes[2][:, None] + tile[:, 1] * boxes[3][:, None]).ravel()
        for dimension in range(2, dims):
            points[dimension] = tile[:, dimension].ravel()
        values = np.ascontiguousarray(self.value(points), np.float64)
        if values.shape != (pixels * count,):
            raise ValueError(f"value gave shape {values.shape} for {pixels * count} points")
        row_sums(values.reshape(pixels, count), out)

    def values(self, tile: NDArray[np.float64], boxes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Evaluate the integrand at each sample.

        Parameters
        ----------
        tile, boxes
            Samples float64[P, D, n] and pixels float64[4, P], as in :meth:`sums`.

        Returns
        -------
        float64[P, n]
        """
        # Each sample as a pixel of its own: the sum of one value is that value.
        pixels, dims, count = tile.shape
        single = np.ascontiguousarray(tile.transpose(0, 2, 1)).reshape(pixels * count, dims, 1)
        values = np.empty(pixels * count)
        self.sums(single, np.repeat(boxes, count, axis=1), values)
        return values.reshape(pixels, count)

    def parts(self, tile: NDArray[np.float64], boxes: NDArray[np.float64]) -> Sequence[NDArray[np.float64]]:
        """Return terms float64[P, n] whose exact sum is the value at each sample before it was rounded.

        A run in extended precision adds them up. By default the only term is the rounded value itself. ``tile`` and
        ``boxes`` as in :meth:`sums`.
        """
        return (self.values(tile, boxes),)

    def exact(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Return the exact mean over each pixel, or None if there is no closed form.

        Parameters
        ----------
        x_edges, y_edges
            The edges of the pixels as they are stored, float64[w + 1] and float64[h + 1].

        Returns
        -------
        float64[h, w], or None: then adaptive quadrature gives the reference and says how far it can be trusted.
        """
        return None

    def exact_at(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64] | None:
        """Return the exact mean over all other dimensions at the points x float64[w] by y float64[h].

        Returns
        -------
        float64[h, w], or None: then Gauss rules give the reference.
        """
        return None

    def constant(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the value of each pixel in which the integrand is provably constant, NaN elsewhere: float64[h, w]."""
        return np.full((y_edges.size - 1, x_edges.size - 1), np.nan)
