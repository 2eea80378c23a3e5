"""Renderings: the image, the exact reference and the signed error, side by side or one of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from samplekit._errors import UsageError
from samplekit.files._images import diverging
from samplekit.files._images.falsecolor import rounded_up
from samplekit.files._images.png import RESERVED, encode_srgb
from samplekit.plots._display import Display
from samplekit.plots._style import add_bar, make_axes, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from samplekit._integrate.rendering import Rendering

Part = Literal["image", "reference", "error"]
PARTS: tuple[Part, ...] = ("image", "reference", "error")

_SIDE, _LARGEST_SIDE = 2.2, 5.12
"""Inches: the longer side of a panel has at least the first, rounded to whole pixels, and at most the second."""


class RenderingDisplay(Display):
    """A picture of a rendering.

    Image and reference are shown as ``STEM.png`` has them, encoded as sRGB. The error is blue below zero, white at zero
    and red above. Pixels that are not finite are magenta.

    Parameters
    ----------
    rendering
        What :func:`samplekit.render` returned.
    part
        ``"image"``, ``"reference"`` or ``"error"``; None: all that the rendering has, side by side.
    scale
        The error that has the strongest colour, above 0; None: the largest error rounded up to 1, 2 or 5 times a power
        of ten.

    Attributes
    ----------
    axes_, ax_, figure_
        See :class:`Display`: one axes for each part.

    Raises
    ------
    UsageError
        The part is unknown, the rendering was made without it, or the scale is not above 0.

    Examples
    --------
    >>> import samplekit
    >>> rendering = samplekit.render("disk", "jittered", spp=4, size=(16, 16))
    >>> [ax.get_title() for ax in rendering.plot().axes_]
    ['image', 'reference', 'error']
    """

    def __init__(self, rendering: Rendering, part: Part | None = None, scale: float | None = None) -> None:
        if part is not None and part not in PARTS:
            raise UsageError(f"part {part!r}: expected image, reference or error")
        if scale is not None and not 0.0 < scale < np.inf:
            raise UsageError(f"the scale of an error must be finite and above 0, not {scale}")
        wanted = PARTS if part is None else (part,)
        self.parts: dict[str, NDArray[np.float64]] = {
            name: values for name in wanted if (values := getattr(rendering, name)) is not None
        }
        if not self.parts:
            raise UsageError(f"the rendering has no {part}: it was made without its error")
        self.rendering = rendering
        self.scale = scale

    @style()
    def plot(self, ax: Axes | None = None, *, axes: Any = None) -> RenderingDisplay:
        """Draw the parts.

        Parameters
        ----------
        ax
            Where a single part is drawn; None: on a new figure, with a title.
        axes
            Where several parts are drawn: as many axes, in any shape.

        Returns
        -------
        RenderingDisplay
            This display.

        Raises
        ------
        UsageError
            Another number of axes than there are parts.
        """
        self.choose_axes(ax, axes, len(self.parts), self._new_axes)
        x, y, width, height = self.rendering.plan.pixels.window
        for panel, (name, values) in zip(self.axes_, self.parts.items(), strict=True):
            # Each value is a square, unless the axes have fewer pixels than the image.
            interpolation = "nearest" if panel.bbox.width > width - 0.5 else "auto"
            kind: dict[str, Any] = {"extent": (x, x + width, y + height, y), "interpolation": interpolation}
            if name == "error":
                self._draw_error(panel, values, kind)
            else:
                panel.imshow(encode_srgb(values), **kind)
            panel.set(title=name, xticks=[], yticks=[])
        return self

    def _draw_error(self, ax: Axes, values: NDArray[np.float64], kind: dict[str, Any]) -> None:
        from matplotlib.colors import ListedColormap

        largest = float(np.abs(values[np.isfinite(values)]).max(initial=0.0))
        scale = self.scale or rounded_up(largest) or 1.0
        colours = ListedColormap(diverging.table() / 255.0).with_extremes(bad=f"#{bytes(RESERVED).hex()}")
        image = ax.imshow(np.ma.masked_invalid(values), cmap=colours, vmin=-scale, vmax=scale, **kind)
        add_bar(ax, image, "", [-scale, 0.0, scale], extend="both" if largest > scale else "neither")

    def _new_axes(self) -> tuple[Figure, list[Axes]]:
        plan, metrics = self.rendering.plan, self.rendering.metrics
        _, _, width, height = plan.pixels.window
        # A pixel of the image is a square of whole pixels of the file.
        side = max(width, height)
        factor = max(1, round(200 * _SIDE / side)) / 200 if side <= 200 * _LARGEST_SIDE else _LARGEST_SIDE / side
        facts = [f"{width} x {height} pixels, seed {plan.seed}"]
        facts += [f"rmse {metrics['rmse']:.3g}"] if "rmse" in metrics else []
        return make_axes(
            [(0, column) for column in range(len(self.parts))], width * factor, height * factor,
            title=f"{plan.pixels.scene.text}, {plan.sampler.text}, {plan.count} spp", caption=["; ".join(facts)],
            left=0.1, right=0.75 if "error" in self.parts else 0.1, above=0.2, below=0.1, gap=(0.15, 0.0),
        )  # fmt: skip
