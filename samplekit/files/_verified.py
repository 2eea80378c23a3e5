"""Write text or bytes and read them back: the writers that `samplekit.files.write_group` takes."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

from samplekit._errors import SamplekitError

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from samplekit.files._writing import Writer


def text_writer(pieces: Iterable[str]) -> Writer:
    """Make a writer of text as UTF-8 with the line ends it has, on every system; the pieces are taken one at a time."""
    return data_writer(piece.encode() for piece in pieces)


def data_writer(pieces: Iterable[bytes]) -> Writer:
    """Make a writer of bytes; the pieces are taken one at a time."""

    def write(temporary: Path) -> None:
        written = hashlib.sha256()
        with temporary.open("wb") as file:
            for piece in pieces:
                written.update(piece)
                file.write(piece)
        with temporary.open("rb") as file:
            stored = hashlib.file_digest(file, "sha256")
        if stored.digest() != written.digest():
            raise SamplekitError("what was read back is not what was written")

    return write
