import numpy as np
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._pointsets.formats import write_points

POINTS = np.random.default_rng(1).random((1, 16, 2))


def write(path, points=POINTS):
    write_points(points, path)
    return path.read_bytes()


@pytest.mark.parametrize("ending", ["csv", "plain.csv", "npy", "dat", "bin"])
def test_the_same_points_give_the_same_bytes_and_nothing_else_is_left(tmp_path, ending):
    assert write(tmp_path / f"a.{ending}") == write(tmp_path / f"b.{ending}")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"a.{ending}", f"b.{ending}"]


def test_numbers_come_back(tmp_path):
    points = np.random.default_rng(2).random((3, 4, 2))
    write(tmp_path / "points.npy", points)
    assert np.array_equal(np.load(tmp_path / "points.npy"), points)
    write(tmp_path / "points.csv", points)
    rows = np.loadtxt(tmp_path / "points.csv", delimiter=",", skiprows=1)
    assert np.array_equal(rows[:, 2:].reshape(points.shape), points)


def test_an_ending_in_capitals_is_the_same_format(tmp_path):
    assert write(tmp_path / "A.DAT") == write(tmp_path / "a.dat")
    assert write(tmp_path / "A.NPY") == write(tmp_path / "a.npy")


@pytest.mark.parametrize("name", ["points.jpg", "points", "points.png.gz", ".csv"])
def test_an_unknown_ending_names_those_there_are(tmp_path, name):
    with pytest.raises(UsageError, match=r"\.csv, \.plain\.csv, \.npy, \.dat, \.bin, \.svg, \.png or \.pdf"):
        write(tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_pictures_are_drawn_elsewhere_and_take_one_realisation(tmp_path, ending):
    with pytest.raises(UsageError, match="one realisation, not 2"):
        write(tmp_path / f"a.{ending}", np.zeros((2, 4, 2)))
    with pytest.raises(UsageError, match=r"samplekit\.plots\.PointsDisplay"):
        write(tmp_path / f"a.{ending}", np.zeros((1, 4, 2)))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("shape", [(4, 2), (0, 4, 2), (1, 0, 2), (1, 4, 0)])
def test_other_shapes_are_refused(tmp_path, shape):
    with pytest.raises(UsageError, match="shape"):
        write(tmp_path / "a.csv", np.zeros(shape))


def test_a_failure_half_way_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_text("old")

    def failing(*_):
        yield "new, "
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("samplekit.files._pointsets.formats.csv_text", failing)
    with pytest.raises(SamplekitError, match="No space left"):
        write(path)
    assert path.read_text() == "old"
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


def test_an_interrupt_leaves_the_old_file(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")

    def interrupt(_done, _total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_points(POINTS, path, progress=interrupt)
    assert path.read_text() == "old"
    assert [each.name for each in tmp_path.iterdir()] == ["a.csv"]


def test_no_such_folder(tmp_path):
    with pytest.raises(UsageError, match="does not exist"):
        write(tmp_path / "missing" / "a.csv")
