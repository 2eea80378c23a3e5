"""Doors behind which files lie: each reads damaged ones, and what it then says is judged against the whole one."""

from __future__ import annotations

import contextlib
import json
import os
import sqlite3
from typing import TYPE_CHECKING

from fuzzing.damage import damaged

if TYPE_CHECKING:
    from collections.abc import Iterator
    from random import Random

    from fuzzing.doors import Doors, Verdict

POINTS = ("a.csv", "b.plain.csv", "c.npy", "d.dat", "e.bin")
STUDY = "compare -s random -s sobol+owen --scene disk --spp 1,4 --trials 4 --size 1 --no-time -t 1"
BANK = ("lloyd:steps=1,bank=2", "ccvt:bank=2", "poisson-disk:bank=2")


@contextlib.contextmanager
def instead(path, data: bytes) -> Iterator[None]:
    """The file with other contents for a while."""
    kept = path.read_bytes()
    path.write_bytes(data)
    try:
        yield
    finally:
        path.write_bytes(kept)


def points_of(doors: Doors, random: Random) -> tuple[str, Verdict]:
    """A damaged file of points: its points, if it still is one, or a refusal."""
    name = random.choice(POINTS)
    path = doors.folder / name
    path.write_bytes(damaged(path.read_bytes(), random))
    doors.look()
    return name, doors.ask(["points", "-s", f"file:path={name}", "-n", "16", "--json"])


def image_of(doors: Doors, random: Random) -> tuple[str, Verdict]:
    """A damaged image: asked how it was made, or for the spectrum of its error."""
    name = random.choice(["image.exr", "image.exr", "image.png", "image.error.png"])
    words = ["info", name] if random.random() < 0.7 else ["spectrum", "--image", name, "-o", "out"]
    path = doors.folder / name
    path.write_bytes(damaged(path.read_bytes(), random))
    doors.look()
    return f"{words[0]} {name}", doors.ask([*words, "--json"])


def bank_of(doors: Doors, random: Random) -> tuple[str, Verdict]:
    """A damaged bank in the cache: the same points as from a whole one."""
    from samplekit_bluenoise import bank

    sampler = random.choice(BANK)
    words = ["points", "-s", sampler, "-n", "9", "--json"]
    bank._banks.clear()
    whole = doors.ask(words).answer
    name = sampler.partition(":")[0]
    (path,) = doors.cache.glob(f"{name}-9-*.npy")
    with instead(path, damaged(path.read_bytes(), random)):
        bank._banks.clear()
        verdict = doors.ask(words)
        if verdict.answer != whole:
            verdict.wrong.append("points from a damaged bank")
    verdict.wrong.extend(f"{left.name} was left behind" for left in doors.cache.glob("*.tmp"))
    return name, verdict


def study_of(doors: Doors, random: Random) -> tuple[str, Verdict]:
    """A damaged study that is gone on with: the same numbers, or a refusal."""
    folder = doors.folder / "out" / "study"
    whole = doors.study
    path = folder / "study.sqlite"
    folder.mkdir()
    data = doors.study_file
    kind = random.choice(["bytes", "bytes", "value"])
    path.write_bytes(damaged(data, random) if kind == "bytes" else data)
    if kind == "value":
        _change_a_value(path, random)
    doors.look()
    verdict = doors.ask([*STUDY.split(), "--output", "out/study", "--resume", "--json"], study=True)
    if verdict.answer.status == 0 and numbers(verdict.answer.out) != whole:
        verdict.wrong.append("other numbers from a damaged study")
    return kind, verdict


def numbers(text: str) -> list[str]:
    """What a study found, without times."""
    rows = json.loads(text)["rows"]
    return [
        json.dumps([row[name] for name in ("scene", "sampler", "count", "trials", "mse", "variance")]) for row in rows
    ]


def _change_a_value(path, random: Random) -> None:
    database = sqlite3.connect(path)
    with database:
        tables = [row[0] for row in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        table = random.choice(tables)
        columns = [row[1] for row in database.execute(f"PRAGMA table_info({table})")]
        value = random.choice(
            ["NULL", "0", "-1", "1", "1e999", "'x'", "X'80ff'", "zeroblob(64)", "9223372036854775807"]
        )
        change = random.choice([f"UPDATE {table} SET {random.choice(columns)} = {value}", f"DELETE FROM {table}"])
        change = random.choice([change, change, f"DROP TABLE {table}", f"ALTER TABLE {table} RENAME TO other"])
        with contextlib.suppress(sqlite3.Error):
            database.execute(random.choice([change, f"{change} WHERE rowid = 1" if " SET " in change else change]))
    database.close()


DOORS = {"points": points_of, "image": image_of, "bank": bank_of, "study": study_of}
"""What is read, by name."""


class Bomb:
    """What a pickle would do if it were let: make a file."""

    def __init__(self, path) -> None:
        self.path = str(path)

    def __reduce__(self):
        return os.mkdir, (self.path,)
