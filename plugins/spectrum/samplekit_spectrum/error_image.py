"""The spectrum of an error image: whether a rendering's error is white, or pushed to high frequencies (blue).

Errors of equal size look the smaller the higher their frequencies (Georgiev, Fajardo 2016, "Blue-noise dithered
sampling"). Errors that are independent from pixel to pixel have a flat expected spectrum, also where some pixels err
more than others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit import SamplekitError, UsageError
from samplekit_spectrum.radial import Radial

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike, NDArray

    from samplekit_spectrum.map_display import MapDisplay
    from samplekit_spectrum.radial_display import RadialDisplay

LOW = 0.125
"""Cycles per pixel below which a frequency counts as low: a quarter of the highest."""

_SIGNIFICANT = 4.0


@dataclass(frozen=True, eq=False)
class ErrorSpectrum:
    """The power of an error image, 1 on average.

    Attributes
    ----------
    power
        float64[h, w], DC in the middle and NaN: the power over its mean over all other frequencies.
    radial
        Its mean over rings, frequencies in cycles per pixel; standard errors from the spread over each ring, as if all
        pixels erred alike.
    low, low_standard_error
        The mean below 0.125 cycles per pixel; its standard error allows for pixels that err more than others.
    bias, rmse
        The image's mean, and the root of its mean square.
    verdict
        ``"blue"``, ``"white"``, ``"red"`` (low frequencies stand out), ``"exact"`` (no error but perhaps a constant),
        or ``"too small"``.
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
            Stands above a new figure; by default the verdict.
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
            Stands above a new figure; by default the verdict.
        """
        from samplekit_spectrum.radial_display import RadialDisplay

        return RadialDisplay.from_error(self, title or f"spectrum of an error: {self.verdict}").plot(ax, axes=axes)


def read_error(path: Path) -> NDArray[np.float64]:
    """The part ``error`` of an EXR file.

    Raises
    ------
    UsageError
        No such file, or it has no such part.
    SamplekitError
        It is damaged.
    """
    from samplekit.files import read_parts

    parts = read_parts(path).parts
    if "error" not in parts:
        raise UsageError(f"{path.name} has no part 'error' but {', '.join(parts)}: render it without --no-error")
    return parts["error"]


def error_spectrum(error: ArrayLike) -> ErrorSpectrum:
    """The spectrum of an error image float64[h, w] or float64[h, w, 3]; of three channels the mean of their powers.

    Raises
    ------
    UsageError
        Another shape, or fewer than 2 pixels along a side.
    SamplekitError
        An error that is not finite.
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
    # Scaled first, so that squares neither overflow nor vanish.
    size = float(np.abs(channels - means).max())
    deviations = (channels - means) / (size or 1.0)
    power = (np.abs(fft.fft2(deviations, axes=(0, 1))) ** 2).mean(axis=2)
    power[0, 0] = 0.0
    exact = size <= 1e-15 * float(np.abs(means).max()) or size == 0.0
    power *= (height * width - 1) / power.sum() if not exact else 0.0
    y, x = fft.fftfreq(height)[:, None], fft.fftfreq(width)
    radius = np.hypot(x, y)
    rings = _rings(power, radius, min(height, width))
    # Half of the frequencies are mirror images of the others.
    low = power[(radius < LOW) & (radius > 0.0)]
    mean = float(low.mean()) if low.size else float("nan")
    spread = _spread(deviations, (radius < LOW) & (radius > 0.0)) if low.size and not exact else float("nan")
    verdict = "exact" if exact else _verdict(mean, spread, low.size)
    shifted = fft.fftshift(power)
    shifted[height // 2, width // 2] = np.nan
    scale = float(np.abs(channels).max()) or 1.0
    rmse = scale * float(np.sqrt(((channels / scale) ** 2).mean()))
    return ErrorSpectrum(shifted, rings, mean, spread, float(means.mean()), rmse, verdict)


def _rings(power: NDArray[np.float64], radius: NDArray[np.float64], side: int) -> Radial:
    """Rings a frequency wide, up to the highest that has all directions."""
    number = np.floor(radius * side + 0.5).astype(np.int64)
    last = side // 2
    inside = (number >= 1) & (number <= last)
    counts = np.maximum(np.bincount(number[inside], minlength=last + 1), 1)
    mean = np.bincount(number[inside], power[inside], last + 1) / counts
    deviations = (power - mean[np.minimum(number, last)]) ** 2
    variance = np.bincount(number[inside], deviations[inside], last + 1) / np.maximum(counts - 1, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        anisotropy = 10.0 * np.log10(variance / mean**2)
    return Radial(
        np.arange(1, last + 1) / side,
        counts[1:].astype(np.int64),
        mean[1:],
        np.sqrt(2.0 * variance / counts)[1:],
        np.where(variance == 0.0, -np.inf, anisotropy)[1:],
    )


def _spread(deviations: NDArray[np.float64], low: NDArray[np.bool_]) -> float:
    """Standard error of the mean power of low frequencies, if errors e are independent but not equally large.

    The power is the sum of beta(i - j) e_i e_j, beta the transform of ``low``: its variance is twice the sum over i
    and j, not equal, of beta^2 E[e_i^2] E[e_j^2], of which e_i^2 e_j^2 is an unbiased estimate. Channels may depend
    on each other.
    """
    from scipy import fft

    pixels = low.size
    squared_beta = fft.fft2(low.astype(np.float64)).real ** 2
    squared_beta[0, 0] = 0.0
    total = 0.0
    for channel in np.moveaxis(deviations, 2, 0):
        spectrum = np.abs(fft.fft2(channel**2)) ** 2
        products = fft.ifft2(spectrum).real
        total += float(np.sqrt(2.0 * max(float((squared_beta * products).sum()), 0.0)))
    mean = pixels * float((deviations**2).sum()) / (pixels - 1)
    return total / float(np.count_nonzero(low)) / mean


def _verdict(low: float, spread: float, frequencies: int) -> str:
    if frequencies < 32:
        return "too small"
    if abs(low - 1.0) <= _SIGNIFICANT * spread:
        return "white"
    return "blue" if low < 1.0 else "red"
