"""The folder of a study: the names of its files, and the check whether a study may write there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._errors import UsageError
from samplekit._study.store import NAME
from samplekit.files import check_targets, shown

if TYPE_CHECKING:
    from pathlib import Path

CSV, JSON, REPORT, IMAGES, PLOTS = "results.csv", "results.json", "report.html", "images", "plots"
_OURS = {NAME, f"{NAME}-wal", f"{NAME}-shm", f"{NAME}-journal", CSV, JSON, REPORT, IMAGES, PLOTS}
_TEMPORARY = ".samplekit-"


def check_folder(folder: Path, *, resume: bool) -> None:
    """Create the folder of a study if it does not exist, and check that it holds nothing else.

    Raises
    ------
    UsageError
        The folder cannot be created or written to, it holds files that no study made, or it holds a study that is not
        to be resumed.
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
            f"{shown(folder)} holds a study: --resume continues it; for another study, choose an empty folder"
        )
    if names and NAME not in names:
        raise UsageError(f"{shown(folder)} holds results without their {NAME}: choose an empty folder")
    check_targets([folder / name for name in (NAME, CSV, JSON)])


def file_name(text: str) -> str:
    """Return a scene or a sampler as a part of a file's name."""
    return text.replace(":", "-").replace("/", "-").replace("\\", "-")
