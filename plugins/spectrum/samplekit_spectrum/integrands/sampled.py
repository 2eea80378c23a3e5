"""The power spectrum of any scene, approximated: an FFT of its means over small pixels.

The mean over a pixel is f * box, taken at a grid of K points a side: the coefficient at m is that of f times two sincs,
plus those at m + K j (aliases), each damped by its own sincs, which are small where m is.
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
    """The spectrum from pixel means, up to a quarter of the pixels' frequency; approximate, and marked as such.

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
    half = means.reshape(PIXELS // 2, 2, PIXELS // 2, 2).mean(axis=(1, 3))
    coarse = _coefficients(half)
    reach = PIXELS // 4
    overlap = PIXELS // 8
    index = np.arange(-overlap, overlap + 1)
    fine_part, coarse_part = table[np.ix_(index, index)], coarse[np.ix_(index, index)]
    # Halving the pixels moves the aliases: what that changes is about what they are.
    aliasing = float(np.abs(fine_part - coarse_part).sum())

    def power(mx: NDArray[Any], my: NDArray[Any]) -> NDArray[np.float64]:
        return np.asarray(table[np.asarray(my), np.asarray(mx)], np.float64)

    mean = float(means.mean())
    return Integrand(scene.text, mean, _energy(scene), power, reach=reach, approximate=True, aliasing=aliasing)


def _coefficients(means: NDArray[np.float64]) -> NDArray[np.float64]:
    """|f(m)|^2 at [my, mx], negative frequencies counted from the end."""
    from scipy import fft

    side = means.shape[0]
    damping = np.sinc(fft.fftfreq(side)) ** 2
    power = np.abs(fft.fft2(means, norm="forward")) ** 2
    return np.asarray(power / (damping[:, None] * damping), np.float64)


def _energy(scene: ConfiguredScene) -> float:
    """The mean of f^2 over one sample in each of K x K pixels, at a place that is always the same."""
    total = 0.0
    rng = np.random.Generator(np.random.Philox(key=1))
    for row in range(0, PIXELS, 64):
        left, top = np.meshgrid(np.arange(PIXELS) / PIXELS, np.arange(row, min(row + 64, PIXELS)) / PIXELS)
        width = np.full(left.size, 1.0 / PIXELS)
        boxes = np.ascontiguousarray([left.ravel(), width, top.ravel(), width])
        values = np.empty(left.size)
        scene.sums(rng.random((left.size, 2, 1)), boxes, values)
        total += float((values**2).sum())
    return total / PIXELS**2
