"""Arrays that take long to make, kept across runs in the user's cache folder.

A file is a NumPy ``.npy`` file followed by a SHA-256 digest of its key and its content: one that was cut short,
changed, or made for another key is made anew. It is written whole or not at all, so that neither a kill nor a second
process with the same work leaves half a file. Where no file can be written, no array is kept, and nothing fails.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import platformdirs

from samplekit._errors import SamplekitError
from samplekit.files._writing import data_writer, write_group

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

VARIABLE = "SAMPLEKIT_CACHE"
_DIGEST_SIZE = hashlib.sha256().digest_size


def cache_folder() -> Path | None:
    """Return the folder of the cache, made if need be; None if there can be none.

    The environment variable SAMPLEKIT_CACHE names another folder; if it is empty, nothing is kept.
    """
    chosen = os.environ.get(VARIABLE)
    if chosen == "":
        return None
    try:
        folder = Path(chosen) if chosen else platformdirs.user_cache_path("samplekit", appauthor=False)
        if not chosen and not folder.is_absolute():
            # A user without a home: it would be a folder called "~" where the process happens to run.
            return None
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        # Newer versions of platformdirs raise where there is no home.
        return None
    return folder


def cached_array(
    name: str,
    key: str,
    make: Callable[[], NDArray[Any]],
    valid: Callable[[NDArray[Any]], bool] = lambda _: True,
) -> NDArray[Any]:
    """Return the array that ``make`` returns, from the cache if it is there.

    Parameters
    ----------
    name
        Beginning of the file's name: letters, digits and dashes.
    key
        Everything that the array depends on, including a version of the code that makes it.
    make
        Makes the array.
    valid
        Whether a loaded array may be what ``make`` returns: checks its shape, type and range.
    """
    folder = cache_folder()
    if folder is None:
        return make()
    path = folder / f"{name}-{hashlib.sha256(key.encode()).hexdigest()[:16]}.npy"
    kept = _load(path, key)
    if kept is not None and valid(kept):
        return kept
    made = make()
    _save(path, key, made)
    return made


def _digest(key: str, content: bytes) -> bytes:
    return hashlib.sha256(key.encode() + content).digest()


def _load(path: Path, key: str) -> NDArray[Any] | None:
    try:
        data = path.read_bytes()
        content, digest = data[:-_DIGEST_SIZE], data[-_DIGEST_SIZE:]
        if digest != _digest(key, content):
            return None
        return np.asarray(np.load(io.BytesIO(content), allow_pickle=False))
    except (OSError, ValueError, EOFError):
        return None


def _save(path: Path, key: str, array: NDArray[Any]) -> None:
    buffer = io.BytesIO()
    np.save(buffer, array, allow_pickle=False)
    content = buffer.getvalue()
    # An array that cannot be written (the disk is full, or the folder is read-only) is not kept.
    with contextlib.suppress(SamplekitError):
        write_group([(path, data_writer([content, _digest(key, content)]))])
