"""Values and errors of third-party code in a message: on one line, short, and safe if their ``repr`` fails."""

from __future__ import annotations

import re

_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
_LONGEST_VALUE = 60
_LONGEST_REASON = 200


def quoted(value: object) -> str:
    """Return the value as Python writes it, shortened to its beginning if that is long."""
    try:
        text = " ".join(repr(value).split())
    except Exception as error:
        text = f"an object of type {type(value).__name__}, whose repr raises {type(error).__name__}"
    return text if len(text) <= _LONGEST_VALUE else f"{text[:_LONGEST_VALUE]}..."


def reason(error: BaseException) -> str:
    """Return the type of an exception, and its text if it has one."""
    try:
        text = " ".join(_COLOUR.sub("", str(error)).split())
    except Exception as second:
        text = f"(its text raises {type(second).__name__})"
    return f"{type(error).__name__}: {text}"[:_LONGEST_REASON] if text else type(error).__name__


def place(error: BaseException) -> str:
    """Return the line of third-party code that raised, as ``" (points.py, line 12)"``; empty if there is none."""
    import traceback
    from pathlib import Path

    ours = Path(__file__).parent
    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        path = Path(frame.filename)
        if path.suffix == ".py" and ours not in path.parents and "numpy" not in path.parts:
            return f" ({path.name}, line {frame.lineno})"
    return ""
