"""The declaration of a randomizer, read before its code is imported."""

from __future__ import annotations

from dataclasses import dataclass, field

from samplekit._specs.declaration import Declaration
from samplekit._specs.fields import integer, is_flag, require_fields, tuple_of
from samplekit._specs.promise import kinds_of_promises


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
        kinds = kinds_of_promises()
        require_fields(
            self,
            self.name,
            keeps=(tuple_of(lambda kind: kind in kinds), f"a tuple of {', '.join(kinds)}"),
            largest_index=(integer(0, 2**64 - 1), "an integer from 0 to 2^64 - 1"),
            unbiased=(is_flag, "True or False"),
        )
