"""What several figures of the gallery share: the layout of images, and where a figure is saved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np

import samplekit

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

mpl.use("agg")

folder = Path(__file__).parents[2] / "images"
"""Where ``save`` writes; ``build.py --output`` changes it."""

DPI = 100
MARGIN, GAP, LINE = 20, 14, 18
"""Pixels around a grid of images, between its images, and for a line of text."""

COUNT, REALIZATIONS, MAX_FREQUENCY = 256, 400, 64
"""The sets and the frequencies of the plates of samplers."""

ZONEPLATE_SAMPLERS = [
    "regular",
    "random",
    "jittered",
    "latin-hypercube",
    "multi-jittered",
    "correlated-multi-jittered",
    "poisson-disk",
    "lloyd",
    "ccvt",
    "hammersley",
    "halton",
    "halton+owen",
    "sobol",
    "sobol+shift",
    "sobol+xor",
    "sobol+owen",
    "owen-sobol",
    "pmj02",
    "z-sobol",
    "r2",
    "rank1",
    "orthogonal-array",
    "niederreiter+owen",
    "faure+owen",
]


def save(figure: Figure, script: str) -> None:
    """Write a figure as PNG under the name of the script that made it, and close it."""
    figure.savefig(folder / f"{Path(script).stem}.png", dpi=DPI, metadata={"Software": None})
    plt.close(figure)


def pixel_grid(
    rows: int, columns: int, size: int, title: str, *lines: str, gap: int = GAP, notes: int = 1, room: int = 0
) -> tuple[Figure, NDArray[Any]]:
    """Make a figure with a grid of square axes, each exactly ``size`` pixels wide, so that images are not resampled.

    Parameters
    ----------
    title, lines
        Text above the grid.
    gap
        Pixels between columns.
    notes
        Lines of text to leave room for below each row.
    room
        Pixels to leave free below the last row.

    Returns
    -------
    The figure, and its axes as an array of shape [rows, columns].
    """
    top = MARGIN + 8 + LINE * (len(lines) + 1)
    pitch = size + LINE * (1 + notes)
    width, height = 2 * MARGIN + columns * (size + gap) - gap, top + rows * pitch + room + MARGIN // 2
    figure = plt.figure(figsize=(width / DPI, height / DPI))
    for number, (text, font) in enumerate([(title, 12.5), *((line, 9.5) for line in lines)]):
        figure.text(MARGIN / width, 1 - (MARGIN + 8 + LINE * number) / height, text, fontsize=font)
    axes = np.empty((rows, columns), object)
    for row, column in np.ndindex(rows, columns):
        left, bottom = MARGIN + column * (size + gap), height - top - row * pitch - LINE - size
        panel = figure.add_axes((left / width, bottom / height, size / width, size / height))
        panel.set(xticks=[], yticks=[])
        panel.spines[:].set_visible(False)
        axes[row, column] = panel
    return figure, axes


def label(axes: Axes, above: str = "", *below: str) -> None:
    """Write a line above an image and lines below it, at its left edge."""
    axes.set_title(above, loc="left", fontsize=9, pad=4)
    axes.set_xlabel("\n".join(below), loc="left", fontsize=9)


def show_image(axes: Axes, values: NDArray[np.float64]) -> None:
    """Show linear values float64[h, w], encoded as sRGB (IEC 61966-2-1)."""
    values = np.clip(values, 0.0, 1.0)
    encoded = np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)
    axes.imshow(encoded, cmap="gray", vmin=0.0, vmax=1.0, interpolation="nearest")


def show_error(axes: Axes, error: NDArray[np.float64], scale: float) -> None:
    """Show signed errors float64[h, w]: blue at -scale, white at 0, red at +scale."""
    axes.imshow(error, cmap="seismic", vmin=-scale, vmax=scale, interpolation="nearest")


def beside(renderings: Mapping[str, samplekit.Rendering], title: str, line: str, enlarged: int = 1) -> Figure:
    """Show images above their errors, on one scale, and the reference at the end."""
    first, *_ = renderings.values()
    scale = 3.0 * first.metrics["mse"] ** 0.5
    size = enlarged * first.image.shape[1]
    below = f"Below: the errors, blue -{scale:.2g}, white 0, red {scale:.2g}."
    figure, axes = pixel_grid(2, len(renderings) + 1, size, title, line, below, notes=0, room=2 * LINE)
    for (name, rendering), (above, under) in zip(renderings.items(), axes.T, strict=False):
        mse = rendering.metrics["mse"]
        ratio = "" if rendering is first else f"{mse / first.metrics['mse']:.3f} of {next(iter(renderings))}'s"
        show_image(above, rendering.image)
        label(above, name)
        show_error(under, rendering.error, scale)
        label(under, "", f"mse {mse:.3g}", ratio)
    show_image(axes[0, -1], first.reference)
    label(axes[0, -1], "reference")
    return figure


def every_sampler(spp: int) -> Figure:
    """Show the zone plate under every sampler, at ``spp`` samples a pixel or the nearest count below."""
    words = "1 sample" if spp == 1 else f"{spp} samples"
    lines = (
        f"{words} a pixel, 144 x 144 pixels. The exact image has faint rings around other centres than the upper left",
        "corner too, since its pixels are that coarse. Stronger ones are aliasing.",
    )
    figure, axes = pixel_grid(4, 6, 144, f"The zone plate under every sampler, {words} a pixel", *lines)
    for name, panel in zip(ZONEPLATE_SAMPLERS, axes.flat, strict=True):
        rule = samplekit.sampler(name).spec.counts
        count = next((count for count in range(spp, 0, -1) if rule.allows(count, 2)), None)
        if count is None:
            panel.set_facecolor("0.93")
            label(panel, name, f"no set of {spp} or fewer")
            continue
        rendering = samplekit.render("zoneplate:k=300", name, count, size=(144, 144))
        show_image(panel, rendering.image)
        label(panel, name, f"mse {rendering.metrics['mse']:.3g}" + (f", {count} a pixel" if count != spp else ""))
    return figure


def plate(name: str) -> Figure:
    """Show the points of a sampler, their expected power spectrum, and the spectrum's radial mean."""
    from samplekit_spectrum import power

    randomized = samplekit.sampler(name).spec.randomized
    spectrum = power(name, COUNT, realizations=REALIZATIONS, max_frequency=MAX_FREQUENCY)
    # Two pixels for each frequency from -64 to 64.
    figure, (panels,) = pixel_grid(1, 3, 2 * (2 * MAX_FREQUENCY + 1), f"{name}, {COUNT} points", gap=40, notes=2)
    points, image, chart = panels
    points.plot(*samplekit.points(name, COUNT)[0].T, "o", color="black", markersize=3, clip_on=False)
    points.set(xlim=(0, 1), ylim=(1, 0))
    points.spines[:].set_visible(True)
    label(points, "points")
    # The power at frequency 0 is N for every set: it would be the only white pixel of many plates.
    shown = spectrum.normalized
    shown[MAX_FREQUENCY, MAX_FREQUENCY] = 0.0
    image.imshow(shown, cmap="gray", vmin=0.0, vmax=2.0, interpolation="nearest")
    sets = f"mean of {REALIZATIONS} sets" if randomized else "one fixed set"
    label(image, f"N times the power, {sets}", f"frequencies to {MAX_FREQUENCY}; white: 2 and more")
    chart.axhline(1.0, color="0.5", linewidth=0.8, linestyle="--")
    chart.plot(spectrum.radial.frequency, COUNT * spectrum.radial.power)
    chart.set(xlim=(0, MAX_FREQUENCY), ylim=(0, 3), xticks=range(0, MAX_FREQUENCY + 1, 16), yticks=range(4))
    chart.spines[:].set_visible(True)
    label(chart, "radial mean; dashed: white noise")
    chart.set_xlabel("frequency")
    return figure
