"""Reading files that may be missing, damaged or of another kind: every message names the file."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._writing import reason_of, shown

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@contextlib.contextmanager
def errors_naming(path: Path) -> Iterator[None]:
    """Begin the message of any error inside of the block with "cannot read" and the path.

    Raises
    ------
    UsageError
        The path is no regular file, or the system does not let it be read.
    SamplekitError
        There is not enough memory.
    """
    try:
        if path.exists() and not path.is_file():  # opening a pipe would wait for its writer
            raise UsageError("it is a folder" if path.is_dir() else "it is not a regular file")
        yield
    except SamplekitError as error:
        raise type(error)(f"cannot read {shown(path)}: {error}") from None
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot read {shown(path)}: {reason_of(error)}") from None
    except MemoryError:
        raise SamplekitError(f"cannot read {shown(path)}: there is not enough memory") from None
