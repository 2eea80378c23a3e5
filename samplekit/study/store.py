"""What a study has found so far, in an SQLite file: a transaction for each job, so that a kill loses no finished one.

The file is held exclusively while a study runs. The lock is the operating system's: it goes with its process, however
that ends.
"""

from __future__ import annotations

import contextlib
import json
import sqlite3
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit.errors import SamplekitError, UsageError
from samplekit.images.files import shown
from samplekit.study.trials import COLUMNS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from samplekit.study.cells import Cell
    from samplekit.study.jobs import Job

    Array = NDArray[np.float64]

FORMAT = 1
NAME = "study.sqlite"
_TABLES = """
CREATE TABLE study (format INTEGER, request TEXT, versions TEXT);
CREATE TABLE sums (scene TEXT, sampler TEXT, count INTEGER, first INTEGER, last INTEGER, batches BLOB,
  PRIMARY KEY (scene, sampler, count, first));
CREATE TABLE laps (machine TEXT, scene TEXT, sampler TEXT, count INTEGER,
  points_cpu REAL, points_wall REAL, scene_cpu REAL, scene_wall REAL);
CREATE TABLE setups (machine TEXT, scene TEXT, sampler TEXT, count INTEGER, cpu REAL, wall REAL,
  PRIMARY KEY (machine, scene, sampler, count))
"""


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
                    row = FORMAT, json.dumps(request), json.dumps(versions)
                    self._database.execute("INSERT INTO study VALUES (?, ?, ?)", row)
                return
            found = self._database.execute("SELECT format FROM study").fetchone() if "study" in tables else None
            if found is None or found[0] != FORMAT:
                raise UsageError(
                    f"{self._shown} is of version {found[0] if found else 'unknown'}, this samplekit continues version"
                    f" {FORMAT}: finish it with the samplekit that began it, or choose another folder"
                )
            kept_request, kept_versions = self._database.execute("SELECT request, versions FROM study").fetchone()
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
                self._database.execute("INSERT OR REPLACE INTO sums VALUES (?, ?, ?, ?, ?, ?)", row)

    def ranges(self, cell: Cell) -> list[tuple[int, int]]:
        """The trials that a cell has, first to last of each job."""
        query = "SELECT first, last FROM sums WHERE scene = ? AND sampler = ? AND count = ? ORDER BY first"
        with self._faults():
            return self._database.execute(query, (*cell.pair, cell.count)).fetchall()

    def sums(self, cell: Cell) -> Array:
        """The batches float64[B, COLUMNS] of a cell, in the order of their trials."""
        query = "SELECT batches FROM sums WHERE scene = ? AND sampler = ? AND count = ? ORDER BY first"
        with self._faults():
            blobs = [blob for (blob,) in self._database.execute(query, (*cell.pair, cell.count))]
        return np.frombuffer(b"".join(blobs), np.float64).reshape(-1, COLUMNS)

    def add_laps(self, machine: str, laps: Sequence[tuple[Cell, tuple[float, float, float, float]]]) -> None:
        """Keep times of single trials: of points by processor and wall clock, and of the scene."""
        rows = [(machine, *cell.pair, cell.count, *seconds) for cell, seconds in laps]
        with self._faults(), self._transaction():
            self._database.executemany("INSERT INTO laps VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)

    def laps(self, machine: str, cell: Cell) -> Array:
        """The times float64[L, 4] of a cell on a machine."""
        query = (
            "SELECT points_cpu, points_wall, scene_cpu, scene_wall FROM laps"
            " WHERE machine = ? AND scene = ? AND sampler = ? AND count = ? ORDER BY rowid"
        )
        with self._faults():
            rows = self._database.execute(query, (machine, *cell.pair, cell.count)).fetchall()
        return np.array(rows, np.float64).reshape(-1, 4)

    def add_setup(self, machine: str, cell: Cell, cpu: float, wall: float) -> None:
        """Keep the seconds before a cell's first sample; the first that were kept stay."""
        with self._faults(), self._transaction():
            row = machine, *cell.pair, cell.count, cpu, wall
            self._database.execute("INSERT OR IGNORE INTO setups VALUES (?, ?, ?, ?, ?, ?)", row)

    def setup(self, machine: str, cell: Cell) -> tuple[float, float]:
        """These seconds, by processor and wall clock."""
        query = "SELECT cpu, wall FROM setups WHERE machine = ? AND scene = ? AND sampler = ? AND count = ?"
        with self._faults():
            found = self._database.execute(query, (machine, *cell.pair, cell.count)).fetchone()
        return found or (0.0, 0.0)

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
            if "locked" in str(error):
                raise UsageError(f"{self._shown} is in use: another study is writing there") from None
            raise SamplekitError(
                f"cannot write {self._shown}: {error}: what was done is kept, --resume goes on from there"
            ) from None
        except sqlite3.DatabaseError as error:
            raise UsageError(f"cannot read {self._shown}: {error}: choose another folder") from None
