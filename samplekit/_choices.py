"""The text form of a choice: ``NAME[:option=value,...][+RANDOMIZER]``."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from samplekit._errors import UsageError


@dataclass(frozen=True)
class Choice:
    """A name with the options that were given, as text, and the name behind a plus sign.

    Examples
    --------
    >>> from samplekit import Choice
    >>> Choice("disk", {"radius": "0.2"}).randomizer is None
    True
    """

    name: str
    options: dict[str, str] = field(default_factory=dict)
    randomizer: str | None = None


def parse_choice(text: str, kind: str) -> Choice:
    """Read ``NAME[:option=value,...][+RANDOMIZER]``; only a sampler takes a randomizer.

    Raises
    ------
    UsageError
        The text does not have this form.

    Examples
    --------
    >>> import samplekit
    >>> choice = samplekit.parse_choice("halton:scramble=digits+shift", "sampler")
    >>> choice.name, choice.options, choice.randomizer
    ('halton', {'scramble': 'digits'}, 'shift')
    """
    chosen, *randomizers = re.split(r"\+(?=[A-Za-z])", text) if kind == "sampler" else [text]
    if any("." in randomizer.rpartition("/")[2] for randomizer in randomizers):
        raise UsageError(f"{kind} {text!r}: a plus sign before a letter ends a value: expected +RANDOMIZER behind it")
    if len(randomizers) > 1:
        raise UsageError(f"{kind} {text!r}: one randomizer at most")
    name, colon, rest = chosen.partition(":")
    options: dict[str, str] = {}
    for item in rest.split(",") if colon else []:
        option, equals, value = item.partition("=")
        if not equals or not option.strip() or not value.strip():
            hint = ": a comma ends a value" if options else ""
            raise UsageError(f"{kind} {text!r}: expected NAME:option=value,... but found {item!r}{hint}")
        if option.strip() in options:
            raise UsageError(f"{kind} {text!r}: option {option.strip()!r} is given twice")
        options[option.strip()] = value.strip()
    for chosen_name in (name, *randomizers):
        if not re.fullmatch(r"([A-Za-z0-9_.-]+/)?[A-Za-z0-9_.-]+", chosen_name):
            raise UsageError(f"{kind} {text!r}: expected NAME or NAME:option=value,...")
    return Choice(name, options, randomizers[0] if randomizers else None)
