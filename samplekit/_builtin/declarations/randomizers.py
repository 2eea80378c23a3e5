"""The randomizers that come with samplekit: what each declares, without importing it."""

from __future__ import annotations

from samplekit import RandomizerSpec

_RANDOMIZERS = "samplekit._builtin.randomizers."

RANDOMIZERS = (
    RandomizerSpec(
        "shift",
        _RANDOMIZERS + "shift:Shift",
        "one random toroidal shift of the whole set: homogenisation",
        reference="Cranley, Patterson 1976",
        keeps=("distance",),
    ),
    RandomizerSpec(
        "xor",
        _RANDOMIZERS + "xor:Xor",
        "one random digit added at each place",
        reference="L'Ecuyer, Lemieux 2002",
        keeps=("net",),
        largest_index=2**32 - 1,
    ),
    RandomizerSpec(
        "owen",
        _RANDOMIZERS + "owen:Owen",
        "nested uniform scrambling of the digits (in base 2, of the first 32: all points share the others)",
        reference="Owen 1995; Laine, Karras 2011; Burley 2020",
        keeps=("net",),
        largest_index=2**32 - 1,
    ),
)
