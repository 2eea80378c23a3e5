"""Writing files, alone or several with the same stem, whole or not at all.

Every file is written beside its target under another name, verified by its writer, and takes the target's name only
then. A full disk, a wrong path, an interrupt or a kill leaves the old file or none, never half of a new one.
"""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import secrets
import shutil
import stat
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from samplekit._errors import SamplekitError, UsageError

Writer = Callable[[Path], None]
"""Writes a file under the name it is given, reads it back, and raises `SamplekitError` if that is not the same."""

_FULL = 64 * 1024
"""Free bytes below which a full disk is taken as the cause of a failure: image libraries do not state the cause."""


def write_group(items: Sequence[tuple[Path, Writer]]) -> None:
    """Write several files: all of them exist and are verified before the first takes its name.

    Symbolic links are followed. The files get the permissions of any new file. If a rename fails half way through the
    group, the message says which of the files are new.

    Parameters
    ----------
    items
        The path of each file and its writer, called once with a temporary path in the same folder and with the same
        ending.

    Raises
    ------
    UsageError
        A path cannot be written to: its folder does not exist, it is a folder, a device or write-protected, or it is
        given twice.
    SamplekitError
        The writing failed; every path holds what it held before.
    """
    paths = [path for path, _ in items]
    targets = check_targets(paths)
    # Names of a length of their own: a target's may already be as long as the file system allows.
    temporaries = [target.with_name(f".samplekit-{secrets.token_hex(8)}{target.suffix[:16]}") for target in targets]
    try:
        for temporary, (path, writer) in zip(temporaries, items, strict=True):
            _write(temporary, path, writer)
        _rename(temporaries, targets, paths)
    finally:
        for temporary in temporaries:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)


def check_targets(paths: Sequence[Path]) -> list[Path]:
    """Find the files behind the paths, symbolic links followed, and check that they can be written. Writes nothing.

    Raises
    ------
    UsageError
        A path cannot be written to, as in `write_group`.
    """
    targets = [_target(path) for path in paths]
    for index, target in enumerate(targets):
        if target in targets[:index]:
            raise UsageError(f"cannot write {shown(paths[index])} twice in one go")
    return targets


def check_stem(output: str, name: str, endings: Sequence[str]) -> Path:
    """Find the stem of a group of files, and check that they can be written before any work is done.

    Parameters
    ----------
    output
        A folder, ``STEM.exr``, or nothing for the current folder.
    name
        Last part of the stem in a folder. Colons and slashes, as in ``halton+owen:base=2``, become hyphens.
    endings
        The endings of the files, for example ``(".exr", ".error.png")``.

    Returns
    -------
    Path
        The path without an ending, to pass to `write_stem`.

    Raises
    ------
    UsageError
        ``output`` is neither a folder nor ``STEM.exr``, or the files cannot be written there.
    """
    path = Path(output)
    try:
        is_folder = path.is_dir()
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write to {shown(path)}: {reason_of(error)}") from None
    if is_folder:
        stem = path / name.replace(":", "-").replace("/", "-")
    elif path.suffix == ".exr" and not output.endswith(("/", "\\")):
        stem = path.with_suffix("")
    else:
        raise UsageError(f"cannot write to {shown(path)}: it is neither a folder that exists nor ends in .exr")
    check_targets([_named(stem, ending) for ending in endings])
    return stem


def write_stem(stem: Path, writers: Mapping[str, Writer]) -> list[Path]:
    """Write the files of one stem, all or none.

    Parameters
    ----------
    stem
        The path without an ending: ``out/disk`` gives ``out/disk.exr`` and ``out/disk.png``.
    writers
        The writer of each file, by its ending.

    Returns
    -------
    list of Path
        The files, in the order of ``writers``.

    Raises
    ------
    UsageError, SamplekitError
        As `write_group` raises them.
    """
    paths = [_named(stem, ending) for ending in writers]
    write_group(list(zip(paths, writers.values(), strict=True)))
    return paths


def _named(stem: Path, ending: str) -> Path:
    # Not with_suffix: a stem may have a dot of its own, as in "zoneplate-k0.5".
    return stem.parent / (stem.name + ending)


def shown(path: Path) -> str:
    """Return the path as it appears in a message: always on one line, and printable."""
    text = str(path)
    return text if text.isprintable() else repr(text)


def reason_of(error: Exception) -> str:
    """Return why something failed, on one line: the system's words where it was the system."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return " ".join(text.split())


def _target(path: Path) -> Path:
    """Find the file behind the path, and check it before any work is done."""
    try:
        target = Path(os.path.realpath(path))
        obstacle = _obstacle(target, shown(path.parent))
    except (OSError, ValueError) as error:
        obstacle = reason_of(error)
    if obstacle:
        raise UsageError(f"cannot write {shown(path)}: {obstacle}")
    return target


def _obstacle(target: Path, folder: str) -> str:
    """Say why the file cannot be written; ``folder`` is its folder as the user named it. Empty: it can."""
    if not target.parent.is_dir():
        return f"{folder} {'is not a folder' if target.parent.exists() else 'does not exist'}"
    if not os.access(target.parent, os.W_OK):
        return f"the folder {folder} is write-protected"
    try:
        mode = target.stat().st_mode
    except FileNotFoundError:
        return ""
    if stat.S_ISDIR(mode):
        return "it is a folder"
    if not stat.S_ISREG(mode):
        # Renaming onto a device would replace the device.
        return "it is not a regular file"
    # Renaming needs the folder's permission only, and would replace a file that is write-protected.
    return "" if os.access(target, os.W_OK) else "it is write-protected"


def _write(temporary: Path, path: Path, writer: Writer) -> None:
    try:
        # Created here, with the mode that the user's umask leaves; the libraries then write into it.
        temporary.touch(exist_ok=False)
        writer(temporary)
        _flush(temporary)
    except (OSError, SamplekitError) as error:
        reason = reason_of(error).replace(str(temporary), path.name)
        if isinstance(error, SamplekitError) and _is_full(temporary.parent):
            reason = f"no space left on the disk ({reason})"
        raise SamplekitError(f"cannot write {shown(path)}: {reason}") from None


def _flush(temporary: Path) -> None:
    """Make the system put the file on the disk: some systems report a full disk only then."""
    with temporary.open("r+b") as file:
        try:
            os.fsync(file.fileno())
        except OSError as error:
            if error.errno not in (errno.EINVAL, errno.ENOTSUP):  # file systems without fsync
                raise


def _rename(temporaries: Sequence[Path], targets: Sequence[Path], paths: Sequence[Path]) -> None:
    for index, (temporary, target) in enumerate(zip(temporaries, targets, strict=True)):
        try:
            temporary.replace(target)
        except OSError as error:
            new = "; new already: " + ", ".join(shown(path) for path in paths[:index]) if index else ""
            raise SamplekitError(f"cannot write {shown(paths[index])}: {reason_of(error)}{new}") from None


def _is_full(folder: Path) -> bool:
    try:
        return shutil.disk_usage(folder).free < _FULL
    except OSError:
        return False


def text_writer(pieces: Iterable[str]) -> Writer:
    """Make a writer of text as UTF-8, with the same line ends on every system; it takes the pieces one at a time."""
    return data_writer(piece.encode() for piece in pieces)


def data_writer(pieces: Iterable[bytes | memoryview]) -> Writer:
    """Make a writer of bytes; it takes the pieces one at a time."""

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
