"""A scene as a user chose it: name and options, checked against what it declares."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from samplekit._errors import UsageError
from samplekit._guard import Guard
from samplekit._parsing import parse_choice
from samplekit._registry import BUILTIN, Offer, registry
from samplekit._specs import PIXEL_FILTER, written

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

    from samplekit._bases.scene import Scene
    from samplekit._integrate.reference import Reference
    from samplekit._specs import SceneSpec


T = TypeVar("T")


class ConfiguredScene:
    """What ``samplekit.scene("zoneplate:k=1024")`` returns.

    Attributes
    ----------
    text
        As it would be written on the command line.
    spec
        The declaration.
    needs
        Dimensions that the scene needs with these options, by purpose and in their order.
    at_centre
        Every pixel is seen at its centre (``pixel-filter=center``): there are no pixel dimensions.
    """

    def __init__(self, offer: Offer, options: Mapping[str, object]) -> None:
        spec: SceneSpec = offer.spec
        values = spec.parse_options(options)
        self.text = written(offer.called, options, values)
        self.at_centre = values.pop(PIXEL_FILTER.name, PIXEL_FILTER.default) != PIXEL_FILTER.default
        self.spec = spec
        self.plugin = offer.plugin
        self._trusted = offer.plugin.name == BUILTIN
        self._guard = Guard(f"scene {offer.called}", offer.plugin)
        implementation = spec.load()
        keywords = {name.replace("-", "_"): value for name, value in values.items()}
        self._scene: Scene = self._guarded("be set up", lambda: implementation(**keywords), _is_scene, "a Scene")
        self.needs = self._guarded(
            "tell its dimensions",
            lambda: dict(self._scene.dimensions()),
            _are_needs,
            "a positive number of dimensions for each purpose",
        )
        if self.at_centre:
            self.needs.pop("pixel", None)
        if not self.needs:
            raise UsageError(f"{self.text} leaves no dimension to sample: its value at the centres is all there is")

    def __repr__(self) -> str:
        return f"<scene {self.text}>"

    @cached_property
    def blocks(self) -> tuple[int, ...]:
        """Sizes of the blocks of dimensions, in their order."""
        return tuple(self.needs.values())

    @cached_property
    def dims(self) -> int:
        """Number of dimensions that the scene needs with these options."""
        return sum(self.needs.values())

    @property
    def finite_variance(self) -> bool:
        """Whether a standard error means anything; see :class:`Scene`."""
        return bool(self._scene.finite_variance)

    def notes(self) -> list[str]:
        """What a user of this scene should know; see :meth:`Scene.notes`."""
        return self._guarded("tell its notes", lambda: [str(note) for note in self._scene.notes()])

    def sums(self, tile: NDArray[np.float64], boxes: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Sum the integrand over the samples of each pixel; see :meth:`Scene.sums`."""
        if self.at_centre:
            tile, boxes = _centred(tile, boxes)
        if self._trusted:
            self._scene.sums(tile, boxes, out)
        else:
            # What a plugin does not write must not pass for a result.
            out.fill(np.nan)
            self._guarded("be evaluated", lambda: self._scene.sums(tile, boxes, out))

    def parts(self, tile: NDArray[np.float64], boxes: NDArray[np.float64]) -> Sequence[NDArray[np.float64]]:
        """What a run in extended precision adds up; see :meth:`Scene.parts`."""
        if self.at_centre:
            tile, boxes = _centred(tile, boxes)
        return self._guarded("be evaluated", lambda: self._scene.parts(tile, boxes))

    def exact(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mean over each pixel, as exact as there is; see :meth:`Scene.exact`."""
        return self.reference(x_edges, y_edges).image

    def reference(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> Reference:
        """The mean over each pixel, or at its centre, and how exact it is."""
        from samplekit._bases.scene import Scene
        from samplekit._integrate.reference import Reference

        scene, what = self._scene, "give its reference"
        if self.at_centre:
            x, y = _centres(x_edges), _centres(y_edges)
            if type(scene).exact_at is Scene.exact_at:
                from samplekit._integrate.numerical import numerical_means_at

                return self._guarded(what, lambda: numerical_means_at(scene, x, y))
            return Reference(self._image(what, lambda: scene.exact_at(x, y), x_edges, y_edges))
        if type(scene).exact is Scene.exact:
            from samplekit._integrate.numerical import numerical_means

            return self._guarded(what, lambda: numerical_means(scene, x_edges, y_edges))
        image = self._image(what, lambda: scene.exact(x_edges, y_edges), x_edges, y_edges)
        return Reference(image, scene.reference_error)

    def exact_at(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mean over all dimensions but the pixel's at the points x by y; see :meth:`Scene.exact_at`."""
        return self._guarded("give its reference", lambda: self._scene.exact_at(x, y))

    def check_reference(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> None:
        """Raise if the scene's own reference fails in these pixels; one by quadrature is not tried."""
        from samplekit._bases.scene import Scene

        kind = type(self._scene)
        if kind.exact_at is not Scene.exact_at if self.at_centre else kind.exact is not Scene.exact:
            self.reference(x_edges, y_edges)

    def constant(self, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each pixel that is provably constant, NaN elsewhere; see :meth:`Scene.constant`."""
        return self._image("tell constant pixels", lambda: self._scene.constant(x_edges, y_edges), x_edges, y_edges)

    def _image(
        self,
        what: str,
        call: Callable[[], NDArray[np.float64]],
        x_edges: NDArray[np.float64],
        y_edges: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        shape = y_edges.size - 1, x_edges.size - 1
        return self._guarded(
            what,
            lambda: np.asarray(call(), np.float64),
            lambda image: image.shape == shape,
            f"an array of shape {shape}",
        )

    def _guarded(
        self, what: str, call: Callable[[], T], valid: Callable[[T], bool] = lambda _: True, expected: str = ""
    ) -> T:
        # Values that are not finite are counted and reported; a warning for each would drown that.
        with np.errstate(all="ignore"):
            return self._guard(f"cannot {what}", call, valid, expected)


def _is_scene(made: object) -> bool:
    from samplekit._bases.scene import Scene

    return isinstance(made, Scene)


def _are_needs(needs: dict[str, int]) -> bool:
    return bool(needs) and all(
        isinstance(purpose, str) and isinstance(number, int) and not isinstance(number, bool) and number >= 1
        for purpose, number in needs.items()
    )


def _centres(edges: NDArray[np.float64]) -> NDArray[np.float64]:
    centres: NDArray[np.float64] = edges[:-1] + 0.5 * np.diff(edges)
    return centres


def _centred(tile: NDArray[np.float64], boxes: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The tile with pixel dimensions again, and boxes that are points."""
    whole = np.zeros((tile.shape[0], tile.shape[1] + 2, tile.shape[2]))
    whole[:, 2:] = tile
    points = np.zeros_like(boxes)
    points[0::2] = boxes[0::2] + 0.5 * boxes[1::2]
    return whole, points


def configured_scene(text: str, **options: object) -> ConfiguredScene:
    """The scene written ``NAME[:option=value,...]``; options may also be given by keyword.

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
    choice = parse_choice(text, "scene")
    given: dict[str, object] = {**choice.options, **{name.replace("_", "-"): value for name, value in options.items()}}
    return ConfiguredScene(registry().find("scene", choice.name), given)
