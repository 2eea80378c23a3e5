"""Arrays that take long to make, kept across runs in the user's cache folder.

A file is a NumPy ``.npy`` file followed by a SHA-256 digest over its key and all that stands before: one that was cut
short, changed, or made for something else is made anew. It is written beside its place, flushed and renamed, so that
neither a kill nor a second process at the same work leaves half a file. Where nothing can be written nothing is kept,
and nothing fails.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import platformdirs

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

VARIABLE = "SAMPLEKIT_CACHE"


def cache_folder() -> Path | None:
    """The folder for what is kept across runs, made if need be; None if there can be none.

    The environment variable SAMPLEKIT_CACHE names another folder; empty, it turns keeping off.
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
    """The array that ``make`` gives, from the cache if it is there.

    Parameters
    ----------
    name
        Beginning of the file's name: letters, digits and dashes.
    key
        All that the array depends on, a version of the code that makes it included.
    make
        Makes the array.
    valid
        Whether a loaded array is what ``make`` would give, as far as one can see: shape, type, range.
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
    digest = hashlib.sha256(key.encode())
    digest.update(content)
    return digest.digest()


def _load(path: Path, key: str) -> NDArray[Any] | None:
    try:
        data = path.read_bytes()
        size = hashlib.sha256().digest_size
        content, digest = data[:-size], data[-size:]
        if digest != _digest(key, content):
            return None
        return np.asarray(np.load(io.BytesIO(content), allow_pickle=False))
    except (OSError, ValueError, EOFError):
        return None


def _save(path: Path, key: str, array: NDArray[Any]) -> None:
    buffer = io.BytesIO()
    np.save(buffer, array, allow_pickle=False)
    content = buffer.getvalue()
    # What cannot be written (a full disk, a folder that is read-only) is not kept.
    with contextlib.suppress(OSError):
        descriptor, written = tempfile.mkstemp(suffix=".tmp", prefix=path.stem, dir=path.parent)
        try:
            with os.fdopen(descriptor, "wb") as file:
                file.write(content)
                file.write(_digest(key, content))
                file.flush()
                os.fsync(file.fileno())
            Path(written).replace(path)
        finally:
            Path(written).unlink(missing_ok=True)
