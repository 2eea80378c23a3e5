"""The base class of all displays."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import UsageError
from samplekit.plots._saving import save
from samplekit.plots._style import style

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class Display:
    """A picture of a result, which ``plot`` of the class that derives from it draws.

    Attributes
    ----------
    axes_
        The axes that were drawn on.
    ax_
        The first of them.
    figure_
        Their figure.

    Examples
    --------
    >>> from samplekit.plots import Display, make_axes
    >>> class Line(Display):
    ...     def plot(self, ax=None):
    ...         self.choose_axes(ax, None, 1, lambda: make_axes([(0, 0)], 3.0, 2.0, title="a line"))
    ...         self.ax_.plot([0, 1], [0, 1])
    ...         return self
    >>> len(Line().plot().figure_.axes)
    1
    """

    axes_: list[Axes]
    ax_: Axes
    figure_: Figure

    def plot(self) -> Display:
        """Draw the display on a new figure."""
        raise NotImplementedError

    def choose_axes(
        self, ax: Axes | None, axes: Any, number: int, make: Callable[[], tuple[Figure, list[Axes]]]
    ) -> None:
        """Set ``axes_``, ``ax_`` and ``figure_`` to what the caller of ``plot`` gave, or to a new figure.

        Parameters
        ----------
        ax, axes
            One axes or several, in any shape; None: not given.
        number
            How many axes the display needs.
        make
            Makes a new figure with as many axes, as :func:`samplekit.plots.make_axes` does.

        Raises
        ------
        UsageError
            The caller gave another number of axes.
        """
        if ax is None and axes is None:
            self.figure_, self.axes_ = make()
        else:
            self.axes_ = list(np.ravel([ax] if axes is None else axes))
            if len(self.axes_) != number:
                needed = "one axes" if number == 1 else f"axes={number} axes"
                raise UsageError(f"this plot needs {needed}, not {len(self.axes_)}")
            self.figure_ = self.axes_[0].figure  # type: ignore[assignment]
        self.ax_ = self.axes_[0]

    def save(self, path: str | os.PathLike[str], metadata: Mapping[str, Any] | None = None) -> None:
        """Write the figure to a ``.png``, ``.svg`` or ``.pdf``, or leave the file as it was.

        The display is drawn first if it is not yet. See :func:`samplekit.plots.save` for parameters and errors.
        """
        save(self._drawn(), path, metadata)

    def _drawn(self) -> Figure:
        return self.figure_ if hasattr(self, "figure_") else self.plot().figure_

    def _repr_png_(self) -> bytes:
        """Show the display in a notebook, at half of the resolution of files."""
        file = io.BytesIO()
        figure = self._drawn()
        with style():
            figure.savefig(file, format="png", dpi=figure.dpi / 2)
        return file.getvalue()
