"""What a randomizer says of itself before its code is imported."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import get_args

from samplekit._specs.declaration import Declaration, is_integer
from samplekit._specs.option import require
from samplekit._specs.promise import Promise


@dataclass(frozen=True)
class RandomizerSpec(Declaration):
    """What a randomizer declares.

    ``keeps`` names the kinds of promise that survive it: ``net``, ``latin``, ``grid``, ``orthogonal-array``,
    ``distance``; ``largest_index`` is that of a point whose digits it can still tell apart.

    Examples
    --------
    >>> from samplekit import RandomizerSpec
    >>> RandomizerSpec("flip", "mine.flip:Flip", "mirror each dimension or not", keeps=("net", "latin")).keeps
    ('net', 'latin')
    """

    keeps: tuple[str, ...] = field(default=(), kw_only=True)
    largest_index: int = field(default=2**64 - 1, kw_only=True)
    unbiased: bool = field(default=True, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        kinds = {promise.keyword for promise in get_args(Promise)}
        require(
            isinstance(self.keeps, tuple) and all(isinstance(kind, str) and kind in kinds for kind in self.keeps),
            f"{self.name}: keeps must be a tuple of {', '.join(sorted(kinds))}",
        )
        require(
            is_integer(self.largest_index) and 0 <= self.largest_index < 2**64,
            f"{self.name}: largest_index must be from 0 to 2^64 - 1",
        )
        require(isinstance(self.unbiased, bool), f"{self.name}: unbiased must be True or False")
