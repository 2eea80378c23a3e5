"""The folder of a study: what may be in it, and whether a study may go there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit._study.store import NAME
from samplekit.files._writing import check_targets, shown

if TYPE_CHECKING:
    from pathlib import Path

CSV, JSON, REPORT, IMAGES, PLOTS = "results.csv", "results.json", "report.html", "images", "plots"
_OURS = {NAME, f"{NAME}-wal", f"{NAME}-shm", f"{NAME}-journal", CSV, JSON, REPORT, IMAGES, PLOTS}
_TEMPORARY = ".samplekit-"


def check_folder(folder: Path, *, resume: bool) -> None:
    """Make the folder of a study if need be, and check that it is its own.

    Raises
    ------
    UsageError
        It cannot be made or written to, somebody else's files are in it, or a study is that is not to be resumed.
    """
    try:
        folder.mkdir(exist_ok=True)
        names = {path.name for path in folder.iterdir()}
    except FileNotFoundError:
        raise UsageError(f"cannot write to {shown(folder)}: {shown(folder.parent)} does not exist") from None
    except OSError as error:
        raise UsageError(f"cannot write to {shown(folder)}: {error.strerror}") from None
    others = sorted(name for name in names if name not in _OURS and not name.startswith(_TEMPORARY))
    if others:
        more = f" and {len(others) - 1} more" if len(others) > 1 else ""
        raise UsageError(f"{shown(folder)} holds {others[0]!r}{more}, which no study made: choose an empty folder")
    if names and not resume:
        raise UsageError(
            f"{shown(folder)} holds a study: --resume goes on with it; for another one choose an empty folder"
        )
    if names and NAME not in names:
        raise UsageError(f"{shown(folder)} holds results without their {NAME}: choose an empty folder")
    check_targets([folder / name for name in (NAME, CSV, JSON)])


def file_name(text: str) -> str:
    """Return a scene or a sampler as a part of a file's name."""
    return text.replace(":", "-").replace("/", "-").replace("\\", "-")
