"""Check that the memory for a request is free. Some systems promise more than they have and then end the process."""

from __future__ import annotations

_UNQUESTIONED_BYTES = 2**28


def check_memory(needed: int, what: str, advice: str = "") -> None:
    """Check that so many bytes are free; small requests are not checked.

    Parameters
    ----------
    needed
        Number of bytes.
    what
        What needs them, in the plural, for the message.
    advice
        The end of the message: what would help, with the punctuation before it.

    Raises
    ------
    UsageError
        Fewer bytes are free.
    """
    if needed <= _UNQUESTIONED_BYTES:
        return
    import psutil

    from samplekit._errors import UsageError

    free = psutil.virtual_memory().available
    if needed > free:
        gib = 2**30
        raise UsageError(f"{what} need {needed / gib:.3g} GiB of memory, and {free / gib:.3g} GiB are free{advice}")
