"""Make dataclasses again from the plain data that ``dataclasses.asdict`` made of them and JSON kept."""

from __future__ import annotations

import types
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

T = TypeVar("T")


def from_plain(kind: type[T], plain: Any) -> T:
    """Make an instance of a dataclass.

    Parameters
    ----------
    kind
        The dataclass; its fields are dataclasses, lists, dicts, tuples, numbers, text or None.
    plain
        A dict of the values of its fields.

    Raises
    ------
    KeyError, TypeError, ValueError
        A field without a default is missing, a field is unknown, or a value has another type.
    """
    hints = get_type_hints(kind)
    items = {item.name: item for item in fields(kind)}  # type: ignore[arg-type]
    unknown = set(plain) - set(items)
    if unknown:
        raise KeyError(", ".join(sorted(unknown)))
    given = [name for name, item in items.items() if name in plain or item.default_factory is MISSING]
    return kind(**{name: _value(hints[name], plain[name]) for name in given})


def _value(kind: Any, plain: Any) -> Any:
    """Return the value of a field that is annotated as ``kind``."""
    origin, arguments = get_origin(kind), get_args(kind)
    if origin is types.UnionType:
        if plain is None and type(None) in arguments:
            return None
        (kind,) = (argument for argument in arguments if argument is not type(None))
        return _value(kind, plain)
    if origin is list:
        return [_value(arguments[0], item) for item in plain]
    if origin is tuple:
        return tuple(_value(argument, item) for argument, item in zip(arguments, plain, strict=True))
    if origin is dict:
        return {arguments[0](key): _value(arguments[1], item) for key, item in plain.items()}
    if is_dataclass(kind):
        return from_plain(kind, plain)  # type: ignore[arg-type]
    if kind is float and isinstance(plain, int) and not isinstance(plain, bool):
        return float(plain)
    if not isinstance(plain, kind) or (kind is not bool and isinstance(plain, bool)):
        raise TypeError(f"{plain!r} is not of type {kind.__name__}")
    return plain
