"""Whether there is the memory for a request: asked before a system that promises more than it has ends the process."""

from __future__ import annotations

_UNQUESTIONED_BYTES = 2**28


def check_memory(needed: int, what: str, advice: str = "") -> None:
    """Raise unless ``needed`` bytes are free; small requests are not questioned.

    Parameters
    ----------
    needed
        Bytes.
    what
        What takes them, in the plural, for the message.
    advice
        What would help, from its first punctuation mark on.

    Raises
    ------
    UsageError
        They are not.
    """
    if needed <= _UNQUESTIONED_BYTES:
        return
    import psutil

    from samplekit._errors import UsageError

    free = psutil.virtual_memory().available
    if needed > free:
        gib = 2**30
        raise UsageError(f"{what} need {needed / gib:.3g} GiB of memory, and {free / gib:.3g} GiB are free{advice}")
