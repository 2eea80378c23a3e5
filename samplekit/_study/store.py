"""What a study has found so far, in an SQLite file: a transaction for each job, so that a kill loses no finished one.

The file is held exclusively while a study runs. The lock is the operating system's: it goes with its process, however
that ends. SQLite does not notice a bit that flips in a number, so every row has a SHA-256 digest of itself: one that
does not fit ends the study, and no result comes of it.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import sqlite3
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit._study.trials import COLUMNS
from samplekit.files._writing import shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit._study.cells import Cell
    from samplekit._study.jobs import Job

    Array = NDArray[np.float64]

FORMAT = 2
NAME = "study.sqlite"
_TABLES = """
CREATE TABLE study (format INTEGER, request TEXT, versions TEXT, digest BLOB);
CREATE TABLE sums (scene TEXT, sampler TEXT, count INTEGER, first INTEGER, last INTEGER, batches BLOB, digest BLOB,
  PRIMARY KEY (scene, sampler, count, first));
CREATE TABLE laps (machine TEXT, scene TEXT, sampler TEXT, count INTEGER,
  points_cpu REAL, points_wall REAL, scene_cpu REAL, scene_wall REAL, digest BLOB);
CREATE TABLE setups (machine TEXT, scene TEXT, sampler TEXT, count INTEGER, cpu REAL, wall REAL, digest BLOB,
  PRIMARY KEY (machine, scene, sampler, count))
"""


def _digest(row: Sequence[Any]) -> bytes:
    return hashlib.sha256(repr(tuple(row)).encode()).digest()


class Store:
    """The file ``study.sqlite`` in a folder; None: in memory, and gone when closed."""

    def __init__(self, folder: Path | None) -> None:
        self._path = None if folder is None else folder / NAME
        with self._faults():
            self._database = sqlite3.connect(self._path or ":memory:", timeout=0.0, isolation_level=None)
            self._database.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = NORMAL")
            self._database.execute("BEGIN EXCLUSIVE")
            self._database.execute("COMMIT")

    def close(self) -> None:
        """Let go of the file."""
        # What a full disk refuses to tidy up is tidied up when the file is opened again.
        with contextlib.suppress(sqlite3.Error):
            self._database.close()

    def begin(self, request: dict[str, Any], versions: dict[str, str]) -> None:
        """Write down what is asked for, or check that it is what is written down.

        Raises
        ------
        UsageError
            The file is of another version, or of another study.
        """
        with self._faults():
            tables = {name for (name,) in self._database.execute("SELECT name FROM sqlite_master")}
            if not tables:
                with self._transaction():
                    for table in _TABLES.split(";"):
                        self._database.execute(table)
                    self._insert("INSERT INTO study", (FORMAT, json.dumps(request), json.dumps(versions)))
                return
            found = self._database.execute("SELECT format FROM study").fetchone() if "study" in tables else None
            if found is None or found[0] != FORMAT:
                raise UsageError(
                    f"{self._shown} is of version {found[0] if found else 'unknown'}, this samplekit continues version"
                    f" {FORMAT}: finish it with the samplekit that began it, or choose another folder"
                )
            ((_, kept_request, kept_versions),) = self._select("study")
        self._compare(json.loads(kept_request), request, json.loads(kept_versions), versions)

    def _compare(
        self,
        kept: dict[str, Any],
        asked: dict[str, Any],
        kept_versions: dict[str, str],
        versions: dict[str, str],
    ) -> None:
        differing = [name for name in asked if kept.get(name) != asked[name]]
        if differing:
            name = differing[0]
            raise UsageError(
                f"{self._shown} is of another study: {name} {kept.get(name)}, not {asked[name]}:"
                " ask for the same, or choose another folder"
            )
        others = [name for name in kept_versions | versions if kept_versions.get(name) != versions.get(name)]
        if others:
            name = others[0]
            raise UsageError(
                f"{self._shown} was begun with {name} {kept_versions.get(name, '(none)')}, this is"
                f" {versions.get(name, '(none)')}: numbers may differ: install that version, or choose another folder"
            )

    def add(self, job: Job, sums: Array) -> None:
        """Keep what a job gave."""
        with self._faults(), self._transaction():
            for count, batches in zip(job.counts, sums, strict=True):
                row = job.scene, job.sampler, count, job.first, job.last, np.ascontiguousarray(batches).tobytes()
                self._insert("INSERT OR REPLACE INTO sums", row)

    def ranges(self, cell: Cell) -> list[tuple[int, int]]:
        """The trials that a cell has, first to last of each job."""
        return [(first, last) for first, last, _ in self._batches(cell)]

    def sums(self, cell: Cell) -> Array:
        """The batches float64[B, COLUMNS] of a cell, in the order of their trials."""
        blobs = [batches for _, _, batches in self._batches(cell)]
        return np.frombuffer(b"".join(blobs), np.float64).reshape(-1, COLUMNS)

    def _batches(self, cell: Cell) -> list[tuple[int, int, bytes]]:
        where = "sums WHERE scene = ? AND sampler = ? AND count = ? ORDER BY first"
        with self._faults():
            return [row[3:] for row in self._select(where, *cell.pair, cell.count)]

    def add_laps(self, machine: str, laps: Sequence[tuple[Cell, tuple[float, float, float, float]]]) -> None:
        """Keep times of single trials: of points by processor and wall clock, and of the scene."""
        with self._faults(), self._transaction():
            for cell, seconds in laps:
                self._insert("INSERT INTO laps", (machine, *cell.pair, cell.count, *map(float, seconds)))

    def laps(self, machine: str, cell: Cell) -> Array:
        """The times float64[L, 4] of a cell on a machine."""
        where = "laps WHERE machine = ? AND scene = ? AND sampler = ? AND count = ? ORDER BY rowid"
        with self._faults():
            rows = self._select(where, machine, *cell.pair, cell.count)
        return np.array([row[4:] for row in rows], np.float64).reshape(-1, 4)

    def add_setup(self, machine: str, cell: Cell, cpu: float, wall: float) -> None:
        """Keep the seconds before a cell's first sample; the first that were kept stay."""
        with self._faults(), self._transaction():
            self._insert("INSERT OR IGNORE INTO setups", (machine, *cell.pair, cell.count, float(cpu), float(wall)))

    def setup(self, machine: str, cell: Cell) -> tuple[float, float]:
        """These seconds, by processor and wall clock."""
        where = "setups WHERE machine = ? AND scene = ? AND sampler = ? AND count = ?"
        with self._faults():
            rows = self._select(where, machine, *cell.pair, cell.count)
        return rows[0][4:] if rows else (0.0, 0.0)

    def _insert(self, into: str, row: tuple[Any, ...]) -> None:
        places = ", ".join("?" * (len(row) + 1))
        self._database.execute(f"{into} VALUES ({places})", (*row, _digest(row)))

    def _select(self, where: str, *values: Any) -> list[Any]:
        """Whole rows without their digests, which fit."""
        rows = self._database.execute(f"SELECT * FROM {where}", values).fetchall()
        if any(_digest(row[:-1]) != row[-1] for row in rows):
            raise sqlite3.DatabaseError("it is damaged: numbers in it are not those that were written")
        return [row[:-1] for row in rows]

    @property
    def _shown(self) -> str:
        return "the study" if self._path is None else shown(self._path)

    @contextlib.contextmanager
    def _transaction(self) -> Iterator[None]:
        self._database.execute("BEGIN")
        try:
            yield
            self._database.execute("COMMIT")
        except BaseException:
            with contextlib.suppress(sqlite3.Error):
                self._database.execute("ROLLBACK")
            raise

    @contextlib.contextmanager
    def _faults(self) -> Iterator[None]:
        """One line for what SQLite cannot do."""
        try:
            yield
        except sqlite3.OperationalError as error:
            if "decode" in str(error) or "no such column" in str(error) or "no such table" in str(error):
                raise UsageError(f"cannot read {self._shown}: it is damaged: choose another folder") from None
            if "locked" in str(error):
                raise UsageError(f"{self._shown} is in use: another study is writing there") from None
            raise SamplekitError(
                f"cannot write {self._shown}: {error}: what was done is kept, --resume goes on from there"
            ) from None
        except sqlite3.DatabaseError as error:
            raise UsageError(f"cannot read {self._shown}: {error}: choose another folder") from None
