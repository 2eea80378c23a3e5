"""Files that share a stem: STEM.exr, STEM.png and so on, found from what a user wrote and written all or none."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit.files._writing import Writer, check_targets, reason_of, shown, write_group

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


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
