import pickle
from collections import Counter
from math import gcd

import numpy as np
import pytest

import samplekit
from samplekit import Exactly
from samplekit._bases.realizations import Realizations
from samplekit._builtin.samplers.point_file import row_step
from samplekit._errors import SamplekitError, UsageError
from samplekit.files._pointsets.formats import write_points

SETS = np.random.default_rng(8).random((5, 12, 3))


@pytest.fixture
def chosen(tmp_path):
    """Writes sets and gives the sampler of the file."""

    def choose(points=SETS, name="points.npy", suffix=""):
        write_points(points, tmp_path / name)
        return samplekit.sampler(f"file:path={tmp_path / name}{suffix}")

    return choose


@pytest.mark.parametrize("name", ["a.npy", "a.csv", "a.dat", "a.bin"])
def test_realisations_are_the_sets_of_the_file_over_and_over(chosen, name):
    points = chosen(name=name).points(12, 3, realizations=12)
    assert np.array_equal(points, SETS[np.arange(12) % 5])


def test_points_of_a_sampler_are_the_same_from_a_file(chosen):
    points = samplekit.points("sobol+owen", count=64, realizations=16, seed=3)
    assert np.array_equal(chosen(points).points(64, realizations=16), points)


def test_a_seed_is_the_set_that_comes_first(chosen):
    sampler = chosen()
    for seed in (1, 4, 5, 2**64 - 1):
        assert np.array_equal(sampler.points(12, 3, seed=seed)[0], SETS[seed % 5])


def test_slices_of_a_file(chosen):
    assert np.array_equal(chosen().points(12, 3, realizations=6, start=3, stop=7), SETS[np.arange(6) % 5, 3:7])


@pytest.mark.parametrize("sets", [1, 2, 3, 4, 6, 16, 100, 4096])
def test_every_set_is_taken_as_often_in_rows_and_in_columns(sets):
    step = row_step(sets)
    assert 1 <= step <= sets
    assert gcd(step, sets) == 1
    assert Counter(np.arange(sets) * step % sets) == Counter(range(sets))


def test_pixels_take_sets_by_their_place_wherever_they_are(chosen):
    sampler = chosen()
    x, y = np.array([0, 4, 2**32 - 1, 7, 3]), np.array([0, 9, 2**32 - 1, 0, 2**31])
    out = np.empty((5, 3, 12))
    sampler.fill(out, Realizations.of_pixels(x, y, 2), 12, 0)
    expected = [(int(a) + row_step(5) * int(b) + 2) % 5 for a, b in zip(x, y, strict=True)]
    assert np.array_equal(out, SETS[expected].transpose(0, 2, 1))


def test_the_declaration_says_what_is_in_the_file(chosen):
    several = chosen().spec
    assert (several.dimensions, several.counts, several.randomized, several.period) == ((3, 3), Exactly(12), True, 5)
    one = chosen(SETS[:1]).spec
    assert (one.dimensions, one.counts, one.randomized, one.period) == ((3, 3), Exactly(12), False, None)
    assert not several.unbiased
    shifted = chosen(suffix="+shift").spec
    assert shifted.randomized
    assert shifted.unbiased
    assert shifted.period is None


def test_other_numbers_than_the_file_has_are_refused(chosen):
    sampler = chosen()
    with pytest.raises(UsageError, match=r"points\.npy makes exactly 12 points, not 16"):
        sampler.check(16, 3)
    with pytest.raises(UsageError, match=r"points\.npy makes points in 3 dimensions, not 2"):
        sampler.check(12, 2)
    with pytest.raises(UsageError, match="5 sets of 12 points in 3 dimensions, not 4 points in 3"):
        sampler.fill(np.empty((1, 3, 4)), sampler.trials(0, 1, 0), 4, 0)


def test_notes_say_what_is_taken(chosen):
    notes = chosen().notes(12, 3)
    assert notes[0].startswith("points from a file: 5 sets of 12 points in 3 dimensions, sha256 of the numbers ")
    assert notes[1] == "pixel (x, y) takes set (x + 3 y + seed) modulo 5"
    assert chosen(SETS[:1]).notes(12, 3)[1] == "every pixel has the same points"
    assert chosen(name="b.csv").notes(12, 3)[0] == notes[0]


def test_a_shift_makes_sets_of_one_file_differ(chosen):
    points = chosen(SETS[:1], suffix="+shift").points(12, 3, realizations=4)
    assert np.unique(points[:, 0, 0]).size == 4


def test_files_can_be_rendered_with(chosen):
    points = samplekit.points("correlated-multi-jittered", count=16, realizations=64)
    result = samplekit.render("disk", chosen(points), spp=16, size=(32, 32))
    assert result.metrics["rmse"] < samplekit.render("disk", "random", spp=16, size=(32, 32)).metrics["rmse"]


def test_a_sampler_of_a_file_pickles(chosen):
    sampler = chosen()
    copy = pickle.loads(pickle.dumps(sampler))
    assert copy.text == sampler.text
    assert np.array_equal(copy.points(12, 3, realizations=2), sampler.points(12, 3, realizations=2))


def test_the_path_must_be_given():
    with pytest.raises(UsageError, match=r"file needs the option path .*: write file:path=PATH"):
        samplekit.sampler("file")
    with pytest.raises(UsageError, match="found 'path='"):
        samplekit.sampler("file:path=")


@pytest.mark.parametrize("name", ["a,b.npy", "a+b.npy", " a.npy", "a.npy ", "", "a,path=b.npy"])
def test_a_path_that_the_command_line_cannot_say_is_refused(name):
    with pytest.raises(UsageError, match="a comma ends a value and a plus sign before a letter begins a randomizer"):
        samplekit.sampler("file", path=name)


def test_what_the_command_line_makes_of_such_paths():
    with pytest.raises(UsageError, match=r"found 'b\.npy': a comma ends a value"):
        samplekit.sampler("file:path=a,b.npy")
    with pytest.raises(UsageError, match="a plus sign before a letter ends a value"):
        samplekit.sampler("file:path=a+b.npy")


@pytest.mark.parametrize("name", ["a=b.npy", "a+1.npy", "a b.npy", "ä.npy"])
def test_other_letters_are_no_matter(chosen, name):
    sampler = chosen(name=name)
    assert samplekit.sampler(sampler.text).text == sampler.text
    assert sampler.points(12, 3).shape == (1, 12, 3)


def test_files_that_cannot_be_used_are_one_line(tmp_path):
    for name, message in [("none.npy", "No such file"), (".", "folder")]:
        with pytest.raises(UsageError, match=f"cannot read .*{message}"):
            samplekit.sampler("file", path=str(tmp_path / name))
    (tmp_path / "a.npy").write_bytes(b"\x93NUMPY\x01\x00")
    with pytest.raises(SamplekitError, match=r"cannot read .*a\.npy: it is damaged") as error:
        samplekit.sampler("file", path=str(tmp_path / "a.npy"))
    assert not isinstance(error.value, UsageError)
