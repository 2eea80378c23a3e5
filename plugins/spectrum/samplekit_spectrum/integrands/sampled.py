"""An approximation of the power spectrum of any scene: an FFT of its means over small pixels.

The means over pixels are f * box, sampled on a grid with K points a side. Their coefficient at m is that of f times two
sincs, plus those at m + K j (aliases), each damped by its own sincs, which are small if m is small.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit import SamplekitError
from samplekit_spectrum.integrands.integrand import Integrand

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit import ConfiguredScene

PIXELS = 2048


def sampled_integrand(scene: ConfiguredScene) -> Integrand:
    """Return the spectrum from pixel means, up to a quarter of the pixels' frequency; it is marked as approximate.

    Raises
    ------
    SamplekitError
        The scene has no reference, or it is not finite.
    """
    edges = np.arange(PIXELS + 1) / PIXELS
    means = scene.reference(edges, edges).image
    if not np.isfinite(means).all():
        raise SamplekitError(f"{scene.text} is not finite: its variance cannot be predicted")
    table = _coefficients(means)
    coarse = _coefficients(means.reshape(PIXELS // 2, 2, PIXELS // 2, 2).mean(axis=(1, 3)))
    # Halving the number of pixels moves the aliases, so the difference is about as large as the aliases.
    low = np.arange(-(PIXELS // 8), PIXELS // 8 + 1)
    aliasing = float(np.abs(table[np.ix_(low, low)] - coarse[np.ix_(low, low)]).sum())

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        return np.asarray(table[my, mx])

    return Integrand(
        scene.text, float(means.mean()), _energy(scene), power,
        reach=PIXELS // 4, approximate=True, aliasing=aliasing,
    )  # fmt: skip


def _coefficients(means: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return |f(m)|^2 at [my, mx]; negative frequencies count from the end, as in NumPy's indices."""
    from scipy import fft

    side = means.shape[0]
    damping = np.sinc(fft.fftfreq(side)) ** 2
    power = np.abs(fft.fft2(means, norm="forward")) ** 2
    return np.asarray(power / (damping[:, None] * damping), np.float64)


def _energy(scene: ConfiguredScene) -> float:
    """Return the mean of f^2 over K x K samples, one at a random but reproducible place in each pixel."""
    total = 0.0
    rng = np.random.Generator(np.random.Philox(key=1))
    for row in range(0, PIXELS, 64):
        left, top = np.meshgrid(np.arange(PIXELS) / PIXELS, np.arange(row, row + 64) / PIXELS)
        width = np.full(left.size, 1.0 / PIXELS)
        boxes = np.ascontiguousarray([left.ravel(), width, top.ravel(), width])
        values = np.empty(left.size)
        scene.sums(rng.random((left.size, 2, 1)), boxes, values)
        total += float((values**2).sum())
    return total / PIXELS**2
