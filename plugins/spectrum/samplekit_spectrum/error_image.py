"""The spectrum of an error image: whether a rendering's error is white, or concentrated at high frequencies (blue).

Among errors of equal size, those of higher frequencies are less visible (Georgiev, Fajardo 2016, "Blue-noise dithered
sampling"). Errors that are independent from pixel to pixel have a flat expected spectrum, even if some pixels have
larger errors than others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit import SamplekitError, UsageError
from samplekit_spectrum.radial import Radial, anisotropy

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from samplekit_spectrum.map_display import MapDisplay
    from samplekit_spectrum.radial_display import RadialDisplay

LOW = 0.125
"""Cycles per pixel below which a frequency counts as low: a quarter of the highest."""

_SIGNIFICANT = 4.0
"""Number of standard errors from which a difference from white counts."""


@dataclass(frozen=True, eq=False)
class ErrorSpectrum:
    """The power of an error image, 1 on average.

    Attributes
    ----------
    power
        float64[h, w], DC in the middle and NaN: the power over its mean over all other frequencies.
    radial
        Its mean over rings, with frequencies in cycles per pixel. The standard errors come from the spread over each
        ring, which assumes that the errors of all pixels are equally large.
    low, low_standard_error
        The mean below 0.125 cycles per pixel. Its standard error allows for pixels with larger errors than others.
    bias, rmse
        The image's mean, and the root of its mean square.
    verdict
        ``"blue"``, ``"white"``, ``"red"`` (low frequencies are too strong), ``"exact"`` (no error, or the same error
        everywhere), or ``"too small"`` (fewer than 32 low frequencies).
    """

    power: NDArray[np.float64]
    radial: Radial
    low: float
    low_standard_error: float
    bias: float
    rmse: float
    verdict: str

    def plot(self, ax: Axes | None = None, *, title: str = "") -> MapDisplay:
        """Draw the power over the plane of frequencies.

        Parameters
        ----------
        ax
            The axes of matplotlib to draw on; None: a new figure.
        title
            Title of a new figure; by default the verdict.
        """
        from samplekit_spectrum.map_display import MapDisplay

        return MapDisplay.from_error(self, title or f"spectrum of an error: {self.verdict}").plot(ax)

    def plot_radial(self, ax: Axes | None = None, *, axes: Any = None, title: str = "") -> RadialDisplay:
        """Draw the radial mean, and the anisotropy.

        Parameters
        ----------
        ax
            The axes of matplotlib to draw the power on, without the anisotropy.
        axes
            Two of them, for both. None: a new figure.
        title
            Title of a new figure; by default the verdict.
        """
        from samplekit_spectrum.radial_display import RadialDisplay

        return RadialDisplay.from_error(self, title or f"spectrum of an error: {self.verdict}").plot(ax, axes=axes)


def read_error(path: Path) -> NDArray[np.float64]:
    """Read the part ``error`` of an EXR file.

    Raises
    ------
    UsageError
        There is no such file, or it has no such part.
    SamplekitError
        The file is damaged.
    """
    from samplekit.files import read_parts

    parts = read_parts(path).parts
    if "error" not in parts:
        raise UsageError(f"{path.name} has no part 'error' but {', '.join(parts)}: render it without --no-error")
    return parts["error"]


def error_spectrum(error: ArrayLike) -> ErrorSpectrum:
    """Compute the spectrum of an error image float64[h, w] or float64[h, w, 3], where channels share a mean power.

    Raises
    ------
    UsageError
        The image has another shape, or fewer than 2 pixels along a side.
    SamplekitError
        An error is not finite.
    """
    from scipy import fft

    values = np.asarray(error, np.float64)
    channels = values[:, :, None] if values.ndim == 2 else values
    if channels.ndim != 3 or min(channels.shape[:2]) < 2:
        raise UsageError(
            f"an error image must have shape [h, w] or [h, w, 3] and 2 pixels a side, not {list(values.shape)}"
        )
    if not np.isfinite(channels).all():
        raise SamplekitError("the error image holds values that are not finite: it has no spectrum")
    height, width, _ = channels.shape
    means = channels.mean(axis=(0, 1))
    # The deviations are scaled, so that their squares neither overflow nor vanish.
    size = float(np.abs(channels - means).max())
    deviations = (channels - means) / (size or 1.0)
    power = (np.abs(fft.fft2(deviations, axes=(0, 1))) ** 2).mean(axis=2)
    power[0, 0] = 0.0
    exact = size <= 1e-15 * float(np.abs(means).max())
    power *= (height * width - 1) / power.sum() if not exact else 0.0
    radius = np.hypot(fft.fftfreq(height)[:, None], fft.fftfreq(width))
    low = (radius < LOW) & (radius > 0.0)
    frequencies = int(np.count_nonzero(low))
    mean = float(power[low].mean()) if frequencies else float("nan")
    error = _standard_error(deviations, low) if frequencies and not exact else float("nan")
    shifted = fft.fftshift(power)
    shifted[height // 2, width // 2] = np.nan
    scale = float(np.abs(channels).max()) or 1.0
    return ErrorSpectrum(
        shifted,
        _radial(power, radius, min(height, width)),
        mean,
        error,
        bias=float(means.mean()),
        rmse=scale * float(np.sqrt(((channels / scale) ** 2).mean())),
        verdict="exact" if exact else _verdict(mean, error, frequencies),
    )


def _radial(power: NDArray[np.float64], radius: NDArray[np.float64], side: int) -> Radial:
    """Return the means over rings that are 1 / side wide, up to the highest frequency that has all directions."""
    last = side // 2
    rings = np.floor(radius * side + 0.5).astype(np.int64).ravel()
    # Ring 0 is DC and all that lies beyond the last ring.
    rings[rings > last] = 0
    counts = np.maximum(np.bincount(rings, minlength=last + 1), 1)
    mean = np.bincount(rings, power.ravel()) / counts
    variance = np.bincount(rings, (power.ravel() - mean[rings]) ** 2) / np.maximum(counts - 1, 1)
    return Radial(
        np.arange(1, last + 1) / side,
        counts[1:].astype(np.int64),
        mean[1:],
        np.sqrt(2.0 * variance / counts)[1:],
        anisotropy(variance, mean, 0.0)[1:],
    )


def _standard_error(deviations: NDArray[np.float64], low: NDArray[np.bool_]) -> float:
    """Return the standard error of the mean power of low frequencies, for errors e that are independent.

    They may differ in size. The power is the sum of beta(i - j) e_i e_j with the transform beta of ``low``. Its
    variance is twice the sum over all different i and j of beta^2 E[e_i^2] E[e_j^2], where e_i^2 e_j^2 is an unbiased
    estimate of the product of expectations. Channels may depend on each other.
    """
    from scipy import fft

    pixels = low.size
    squared_beta = fft.fft2(low.astype(np.float64)).real ** 2
    squared_beta[0, 0] = 0.0
    total = 0.0
    for channel in np.moveaxis(deviations, 2, 0):
        products = fft.ifft2(np.abs(fft.fft2(channel**2)) ** 2).real
        total += float(np.sqrt(2.0 * max(float((squared_beta * products).sum()), 0.0)))
    mean = pixels * float((deviations**2).sum()) / (pixels - 1)
    return total / float(np.count_nonzero(low)) / mean


def _verdict(low: float, error: float, frequencies: int) -> str:
    if frequencies < 32:
        return "too small"
    if abs(low - 1.0) <= _SIGNIFICANT * error:
        return "white"
    return "blue" if low < 1.0 else "red"
