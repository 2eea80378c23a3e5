import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import platformdirs
import pytest

from samplekit.files import _cache as cache
from samplekit.files._cache import VARIABLE, cache_folder, cached_array


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "kept"))
    return tmp_path / "kept"


class Maker:
    def __init__(self, array):
        self.array = np.asarray(array)
        self.calls = 0

    def __call__(self):
        self.calls += 1
        return self.array


@pytest.fixture
def maker():
    return Maker(np.random.default_rng(5).random((3, 2, 7)))


def test_the_variable_names_the_folder_and_empty_turns_it_off(folder, monkeypatch):
    assert cache_folder() == folder
    assert folder.is_dir()
    monkeypatch.setenv(VARIABLE, "")
    assert cache_folder() is None


def test_without_the_variable_it_is_the_users_cache(monkeypatch, tmp_path):
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(cache.platformdirs, "user_cache_path", lambda name, appauthor: tmp_path / name)
    assert cache_folder() == tmp_path / "samplekit"


def test_made_once_then_loaded(folder, maker):
    first = cached_array("set", "key", maker)
    second = cached_array("set", "key", maker)
    assert maker.calls == 1
    np.testing.assert_array_equal(first, maker.array)
    np.testing.assert_array_equal(second, maker.array)
    assert second.dtype == maker.array.dtype
    assert [path.suffix for path in folder.iterdir()] == [".npy"]


def test_another_key_is_another_array(folder, maker):
    cached_array("set", "key", maker)
    cached_array("set", "another key", maker)
    assert maker.calls == 2


def test_a_kept_file_is_an_ordinary_npy_file(folder, maker):
    cached_array("set", "key", maker)
    (path,) = folder.iterdir()
    np.testing.assert_array_equal(np.load(path, allow_pickle=False), maker.array)


def damages():
    yield "empty", lambda data: b""
    yield "cut", lambda data: data[: len(data) // 2]
    yield "last byte gone", lambda data: data[:-1]
    yield "text", lambda data: b"not an array at all" * 10
    for place in (0, 7, 30, 200, -40, -1):
        yield (
            f"byte {place} changed",
            lambda data, p=place: (
                data[:p] + bytes([data[p] ^ 1]) + data[p + 1 :] if p != -1 else data[:-1] + bytes([data[-1] ^ 1])
            ),
        )


@pytest.mark.parametrize("damage", [pytest.param(f, id=name) for name, f in damages()])
def test_a_damaged_file_is_made_anew(folder, maker, damage):
    cached_array("set", "key", maker)
    (path,) = folder.iterdir()
    whole = path.read_bytes()
    path.write_bytes(damage(whole))
    assert path.read_bytes() != whole
    np.testing.assert_array_equal(cached_array("set", "key", maker), maker.array)
    assert maker.calls == 2
    assert path.read_bytes() == whole


def test_a_file_of_another_key_is_not_taken(folder, maker):
    cached_array("set", "key", maker)
    (path,) = folder.iterdir()
    cached_array("set", "other", Maker([1.0]))
    (other,) = set(folder.iterdir()) - {path}
    other.replace(path)
    np.testing.assert_array_equal(cached_array("set", "key", maker), maker.array)


def test_pickles_are_refused(folder, maker, monkeypatch):
    harmful = np.empty(1, object)
    harmful[0] = Path("harmful")
    monkeypatch.setattr(np, "save", lambda file, array, allow_pickle: np.lib.format.write_array(file, harmful))
    cached_array("set", "key", maker)
    monkeypatch.undo()
    monkeypatch.setenv(VARIABLE, str(folder))
    np.testing.assert_array_equal(cached_array("set", "key", maker), maker.array)
    assert maker.calls == 2


def test_an_array_that_is_not_valid_is_made_anew(folder, maker):
    cached_array("set", "key", Maker([2.0, 3.0]))
    made = cached_array("set", "key", maker, valid=lambda array: array.shape == (3, 2, 7))
    np.testing.assert_array_equal(made, maker.array)


def test_where_no_folder_can_be_nothing_fails(tmp_path, monkeypatch, maker):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "file" / "below"))
    assert cache_folder() is None
    np.testing.assert_array_equal(cached_array("set", "key", maker), maker.array)


@pytest.mark.parametrize("step", ["touch", "fsync", "replace"])
def test_a_failing_write_leaves_nothing_behind(folder, maker, monkeypatch, step):
    def fail(*args, **kwargs):
        raise OSError(28, "No space left on device")

    target = os if step == "fsync" else Path
    monkeypatch.setattr(target, step, fail)
    np.testing.assert_array_equal(cached_array("set", "key", maker), maker.array)
    assert list(folder.iterdir()) == []


def test_an_interrupted_write_leaves_the_old_file_or_none(folder, maker, monkeypatch):
    def interrupt(*args, **kwargs):
        raise KeyboardInterrupt

    with monkeypatch.context() as context:
        context.setattr(cache.os, "fsync", interrupt)
        with pytest.raises(KeyboardInterrupt):
            cached_array("set", "key", maker)
    assert list(folder.iterdir()) == []


def test_processes_at_the_same_work_agree(folder):
    script = (
        "import numpy as np; from samplekit.files._cache import cached_array\n"
        "make = lambda: np.random.default_rng(1).random(50_000)\n"
        "print(all(cached_array('set', 'key %d' % k, make).sum() == make().sum() for k in range(30)))"
    )
    environment = {**os.environ, VARIABLE: str(folder)}
    processes = [
        subprocess.Popen([sys.executable, "-c", script], env=environment, stdout=subprocess.PIPE, text=True)
        for _ in range(3)
    ]
    assert [process.communicate(timeout=60)[0].strip() for process in processes] == ["True"] * 3
    assert all(path.suffix == ".npy" for path in folder.iterdir())
    assert len(list(folder.iterdir())) == 30


def no_home(*_, **__):
    raise RuntimeError("could not determine the home directory")


@pytest.mark.parametrize("found", [no_home, lambda *_, **__: Path("~/.cache/samplekit")])
def test_without_a_home_nothing_is_kept_and_no_folder_is_made(tmp_path, monkeypatch, found):
    """What platformdirs gives to a user without a home: an error, or "~" as it is in its older versions."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(platformdirs, "user_cache_path", found)
    monkeypatch.chdir(tmp_path)
    assert cache_folder() is None
    assert list(tmp_path.iterdir()) == []
