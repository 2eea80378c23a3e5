"""What a scene says of itself before its code is imported."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

from samplekit._specs.declaration import Declaration, is_integer
from samplekit._specs.option import Option, require

PIXEL_FILTER = Option("pixel-filter", "box", "mean over the pixel, or its centre alone", choices=("box", "center"))


Purpose = Literal["pixel", "lens", "time", "direction", "further"]
PURPOSES: tuple[Purpose, ...] = get_args(Purpose)


def _is_purpose(pair: object) -> bool:
    """Whether it is a purpose and a number of dimensions."""
    return isinstance(pair, tuple) and len(pair) == 2 and pair[0] in PURPOSES and is_integer(pair[1]) and pair[1] >= 1


@dataclass(frozen=True)
class SceneSpec(Declaration):
    """What a scene declares: ``purposes`` are the blocks of dimensions that it may need, in their order.

    ``further`` are dimensions that are none of pixel, lens, time and direction, such as the bounces of a path.
    ``extremes`` are options that take the scene from mild to stiff, one text each (``"sigma=1e-12"``): what
    ``samplekit stability`` sweeps.

    Every scene with pixel dimensions also takes the option ``pixel-filter``, which it never sees itself.

    Examples
    --------
    >>> from samplekit import Option, SceneSpec
    >>> spec = SceneSpec("lamp", "lamp.scene:Lamp", "light of a lamp", options=(Option("height", 0.3, "of the lamp"),))
    >>> dict(spec.purposes)
    {'pixel': 2}
    """

    purposes: tuple[tuple[Purpose, int], ...] = field(default=(("pixel", 2),), kw_only=True)
    extremes: tuple[str, ...] = field(default=(), kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        require(
            isinstance(self.purposes, tuple) and all(map(_is_purpose, self.purposes)),
            f"{self.name}: purposes must be pairs of {', '.join(PURPOSES)} and a number of dimensions",
        )
        require(
            isinstance(self.extremes, tuple) and all(isinstance(text, str) and "=" in text for text in self.extremes),
            f"{self.name}: extremes must be a tuple of texts such as 'sigma=1e-12'",
        )
        if any(purpose == "pixel" for purpose, _ in self.purposes) and PIXEL_FILTER not in self.options:
            object.__setattr__(self, "options", (*self.options, PIXEL_FILTER))
            super().__post_init__()
