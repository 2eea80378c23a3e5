import os
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from samplekit_bluenoise import bank
from samplekit_bluenoise.bank import WholeSets
from samplekit_bluenoise.torus import on_torus

import samplekit


class Counted(WholeSets):
    """Random sets that count how often one is made."""

    def __init__(self, sets):
        super().__init__("counted", sets)
        self.made = []

    def make(self, sets, realizations):
        self.made.append(threading.get_ident())
        for row, key in enumerate(realizations.keys):
            drawn = np.random.default_rng(int(key)).random(sets.shape[1:])
            sets[row] = np.floor(drawn * 2.0**53) * 2.0**-53


def fill(sampler, rows=20, count=10, seed=0):
    out = np.empty((rows, 2, count))
    sampler.fill(out, samplekit.sampler("random").trials(0, rows, seed), count, 0)
    return out


def symmetries(set_):
    """The eight images of float64[2, N] on the torus under the symmetries of the square."""
    for axes in ((0, 1), (1, 0)):
        for sign_x in (1, -1):
            for sign_y in (1, -1):
                yield set_[list(axes)] * np.array([[sign_x], [sign_y]])


def is_image(points, set_):
    for image in symmetries(set_):
        difference = points - image
        difference -= difference[:, :1]
        if np.abs(difference - np.rint(difference)).max() < 1e-12:
            return True
    return False


def test_every_realisation_is_a_set_of_the_bank_shifted_and_mirrored(cache_folder):
    sampler = Counted(3)
    sets = sampler._sets(10)
    assert sets.shape == (3, 2, 10)
    chosen = [[k for k in range(3) if is_image(points, sets[k])] for points in fill(sampler, 60)]
    assert all(len(which) == 1 for which in chosen)
    assert {which[0] for which in chosen} == {0, 1, 2}


def test_all_sets_symmetries_and_shifts_are_as_likely():
    """Chi-squares of 8 symmetries and 4 sets, and means of the shifts; bounds at 1e-6."""
    sets = np.zeros((4, 2, 3))
    sets[:, 0, 1] = 0.125
    sets[:, 1, 2] = 0.25
    sets[:, 0, 2] = np.arange(4) / 1024
    out = np.empty((8000, 2, 3))
    bank._place(out, sets, samplekit.sampler("random").trials(0, 8000, 3).keys, 0, True)
    offset = out - out[:, :, :1]
    offset -= np.rint(offset)
    short, long = offset[:, :, 1], offset[:, :, 2]
    axis = np.argmax(np.abs(short), axis=1)
    rows = np.arange(8000)
    which = np.rint(np.abs(long[rows, axis]) * 1024).astype(int)
    symmetry = axis * 4 + (short[rows, axis] > 0) * 2 + (long[rows, 1 - axis] > 0)
    assert ((np.bincount(symmetry, minlength=8) - 1000) ** 2 / 1000).sum() < 40.5
    assert ((np.bincount(which, minlength=4) - 2000) ** 2 / 2000).sum() < 31.0
    assert np.abs(out[:, :, 0].mean(axis=0) - 0.5).max() < 5 / np.sqrt(12 * 8000)
    assert abs(np.corrcoef(out[:, 0, 0], out[:, 1, 0])[0, 1]) < 5 / np.sqrt(8000)


def test_shifts_keep_distances_to_the_last_bit():
    rng = np.random.default_rng(0)
    sets = np.floor(rng.random((1, 2, 200)) * 2.0**53) * 2.0**-53
    sets[0, 0, :3] = 0.0, 1.0 - 2.0**-53, 2.0**-53
    out = np.empty((50, 2, 200))
    bank._place(out, sets, samplekit.sampler("random").trials(0, 50, 1).keys, 0, True)

    def distances(points):
        difference = np.abs(points[:, :, None] - points[:, None])
        difference = np.minimum(difference, 1.0 - difference)
        return np.sort((np.sort(difference, axis=0) ** 2).sum(0), axis=None)

    for points in out:
        np.testing.assert_array_equal(distances(points), distances(sets[0]))
    assert out.min() >= 0.0
    assert out.max() < 1.0


@pytest.mark.slow
def test_coordinates_are_multiples_of_the_last_bit_of_one():
    for x in (0.3, -0.2, 1.7, -1e-20, 5e-324, 1.0 - 2.0**-53, 1.0, -3.0):
        on = on_torus(x)
        assert 0.0 <= on < 1.0
        assert (on * 2.0**53).is_integer()
    for text in ("poisson-disk", "poisson-disk:method=elimination", "lloyd:bank=0", "ccvt:bank=0,capacity=8"):
        assert np.all(samplekit.points(text, 100, 2, realizations=5) * 2.0**53 % 1.0 == 0.0)


def test_the_bank_does_not_depend_on_the_seed_and_is_made_once(cache_folder):
    first = Counted(4)
    fill(first, seed=1)
    fill(first, seed=2)
    assert len(first.made) == 4
    second = Counted(4)
    fill(second, seed=1)
    assert second.made == []


def test_the_bank_is_kept_across_runs(cache_folder, monkeypatch):
    before = fill(Counted(4))
    monkeypatch.setattr(bank, "_banks", type(bank._banks)())
    later = Counted(4)
    np.testing.assert_array_equal(fill(later), before)
    assert later.made == []


def test_options_counts_and_sizes_have_banks_of_their_own(cache_folder):
    for text in ("lloyd:steps=1,bank=2", "lloyd:steps=2,bank=2", "lloyd:steps=1,bank=3", "ccvt:capacity=8,bank=2"):
        samplekit.points(text, 7, 2)
    samplekit.points("lloyd:steps=1,bank=2", 8, 2)
    assert len(list(cache_folder.iterdir())) == 5


def test_a_damaged_bank_is_made_anew(cache_folder, monkeypatch):
    before = fill(Counted(4))
    (path,) = cache_folder.iterdir()
    data = path.read_bytes()
    for damaged in (data[:100], data[:-40] + bytes(8) + data[-32:], b""):
        monkeypatch.setattr(bank, "_banks", type(bank._banks)())
        path.write_bytes(damaged)
        later = Counted(4)
        np.testing.assert_array_equal(fill(later), before)
        assert len(later.made) == 4
        assert path.read_bytes() == data


def test_a_bank_of_another_shape_or_range_is_not_taken(cache_folder, monkeypatch):
    before = fill(Counted(4))
    for wrong in (
        np.zeros((4, 2, 11)),
        np.zeros((4, 2, 10), np.float32),
        np.ones((4, 2, 10)),
        np.full((4, 2, 10), np.nan),
    ):
        monkeypatch.setattr(bank, "_banks", type(bank._banks)())
        (path,) = cache_folder.iterdir()
        path.unlink()
        with monkeypatch.context() as patch:
            patch.setattr(bank, "_is_bank", lambda shape: lambda sets: True)
            patch.setattr(Counted, "_make_bank", lambda self, shape, progress, wrong=wrong: wrong)
            Counted(4)._sets(10)
        monkeypatch.setattr(bank, "_banks", type(bank._banks)())
        np.testing.assert_array_equal(fill(Counted(4)), before)


def test_where_nothing_can_be_written_the_bank_lives_in_memory(cache_folder, monkeypatch):
    expected = fill(Counted(4))
    (cache_folder.parent / "file").write_text("in the way")
    monkeypatch.setenv("SAMPLEKIT_CACHE", str(cache_folder.parent / "file" / "below"))
    monkeypatch.setattr(bank, "_banks", type(bank._banks)())
    sampler = Counted(4)
    np.testing.assert_array_equal(fill(sampler), expected)
    fill(sampler)
    assert len(sampler.made) == 4


def test_threads_that_ask_at_once_make_it_once(cache_folder):
    sampler = Counted(6)
    with ThreadPoolExecutor(8) as pool:
        results = list(pool.map(lambda _: fill(sampler), range(16)))
    assert len(sampler.made) == 6
    assert all(np.array_equal(result, results[0]) for result in results)


@pytest.mark.slow
def test_processes_that_ask_at_once_agree(cache_folder):
    script = "import samplekit; print(samplekit.points('ccvt:bank=8', 40, 2, realizations=5).tobytes().hex())"
    processes = [
        subprocess.Popen([sys.executable, "-c", script], env=os.environ.copy(), stdout=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    outputs = {process.communicate(timeout=120)[0].strip() for process in processes}
    assert outputs == {samplekit.points("ccvt:bank=8", 40, 2, realizations=5).tobytes().hex()}
    assert [path.suffix for path in cache_folder.iterdir()] == [".npy"]


def test_an_interrupted_bank_is_made_at_the_next_try(cache_folder):
    class Interrupted(Counted):
        def make(self, sets, realizations):
            if len(self.made) == 2:
                self.made.append(0)
                raise KeyboardInterrupt
            super().make(sets, realizations)

    sampler = Interrupted(5)
    with pytest.raises(KeyboardInterrupt):
        fill(sampler)
    np.testing.assert_array_equal(fill(sampler), fill(Counted(5)))


def test_preparing_reports_its_progress_and_changes_no_point(cache_folder):
    steps = []
    sampler = samplekit.sampler("lloyd:bank=6")
    sampler.prepare(12, 2, lambda done, of: steps.append((done, of)))
    assert steps == [(done, 6) for done in range(7)]
    samplekit.sampler("poisson-disk").prepare(12, 2, lambda *_: pytest.fail("nothing to prepare"))


def test_notes_say_that_sets_are_shared():
    assert samplekit.sampler("ccvt").notes(16, 2) == ["one of 64 sets of 16 points, under a random shift and symmetry"]
    assert samplekit.sampler("lloyd").notes(2**18, 2)[0].startswith("one of 4 sets of 262144 points")
    assert samplekit.sampler("poisson-disk").notes(16, 2) == []


@pytest.mark.parametrize("text", ["ccvt", "lloyd:steps=3", "poisson-disk:bank=9"])
def test_fresh_sets_come_from_no_bank(text, cache_folder):
    fresh = samplekit.sampler(text).fresh()
    assert fresh.notes(16, 2) == []
    fresh.points(4, 2)
    assert not cache_folder.exists()


def test_few_banks_stay_in_memory(cache_folder):
    sampler = Counted(1)
    for count in range(1, 9):
        fill(sampler, count=count)
    assert len(bank._banks) == 4
