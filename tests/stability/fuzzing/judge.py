"""What must hold of every answer: its status, its words, and every file that it leaves behind."""

from __future__ import annotations

import csv
import json
import re
import xml.etree.ElementTree as ElementTree
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path

STATUSES = {0, 1, 2, 3, 130}


class Answer(NamedTuple):
    """Exit status, standard output, standard error."""

    status: int
    out: str
    err: str


def judge(words: list[str], answer: Answer, before: dict[str, tuple], folder: Path) -> list[str]:
    """All that is wrong with an answer; ``before`` is the tree of the folder before it was asked for."""
    after = tree(folder)
    wrong = [*_words(words, answer), *_files(before, after, folder)]
    if answer.status == 2 and after != before:
        changed = sorted(set(before.items()) ^ set(after.items()))
        wrong.append(f"wrong use, and {changed[0][0]} is new or changed")
    if answer.status in (0, 3) and not wrong:
        wrong += _promised(words, answer, folder)
    return wrong


def tree(folder: Path) -> dict[str, tuple]:
    """What each file under a folder was like."""
    found = {}
    for path in folder.rglob("*"):
        status = path.lstat()
        found[path.relative_to(folder).as_posix()] = (
            ("folder",) if path.is_dir() else (status.st_size, status.st_mtime_ns, status.st_ino)
        )
    return found


def _words(words: list[str], answer: Answer) -> list[str]:
    wrong = [] if answer.status in STATUSES else [f"exit status {answer.status}"]
    signs = ("Traceback (most recent", "internal error", "Warning: ", "Exception ignored")
    wrong += [sign for sign in signs if sign in answer.err + answer.out]
    said = [line for line in answer.err.split("\n") if line.startswith("samplekit: ")]
    helped = not words or "--help" in words or "-h" in words
    if answer.status in (1, 2) and not said and not (answer.status == 2 and "Usage" in answer.out):
        wrong.append(f"status {answer.status} without a line that says why")
    if any(len(line) > 7000 for line in said):
        wrong.append("a line of more than 7000 letters")
    if "--json" in words and not helped and "--version" not in words and answer.status != 130:
        wrong += _json(answer)
    if answer.status == 2 and "--json" not in words and answer.out and "Usage" not in answer.out:
        wrong.append("wrong use, and something on standard output")
    return wrong


def _json(answer: Answer) -> list[str]:
    try:
        report = json.loads(answer.out, parse_constant=_refuse)
    except ValueError as error:
        return [f"--json: {error}: {answer.out[:80]!r}"]
    if not isinstance(report, dict) or not str(report.get("schema", "")).startswith("samplekit."):
        return ["--json: no object with a schema"]
    if answer.status == 0 and report["schema"] == "samplekit.error/1":
        return ["--json: an error with status 0"]
    return []


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")


def _files(before: dict[str, tuple], after: dict[str, tuple], folder: Path) -> list[str]:
    wrong = [f"{name} is gone" for name in before if name not in after]
    for name, state in after.items():
        if state == before.get(name) or state == ("folder",):
            continue
        if ".samplekit-" in name or name.endswith((".tmp", "-journal")):
            wrong.append(f"{name} was left behind")
            continue
        reason = unreadable(folder / name)
        if reason:
            wrong.append(f"{name} cannot be read: {reason}")
    return wrong


def unreadable(path: Path) -> str:
    """Why a file is not whole; empty if it is."""
    try:
        _read(path)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""


def _read(path: Path) -> None:
    ending = path.suffix.lower()
    if ending in (".exr", ".png"):
        from samplekit.files._images.library import oiio

        image = oiio.ImageBuf(str(path))
        for part in range(max(1, image.nsubimages)):
            if not oiio.ImageBuf(str(path), part, 0).read(part, 0, True):
                raise ValueError(f"part {part}")
    elif ending in (".npy", ".dat", ".bin") or path.name.endswith(".plain.csv"):
        from samplekit.files._pointsets.formats import read_points

        read_points(path)
    elif ending == ".csv":
        rows = list(csv.reader(path.read_text("utf-8").splitlines()))
        if len(rows) < 2 or len({len(row) for row in rows}) != 1 or not path.read_bytes().endswith(b"\n"):
            raise ValueError("rows of different lengths")
    elif ending == ".svg":
        ElementTree.parse(path)
    elif ending == ".pdf":
        if not (path.read_bytes().startswith(b"%PDF") and path.read_bytes().rstrip().endswith(b"%%EOF")):
            raise ValueError("it ends before its end")
    elif ending == ".json":
        json.loads(path.read_text("utf-8"), parse_constant=_refuse)
    elif ending == ".html" and not path.read_text("utf-8").rstrip().endswith("</html>"):
        raise ValueError("it ends before its end")


def _promised(words: list[str], answer: Answer, folder: Path) -> list[str]:
    """List what a report names and is not there: files, numbers of points, points of another sampler."""
    if "--json" not in words or not words or "--help" in words or "-h" in words or "--version" in words:
        return []
    report = json.loads(answer.out)
    # In names that are no text, JSON has what Python has.
    wrong = [f"{name} is reported, and not there" for name in report.get("files", []) if not (folder / name).exists()]
    if report["schema"].startswith("samplekit.points"):
        wrong += _points(report, folder)
    if report["schema"].startswith("samplekit.render") and not report["files"]:
        wrong.append("a rendering without files")
    for option, name in (("--spp", "spp"), ("--count", "count"), ("--seed", "seed"), ("--dims", "dims")):
        if option in words[:-1] and name in report and words.count(option) == 1:
            asked = re.fullmatch(r"\s*(\d+)(?:\^(\d+))?\s*", words[words.index(option) + 1])
            if asked is None or int(asked[1]) ** int(asked[2] or 1) != int(report[name]):
                wrong.append(f"{option} {words[words.index(option) + 1]!r} became {report[name]}")
    return wrong


def _points(report: dict, folder: Path) -> list[str]:
    """The points of the report or the file beside those of each realisation alone, the last points first."""
    import samplekit
    from samplekit.files._pointsets.formats import read_points

    shape = (report["realizations"], report["count"], report["dims"])
    if report["files"]:
        path = folder / report["files"][0]
        if path.suffix.lower() in (".svg", ".png", ".pdf"):
            return []
        found = read_points(path)
    else:
        found = np.array(report["points"])
    if found.shape != shape:
        return [f"points of shape {found.shape}, not {shape}"]
    if not ((found >= 0.0) & (found < 1.0)).all():
        return ["points outside [0, 1)"]
    if "stranger" in report["sampler"]:
        return []
    source = samplekit.sampler(report["sampler"])
    start = report["count"] // 2 if source.streams else 0
    again = source.points(*shape[1:], realizations=shape[0], seed=report["seed"], start=start)
    return [] if np.array_equal(again, found[:, start:]) else ["points that are others when asked for in parts"]
