"""The declaration of a scene, read before its code is imported."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, get_args

from samplekit._specs.declaration import Declaration
from samplekit._specs.fields import integer, require_fields, tuple_of
from samplekit._specs.option import Option

PIXEL_FILTER = Option("pixel-filter", "box", "mean over the pixel, or its centre alone", choices=("box", "center"))


Purpose = Literal["pixel", "lens", "time", "direction", "further"]
PURPOSES: tuple[Purpose, ...] = get_args(Purpose)


def _is_purpose(pair: object) -> bool:
    return isinstance(pair, tuple) and len(pair) == 2 and pair[0] in PURPOSES and integer(1)(pair[1])


def _is_setting(text: object) -> bool:
    return isinstance(text, str) and "=" in text


@dataclass(frozen=True)
class SceneSpec(Declaration):
    """The declaration of a scene; its first fields are those of :class:`Declaration`.

    Every scene with pixel dimensions also takes the option ``pixel-filter``, which its code never sees.

    Parameters
    ----------
    purposes
        The blocks of dimensions that the scene may need, in their order: a purpose and a number of dimensions each.
        ``further`` dimensions are none of pixel, lens, time and direction, such as the bounces of a path.
    extremes
        Options that take the scene from mild to stiff, one text each (``"sigma=1e-12"``): what ``samplekit stability``
        sweeps.

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
        require_fields(
            self,
            self.name,
            purposes=(
                tuple_of(_is_purpose),
                f"a tuple of pairs: one of {', '.join(PURPOSES)} and a number of dimensions",
            ),
            extremes=(tuple_of(_is_setting), "a tuple of texts such as 'sigma=1e-12'"),
        )
        if any(purpose == "pixel" for purpose, _ in self.purposes) and PIXEL_FILTER not in self.options:
            object.__setattr__(self, "options", (*self.options, PIXEL_FILTER))
            super().__post_init__()
