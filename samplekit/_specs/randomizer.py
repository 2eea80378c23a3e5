"""The declaration of a randomizer, read before its code is imported."""

from __future__ import annotations

from dataclasses import dataclass, field

from samplekit._specs.declaration import Declaration
from samplekit._specs.fields import instance_of, integer, require_fields, tuple_of
from samplekit._specs.promise import KINDS


@dataclass(frozen=True)
class RandomizerSpec(Declaration):
    """The declaration of a randomizer; its first fields are those of :class:`Declaration`.

    Parameters
    ----------
    keeps
        The kinds of promise that survive it: ``net``, ``latin``, ``grid``, ``orthogonal-array``, ``distance``.
    largest_index
        Largest index of a point that it can randomize: the digits of larger ones would be cut off.
    unbiased
        Whether the mean of estimates over realisations is the integral.

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
        require_fields(
            self,
            self.name,
            keeps=(tuple_of(lambda kind: kind in KINDS), f"a tuple of {', '.join(KINDS)}"),
            largest_index=(integer(0, 2**64 - 1), "an integer from 0 to 2^64 - 1"),
            unbiased=(instance_of(bool), "True or False"),
        )
