"""Write numbers for readers: the filters of the page's template."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import quote

from samplekit._study.sentences import in_unit

if TYPE_CHECKING:
    from collections.abc import Callable

MINUS = "−"
NOTHING = "–"
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float | None, digits: int = 3) -> str:
    """Return a number with ``digits`` significant digits, with a power of ten if far from 1; a dash for None."""
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
    """Return a time in the largest unit in which it is at least 1; a dash for None."""
    if value is None:
        return NOTHING
    if value <= 0.0:
        return "0 s" if value == 0.0 else MINUS + seconds(-value, digits)
    value, unit = in_unit(value)
    return f"{number(value, digits)} {unit}"


def exponent(value: float) -> str:
    """Return a measured exponent with three decimals."""
    return f"{value:.3f}".replace("-", MINUS)


def short(value: float) -> str:
    """Return an exponent of the theory, which has few digits."""
    return f"{value:.4g}".replace("-", MINUS)


def grouped(value: int) -> str:
    """Return a whole number in groups of three digits."""
    return f"{value:,}".replace(",", "\u202f")


def counted(value: int, noun: str) -> str:
    """Return a number and its noun, in the plural unless the number is 1."""
    return f"{grouped(value)} {noun}" + ("" if value == 1 else "s")


def plain(value: float | None) -> str:
    """Return a number with all of its digits, for the scripts; empty for None."""
    return "" if value is None else repr(value)


_FUNCTIONS: tuple[Callable[..., str], ...] = (number, seconds, exponent, short, grouped, counted, plain)
FILTERS = {each.__name__: each for each in _FUNCTIONS} | {"address": quote}
"""The filters of the template, by the names that it writes after ``|``."""
