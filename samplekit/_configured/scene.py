"""A scene as a user chose it: name and options, checked against what it declares."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from samplekit._bases.reference import Reference
from samplekit._bases.scene import Scene
from samplekit._configured.configured import Configured, find_choice
from samplekit._errors import UsageError
from samplekit._specs import PIXEL_FILTER, SceneSpec

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from samplekit._registry import Registration

    Array = NDArray[np.float64]

T = TypeVar("T")


class ConfiguredScene(Configured):
    """A scene with its options, as :func:`samplekit.scene` returns it.

    Attributes
    ----------
    needs
        Dimensions that the scene needs with these options, by purpose and in their order.
    blocks, dims
        The same numbers without the purposes, and their sum.
    at_centre
        Every pixel is seen at its centre (``pixel-filter=center``): there are no pixel dimensions.
    finite_variance, finite_kurtosis
        Whether a standard error of estimates, and one of their squared errors, means anything; see :class:`Scene`.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.scene("depth-of-field").needs
    {'pixel': 2, 'lens': 2}
    """

    spec: SceneSpec

    def __init__(self, registration: Registration, options: Mapping[str, object]) -> None:
        super().__init__("scene", registration, options)
        values = dict(self.options)
        self.at_centre = values.pop(PIXEL_FILTER.name, PIXEL_FILTER.default) != PIXEL_FILTER.default
        self._scene: Scene = self._create(values, lambda made: isinstance(made, Scene), "a Scene")
        self.needs = self._ask(
            "tell its dimensions",
            lambda: dict(self._scene.dimensions()),
            _are_needs,
            "a positive number of dimensions for each purpose",
        )
        if self.at_centre:
            self.needs.pop("pixel", None)
        if not self.needs:
            raise UsageError(f"{self.text} leaves no dimension to sample: its value at the centres is all there is")
        self.blocks = tuple(self.needs.values())
        self.dims = sum(self.blocks)
        self.finite_variance = bool(self._scene.finite_variance)
        self.finite_kurtosis = self.finite_variance and bool(self._scene.finite_kurtosis)
        self.value_range: tuple[float, float] | None = self._ask(
            "tell the range of its values",
            lambda: self._scene.value_range,
            _is_range,
            "two numbers, the smaller one first, or None",
        )

    def notes(self) -> list[str]:
        """Return what a user of this scene should know; see :meth:`Scene.notes`."""
        return self._ask("tell its notes", lambda: [str(note) for note in self._scene.notes()])

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Sum the integrand over the samples of each pixel; see :meth:`Scene.sums`."""
        tile, boxes = self._placed(tile, boxes)
        self._boundary.fill("cannot be evaluated", out, lambda: self._scene.sums(tile, boxes, out))

    def values(self, tile: Array, boxes: Array) -> Array:
        """Evaluate the integrand at each sample, float64[P, n]; see :meth:`Scene.values`."""
        tile, boxes = self._placed(tile, boxes)
        return self._ask("be evaluated", lambda: self._scene.values(tile, boxes))

    def parts(self, tile: Array, boxes: Array) -> Sequence[Array]:
        """Return the terms whose exact sum is the value at each sample; see :meth:`Scene.parts`."""
        tile, boxes = self._placed(tile, boxes)
        return self._ask("be evaluated", lambda: self._scene.parts(tile, boxes))

    def _placed(self, tile: Array, boxes: Array) -> tuple[Array, Array]:
        """Return samples and boxes for the scene: at the centres, tiles get pixel dimensions and boxes are points."""
        if not self.at_centre:
            return tile, boxes
        whole = np.zeros((tile.shape[0], tile.shape[1] + 2, tile.shape[2]))
        whole[:, 2:] = tile
        points = np.zeros_like(boxes)
        points[0::2] = boxes[0::2] + 0.5 * boxes[1::2]
        return whole, points

    def reference(self, x_edges: Array, y_edges: Array) -> Reference:
        """Return the mean over each pixel, or the value at its centre, and how exact it is.

        Parameters
        ----------
        x_edges, y_edges
            float64[w + 1] and float64[h + 1]: the edges of the pixels.

        Raises
        ------
        PluginError
            The plugin failed, or gave an image of another shape.
        """
        if self.at_centre:
            return self.reference_at(_centres(x_edges), _centres(y_edges))
        exact = self._exact(x_edges, y_edges)
        if exact is not None:
            return Reference(exact, self._scene.reference_error)
        from samplekit.quadrature._numerical import numerical_means

        known = self.constant(x_edges, y_edges)
        return self._ask("give its reference", lambda: numerical_means(self._scene, x_edges, y_edges, known))

    def reference_at(self, x: Array, y: Array) -> Reference:
        """Return the mean over all dimensions but the pixel's at the points x float64[w] by y float64[h]."""
        exact = self._exact_at(x, y)
        if exact is not None:
            return Reference(exact)
        from samplekit.quadrature._numerical import numerical_means_at

        return self._ask("give its reference", lambda: numerical_means_at(self._scene, x, y))

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel, float64[h, w], as exact as there is; see :meth:`reference`."""
        return self.reference(x_edges, y_edges).image

    def check_reference(self, x_edges: Array, y_edges: Array) -> None:
        """Raise if the scene's own reference fails in these pixels; one by quadrature is not tried."""
        if self.at_centre:
            self._exact_at(_centres(x_edges), _centres(y_edges))
        else:
            self._exact(x_edges, y_edges)

    def _exact(self, x_edges: Array, y_edges: Array) -> Array | None:
        exact = self._ask("give its reference", lambda: self._scene.exact(x_edges, y_edges))
        shape = y_edges.size - 1, x_edges.size - 1
        return None if exact is None else self._image("give its reference", lambda: exact, shape)

    def _exact_at(self, x: Array, y: Array) -> Array | None:
        exact = self._ask("give its reference", lambda: self._scene.exact_at(x, y))
        return None if exact is None else self._image("give its reference", lambda: exact, (y.size, x.size))

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the value of each pixel that is provably constant, NaN elsewhere; see :meth:`Scene.constant`."""
        shape = y_edges.size - 1, x_edges.size - 1
        return self._image("tell constant pixels", lambda: self._scene.constant(x_edges, y_edges), shape)

    def _image(self, what: str, call: Callable[[], Array], shape: tuple[int, int]) -> Array:
        return self._ask(
            what,
            lambda: np.asarray(call(), np.float64),
            lambda image: image.shape == shape,
            f"an array of shape {shape}",
        )

    def _ask(
        self, what: str, call: Callable[[], T], valid: Callable[[T], bool] = lambda _: True, expected: str = ""
    ) -> T:
        # Values that are not finite are counted and reported; a warning for each would drown that.
        with np.errstate(all="ignore"):
            return self._boundary.call(f"cannot {what}", call, valid, expected)


def _is_range(bounds: tuple[float, float] | None) -> bool:
    return bounds is None or (isinstance(bounds, tuple) and len(bounds) == 2 and bounds[0] <= bounds[1])


def _are_needs(needs: dict[str, int]) -> bool:
    return bool(needs) and all(
        isinstance(purpose, str) and isinstance(number, int) and not isinstance(number, bool) and number >= 1
        for purpose, number in needs.items()
    )


def _centres(edges: Array) -> Array:
    centres: Array = edges[:-1] + 0.5 * np.diff(edges)
    return centres


def scene(choice: str | SceneSpec | ConfiguredScene, **options: object) -> ConfiguredScene:
    """Return a scene that is ready to be integrated.

    Parameters
    ----------
    choice
        ``NAME[:option=value,...]``; or the declaration of a scene that is not installed; or what this function returned
        before, which is returned as it is.
    options
        Options by keyword: a dash in the name of an option is an underscore here.

    Raises
    ------
    UsageError
        An unknown name or option, or a value that an option does not take.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.scene("depth-of-field:aperture=0").dims
    2
    """
    if isinstance(choice, ConfiguredScene) and not options:
        return choice
    registration, given, _ = find_choice("scene", choice, options)
    return ConfiguredScene(registration, given)
