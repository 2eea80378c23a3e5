"""A randomizer as a user chose it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._configured.configured import Configured
from samplekit._registry import registry

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from samplekit._bases.randomizer import Randomizer
    from samplekit._bases.realizations import Realizations
    from samplekit._registry import Registration
    from samplekit._specs import RandomizerSpec


class ConfiguredRandomizer(Configured):
    """A randomizer, as :func:`samplekit.randomizer` returns it; its faults name its plugin.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.randomizer("owen").spec.keeps
    ('net',)
    """

    spec: RandomizerSpec

    def __init__(self, registration: Registration) -> None:
        super().__init__("randomizer", registration, {})
        self._randomizer: Randomizer = self._create(
            self.options, lambda made: hasattr(made, "apply"), "something with apply"
        )

    def apply(self, points: NDArray[np.float64], realizations: Realizations, bases: tuple[int, ...] = ()) -> None:
        """Randomise ``points`` float64[R, D, n] in place; see :meth:`Randomizer.apply`.

        Raises
        ------
        PluginError
            The plugin failed, or wrote values outside [0, 1).
        """
        self._boundary.call("failed", lambda: self._randomizer.apply(points, realizations, bases))
        self._boundary.check_points(points)


def randomizer(name: str) -> ConfiguredRandomizer:
    """Return the randomizer called ``name``, such as ``"owen"`` or ``"shift"``.

    Raises
    ------
    UnknownNameError
        No randomizer has the name.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.randomizer("shift").text
    'shift'
    """
    return ConfiguredRandomizer(registry().find("randomizer", name))
