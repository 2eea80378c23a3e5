"""Numbers as people read them: the filters of the page's template."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import quote

if TYPE_CHECKING:
    from collections.abc import Callable

MINUS = "−"
NOTHING = "–"
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_UNITS = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def number(value: float | None, digits: int = 3) -> str:
    """A number to some digits, with a power of ten where it is far from 1; a dash for None."""
    if value is None:
        return NOTHING
    if value == 0.0:
        return "0"
    mantissa, _, exponent = f"{abs(value):.{digits - 1}e}".partition("e")
    power = int(exponent)
    if -3 <= power < 5:
        text = f"{float(f'{mantissa}e{exponent}'):.{max(0, digits - 1 - power)}f}"
    else:
        text = f"{mantissa}·10{str(power).translate(_SUPERSCRIPTS)}"
    return MINUS + text if value < 0 else text


def seconds(value: float | None, digits: int = 3) -> str:
    """A time in the largest unit that makes it 1 or more."""
    if value is None:
        return NOTHING
    if value <= 0.0:
        return "0 s" if value == 0.0 else MINUS + seconds(-value, digits)
    size, name = next((unit for unit in _UNITS if value >= 0.9995 * unit[0]), _UNITS[-1])
    return f"{number(value / size, digits)} {name}"


def exponent(value: float) -> str:
    """A measured exponent, to three decimals."""
    return f"{value:.3f}".replace("-", MINUS)


def short(value: float) -> str:
    """An exponent of the theory: as it is."""
    return f"{value:.4g}".replace("-", MINUS)


def grouped(value: int) -> str:
    """A whole number in groups of three digits."""
    return f"{value:,}".replace(",", "\u202f")


def counted(value: int, noun: str) -> str:
    """How many of what."""
    return f"{grouped(value)} {noun}" + ("" if value == 1 else "s")


def plain(value: float | None) -> str:
    """The number for the scripts: all of its digits, nothing for None."""
    return "" if value is None else repr(value)


FILTERS: dict[str, Callable[..., str]] = {
    "number": number,
    "seconds": seconds,
    "exponent": exponent,
    "short": short,
    "grouped": grouped,
    "counted": counted,
    "plain": plain,
    "address": quote,
}
"""What the template may write after ``|``."""
