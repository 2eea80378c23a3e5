"""The store of a study: an SQLite file with the sums and times so far, a transaction for each job.

A killed study loses no finished job. A running study holds the file exclusively; the operating system releases the lock
when the process ends, however it ends. SQLite does not notice a flipped bit in a number, so every row carries its own
SHA-256 digest: a row that does not match its digest ends the study before it becomes a result.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import sqlite3
from typing import TYPE_CHECKING, Any

import numpy as np

from samplekit._errors import SamplekitError, UsageError
from samplekit._study.trials import COLUMNS, Array
from samplekit.files import shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from samplekit._study.combinations import Combination
    from samplekit._study.jobs import Job
    from samplekit._study.timing import Lap

FORMAT = 3
NAME = "study.sqlite"
_TABLES = """
CREATE TABLE study (format INTEGER, request TEXT, versions TEXT, digest BLOB);
CREATE TABLE sums (scene TEXT, sampler TEXT, count INTEGER, first INTEGER, last INTEGER, batches BLOB, digest BLOB,
  PRIMARY KEY (scene, sampler, count, first));
CREATE TABLE laps (machine TEXT, scene TEXT, sampler TEXT, count INTEGER, round INTEGER,
  points_cpu REAL, points_wall REAL, scene_cpu REAL, scene_wall REAL, digest BLOB);
CREATE TABLE setups (machine TEXT, scene TEXT, sampler TEXT, count INTEGER, cpu REAL, wall REAL, digest BLOB,
  PRIMARY KEY (machine, scene, sampler, count))
"""


def _digest(row: Sequence[Any]) -> bytes:
    return hashlib.sha256(repr(tuple(row)).encode()).digest()


def _key(combination: Combination) -> dict[str, Any]:
    return {"scene": combination.scene, "sampler": combination.sampler, "count": combination.count}


class Store:
    """The file ``study.sqlite`` of a study, which belongs to this process until :meth:`close`.

    Parameters
    ----------
    folder
        Where the file is; None: in memory, and gone when closed.
    request, versions
        The request of the study, and the versions of what computes it: a new file gets them, an old one must have them.
    machine
        The kind of machine on which times are measured. Times in the file from other kinds are left alone.

    Raises
    ------
    UsageError
        Another study is using the file, the file belongs to another study or has another format, or it is damaged.
    SamplekitError
        The file cannot be written.
    """

    def __init__(self, folder: Path | None, request: dict[str, Any], versions: dict[str, str], machine: str) -> None:
        self._machine = machine
        self._shown = "the study" if folder is None else shown(folder / NAME)
        with self._one_line_errors():
            self._database = sqlite3.connect(folder / NAME if folder else ":memory:", timeout=0.0, isolation_level=None)
        try:
            self._begin(request, versions)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the file and release its lock."""
        # What cannot be tidied up on a full disk is tidied up when the file is opened again.
        with contextlib.suppress(sqlite3.Error):
            self._database.close()

    def _begin(self, request: dict[str, Any], versions: dict[str, str]) -> None:
        """Lock the file; write the request and the versions, or check that the file has the same ones."""
        with self._one_line_errors():
            self._database.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._database.execute("PRAGMA journal_mode = WAL")
            self._database.execute("PRAGMA synchronous = NORMAL")
            self._database.execute("BEGIN EXCLUSIVE")
            self._database.execute("COMMIT")
            tables = {name for (name,) in self._database.execute("SELECT name FROM sqlite_master")}
            found = self._database.execute("SELECT format FROM study").fetchone() if "study" in tables else None
        if not tables:
            with self._transaction():
                for table in _TABLES.split(";"):
                    self._database.execute(table)
                self._insert("INSERT INTO study", (FORMAT, json.dumps(request), json.dumps(versions)))
            return
        if found is None or found[0] != FORMAT:
            raise UsageError(
                f"{self._shown} is of version {found[0] if found else 'unknown'}, this samplekit continues version"
                f" {FORMAT}: finish it with the samplekit that began it, or choose another folder"
            )
        self._check_same(request, versions)

    def _check_same(self, request: dict[str, Any], versions: dict[str, str]) -> None:
        ((_, kept_request, kept_versions),) = self._select("study")
        # JSON makes lists of tuples.
        kept, asked = json.loads(kept_request), json.loads(json.dumps(request))
        for name in asked:
            if kept.get(name) != asked[name]:
                raise UsageError(
                    f"{self._shown} is of another study: {name} {kept.get(name)}, not {asked[name]}:"
                    " ask for the same, or choose another folder"
                )
        began_with = json.loads(kept_versions)
        for name in began_with | versions:
            if began_with.get(name) != versions.get(name):
                raise UsageError(
                    f"{self._shown} was begun with {name} {began_with.get(name, '(none)')}, this is"
                    f" {versions.get(name, '(none)')}: numbers may differ: install that version, or choose another"
                    " folder"
                )

    def add(self, job: Job, sums: Array) -> None:
        """Keep the sums float64[counts, batches, COLUMNS] of a job."""
        with self._transaction():
            for count, batches in zip(job.counts, sums, strict=True):
                row = job.scene, job.sampler, count, job.first, job.last, np.ascontiguousarray(batches).tobytes()
                self._insert("INSERT OR REPLACE INTO sums", row)

    def ranges(self, combination: Combination) -> list[tuple[int, int]]:
        """Return the ranges of trials that are done, in rising order: first and last of each job."""
        return [(row[3], row[4]) for row in self._select("sums", "first", **_key(combination))]

    def sums(self, combination: Combination) -> Array:
        """Return the batches float64[B, COLUMNS] of a combination in the order of their trials."""
        batches = b"".join(row[5] for row in self._select("sums", "first", **_key(combination)))
        return np.frombuffer(batches, np.float64).reshape(-1, COLUMNS)

    def add_laps(self, number: int, laps: Sequence[tuple[Combination, Lap]]) -> None:
        """Keep the seconds of laps of the round with this number."""
        with self._transaction():
            for combination, lap in laps:
                self._insert("INSERT INTO laps", (self._machine, *_key(combination).values(), number, *map(float, lap)))

    def laps(self, combination: Combination) -> Array:
        """Return the laps of a combination on this kind of machine: float64[L, 5], number of the round and seconds."""
        rows = self._select("laps", machine=self._machine, **_key(combination))
        return np.array([row[4:] for row in rows], np.float64).reshape(-1, 5)

    def add_setup(self, combination: Combination, cpu: float, wall: float) -> None:
        """Keep the seconds before the first sample, unless the store has them from an earlier run."""
        with self._transaction():
            row = (self._machine, *_key(combination).values(), float(cpu), float(wall))
            self._insert("INSERT OR IGNORE INTO setups", row)

    def setup(self, combination: Combination) -> tuple[float, float]:
        """Return the seconds before the first sample, by processor and wall clock; 0 if they were not measured."""
        rows = self._select("setups", machine=self._machine, **_key(combination))
        return rows[0][4:] if rows else (0.0, 0.0)

    def _insert(self, into: str, row: tuple[Any, ...]) -> None:
        places = ", ".join("?" * (len(row) + 1))
        self._database.execute(f"{into} VALUES ({places})", (*row, _digest(row)))

    def _select(self, table: str, order: str = "rowid", **where: Any) -> list[Any]:
        """Return the rows with these values, without their digests, after checking the digests."""
        conditions = " AND ".join(f"{name} = :{name}" for name in where) or "TRUE"
        with self._one_line_errors():
            query = f"SELECT * FROM {table} WHERE {conditions} ORDER BY {order}"
            rows = self._database.execute(query, where).fetchall()
            if any(_digest(row[:-1]) != row[-1] for row in rows):
                raise sqlite3.DatabaseError("it is damaged: numbers in it are not those that were written")
        return [row[:-1] for row in rows]

    @contextlib.contextmanager
    def _transaction(self) -> Iterator[None]:
        with self._one_line_errors():
            self._database.execute("BEGIN")
            try:
                yield
                self._database.execute("COMMIT")
            except BaseException:
                with contextlib.suppress(sqlite3.Error):
                    self._database.execute("ROLLBACK")
                raise

    @contextlib.contextmanager
    def _one_line_errors(self) -> Iterator[None]:
        """Turn the errors of SQLite into messages of one line."""
        try:
            yield
        except sqlite3.OperationalError as error:
            # Text that is not UTF-8 has no code of SQLite; a missing table or column has the general one.
            code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
            if code == sqlite3.SQLITE_ERROR:
                raise UsageError(f"cannot read {self._shown}: it is damaged: choose another folder") from None
            if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
                raise UsageError(f"{self._shown} is in use: another study is writing there") from None
            raise SamplekitError(
                f"cannot write {self._shown}: {error}: what was done is kept, --resume continues from there"
            ) from None
        except sqlite3.DatabaseError as error:
            raise UsageError(f"cannot read {self._shown}: {error}: choose another folder") from None
