"""The store: it loses nothing that was done, and refuses files that are damaged or belong to another study."""

import sqlite3
from dataclasses import asdict, replace

import numpy as np
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit._study.analysis import Analysis
from samplekit._study.combinations import list_combinations
from samplekit._study.folder import check_folder
from samplekit._study.jobs import Job
from samplekit._study.request import ExecutionOptions, checked_request
from samplekit._study.resources import Resources
from samplekit._study.store import NAME, Store
from samplekit._study.trials import COLUMNS, carry_out

REQUEST = checked_request(["disk"], ["random"], [4], 8, (1, 1), 0)
VERSIONS = {"samplekit": "0.1.0", "numpy": "2.0"}


@pytest.fixture
def opened(tmp_path):
    """Open stores in one folder, closed at the end."""
    stores = []

    def open_store(request=REQUEST, versions=VERSIONS, machine="this one"):
        stores.append(Store(tmp_path, asdict(request), versions, machine))
        return stores[-1]

    yield open_store
    for store in stores:
        store.close()


def test_sums_come_back_in_the_order_of_their_trials(opened):
    (combination,), _ = list_combinations(REQUEST, Resources())
    store = opened()
    parts = {first: np.random.default_rng(first).random((1, 2, COLUMNS)) for first in (4, 0, 2)}
    for first, sums in parts.items():
        store.add(Job("disk", "random", (4,), first, first + 2, 1, (1, 1), 0), sums)
    store.close()
    again = opened()
    assert again.ranges(combination) == [(0, 2), (2, 4), (4, 6)]
    assert np.array_equal(again.sums(combination), np.concatenate([parts[first][0] for first in (0, 2, 4)]))
    assert again.sums(replace(combination, count=5)).shape == (0, COLUMNS)


def test_two_at_once_are_refused(opened):
    opened()
    with pytest.raises(UsageError, match="in use"):
        opened()


@pytest.mark.parametrize(
    ("request_", "versions", "message"),
    [
        (replace(REQUEST, seed=1), VERSIONS, "another study: seed 0, not 1"),
        (replace(REQUEST, counts=(4, 16)), VERSIONS, "another study: counts"),
        (REQUEST, VERSIONS | {"numpy": "3.0"}, "numpy 2.0, this is 3.0"),
    ],
)
def test_other_studies_are_refused(opened, request_, versions, message):
    opened().close()
    with pytest.raises(UsageError, match=message):
        opened(request_, versions)


def test_other_formats_and_other_files_are_refused(opened, tmp_path):
    opened().close()
    with sqlite3.connect(tmp_path / NAME) as database:
        database.execute("UPDATE study SET format = 0")
    database.close()
    with pytest.raises(UsageError, match="version 0, this samplekit continues version 3"):
        opened()
    (tmp_path / NAME).write_bytes(b"no database at all " * 100)
    with pytest.raises(UsageError, match="choose another folder"):
        opened()


@pytest.mark.parametrize(
    "damage",
    [
        "UPDATE sums SET batches = zeroblob(length(batches))",
        "UPDATE sums SET batches = substr(batches, 2)",
        "UPDATE sums SET batches = NULL",
        "UPDATE sums SET last = 1",
        "UPDATE sums SET digest = NULL",
        "DROP TABLE sums",
    ],
)
def test_numbers_that_changed_in_the_file_are_no_results(opened, tmp_path, damage):
    (combination,), _ = list_combinations(REQUEST, Resources())
    store = opened()
    store.add(Job("disk", "random", (4,), 0, 2, 1, (1, 1), 0), np.ones((1, 2, COLUMNS)))
    store.close()
    with sqlite3.connect(tmp_path / NAME) as database:
        database.execute(damage)
    database.close()
    again = opened()
    for ask in (again.ranges, again.sums):
        with pytest.raises(UsageError, match=r"damaged.*choose another folder"):
            ask(combination)


@pytest.mark.parametrize("damage", ["request = 'x'", "versions = '{'", "request = NULL", "versions = X'80'"])
def test_a_request_that_changed_in_the_file_is_damage(opened, tmp_path, damage):
    opened().close()
    with sqlite3.connect(tmp_path / NAME) as database:
        database.execute(f"UPDATE study SET {damage}")
    database.close()
    with pytest.raises(UsageError, match=r"damaged.*choose another folder"):
        opened()


def test_full_disk_loses_nothing_done(opened):
    (combination,), _ = list_combinations(REQUEST, Resources())
    store = opened()
    store._database.execute("PRAGMA max_page_count = 30")
    job = Job("disk", "random", (4,), 0, 1000, 1, (1, 1), 0)
    sums = carry_out(job, Resources())
    store.add(job, sums)
    with pytest.raises(SamplekitError, match=r"cannot write .*full.*--resume"):
        store.add(replace(job, first=1000, last=2000), np.repeat(sums, 10, axis=1))
    store.close()
    again = opened()
    assert again.ranges(combination) == [(0, 1000)]
    assert np.array_equal(again.sums(combination), sums[0])


def test_times_of_another_kind_of_machine_do_not_count(opened):
    resources = Resources()
    (combination,), _ = list_combinations(REQUEST, resources)
    slow = opened(machine="slow")
    slow.add(Job("disk", "random", (4,), 0, 8, 1, (1, 1), 0), np.ones((1, 8, COLUMNS)))
    slow.add_laps(1, [(combination, (9.0, 9.0, 9.0, 9.0))] * 5)
    slow.close()
    fast = opened(machine="fast")
    fast.add_laps(1, [(combination, (1.0, 2.0, 3.0, 4.0))] * 5)
    (row,) = Analysis(REQUEST, ExecutionOptions(cost=10.0), [combination], fast, resources).rows()
    assert (row.times.points.cpu.median, row.times.total.wall.upper, row.times.laps) == (1.0, 6.0, 5)
    assert row.time.estimate == pytest.approx(4.0 + 4 * 10e-9)
    fast.close()
    (row,) = Analysis(REQUEST, ExecutionOptions(), [combination], opened(machine="third"), resources).rows()
    assert (row.times, row.time) == (None, None)


def test_folders(tmp_path):
    check_folder(tmp_path / "new", resume=False)
    check_folder(tmp_path / "new", resume=True)
    (tmp_path / "new" / NAME).touch()
    check_folder(tmp_path / "new", resume=True)
    with pytest.raises(UsageError, match="--resume continues"):
        check_folder(tmp_path / "new", resume=False)
    (tmp_path / "new" / "thesis.tex").touch()
    with pytest.raises(UsageError, match=r"holds 'thesis.tex'"):
        check_folder(tmp_path / "new", resume=True)
    with pytest.raises(UsageError, match="does not exist"):
        check_folder(tmp_path / "no" / "folder", resume=False)
    (tmp_path / "file").touch()
    with pytest.raises(UsageError, match="cannot write"):
        check_folder(tmp_path / "file", resume=False)
