"""Files that other programs read and write: UTK's text and binary, plain CSV; and everything read back."""

import struct

import numpy as np
import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._pointsets.formats import read_points, write_points
from samplekit.files._pointsets.text import parse_points

SETS = np.random.default_rng(5).random((3, 7, 2))
SETS[0, 0] = [0.0, np.nextafter(1.0, 0.0)]
SETS[1, 2] = [5e-324, 1e-300]


def write(path, points):
    write_points(points, path)
    return path


@pytest.mark.parametrize("ending", [".csv", ".npy", ".dat", ".bin", ".CSV", ".DAT"])
@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 7, 2), (3, 7, 2), (3, 5, 1), (2, 1, 4)])
def test_every_bit_comes_back(tmp_path, ending, shape):
    points = np.resize(SETS, shape)
    assert np.array_equal(read_points(write(tmp_path / f"points{ending}", points)), points)


@pytest.mark.parametrize("shape", [(1, 1, 1), (1, 7, 2), (1, 5, 1)])
def test_coordinates_alone_come_back(tmp_path, shape):
    points = np.resize(SETS, shape)
    path = write(tmp_path / "a.plain.csv", points)
    assert np.array_equal(read_points(path), points)
    assert np.array_equal(np.loadtxt(path, delimiter=",").reshape(shape), points)


def test_more_points_than_a_piece_come_back(tmp_path):
    points = np.random.default_rng(6).random((2, 20_000, 2))
    for ending in (".csv", ".dat"):
        assert np.array_equal(read_points(write(tmp_path / f"a{ending}", points)), points)
    plain = write(tmp_path / "a.plain.csv", points[:1])
    assert np.array_equal(read_points(plain), points[:1])


def test_text_is_as_utk_has_it(tmp_path):
    points = np.array([[[0.25, 0.5], [0.0, 0.125]], [[0.75, 0.5], [1e-05, 0.1]]])
    assert write(tmp_path / "a.dat", points).read_text() == "0.25 0.5\n0.0 0.125\n#\n0.75 0.5\n1e-05 0.1\n"


def test_binary_is_as_utk_has_it(tmp_path):
    points = np.array([[[0.25, 0.5]], [[0.75, 0.125]]])
    data = write(tmp_path / "a.bin", points).read_bytes()
    assert data[:20] == bytes.fromhex("55544b21 05000000 02000000 01000000 02000000")
    assert struct.unpack("<4d", data[20:]) == (0.25, 0.5, 0.75, 0.125)


def test_coordinates_alone_are_as_samplin_safari_has_them(tmp_path):
    points = np.array([[[0.25, 0.5, 0.0], [0.75, 0.125, 0.1]]])
    assert write(tmp_path / "a.plain.csv", points).read_text() == "0.25,0.5,0.0\n0.75,0.125,0.1\n"
    with pytest.raises(UsageError, match=r"\.plain\.csv holds one realisation, not 3: write \.csv, \.npy, \.dat or"):
        write(tmp_path / "b.plain.csv", SETS)
    assert [path.name for path in tmp_path.iterdir()] == ["a.plain.csv"]


def test_single_precision_of_utk_is_read(tmp_path):
    path = tmp_path / "a.bin"
    path.write_bytes(b"UTK!" + struct.pack("<4B3I2f", 4, 0, 0, 0, 1, 1, 2, 0.5, 0.1))
    assert read_points(path).tolist() == [[[0.5, float(np.float32(0.1))]]]


@pytest.mark.parametrize(
    ("text", "points"),
    [
        ("0.5 0.25\n0.1 0.2", [[[0.5, 0.25], [0.1, 0.2]]]),
        ("0.5, 0.25\r\n0.1, 0.2\r\n", [[[0.5, 0.25], [0.1, 0.2]]]),
        ("  0.5\t0.25 \n\n 1e-1 .2\n\n", [[[0.5, 0.25], [0.1, 0.2]]]),
        ("x,y\n0.5,0.25\n", [[[0.5, 0.25]]]),
        ("x y\n0.5 0.25\n", [[[0.5, 0.25]]]),
        ("# by hand\n#\n0.5 0.25\n#\n0.1 0.2\n#\n", [[[0.5, 0.25]], [[0.1, 0.2]]]),
        ("0.5\n0.25\n", [[[0.5], [0.25]]]),
        ("realisation,index,x0\n0,0,0.5\n0,1,0.25\n1,0,0.1\n1,1,0.2", [[[0.5], [0.25]], [[0.1], [0.2]]]),
        ("realisation,index,x0\n3,0,0.5\n3,1,0.25\n", [[[0.5], [0.25]]]),
        ("\ufeff0.5 0.25\n".lstrip("\ufeff"), [[[0.5, 0.25]]]),
    ],
)
def test_text_of_many_kinds(text, points):
    assert parse_points(text).tolist() == points


def test_a_byte_order_mark_is_no_number(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("0.5,0.25\n", encoding="utf-8-sig")
    assert read_points(path).tolist() == [[[0.5, 0.25]]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no points"),
        ("\n#\n\n", "no points"),
        ("x,y\n", "no points"),
        ("0.5 0.25\n0.1\n", "line 2 has 1 numbers, the lines before it have 2"),
        ("x,y,z\n0.5,0.25\n", "line 2 has 2 numbers, the lines before it have 3"),
        ("0.5 0.25\n0.1 abc\n", "line 2: expected numbers .* found '0.1 abc'"),
        ("0.5 abc\n", "line 1: expected numbers"),
        ("0.5;0.25\n0.1;0.2\n", "line 2: expected numbers"),
        ("0.5,,0.25\n", "line 1: expected numbers"),
        ("0.5,0.25,\n", "line 1: expected numbers"),
        ("1_0 0.25\n", "line 1: expected numbers"),
        ("x\n" + "y" * 500, r"line 2: .* found 'y{30}\.\.\.'"),
        ("0.1 0.2\n0.3 0.4\n#\n0.5 0.6\n", "set 1, before line 5, has 1 points, set 0 has 2"),
        ("realisation,index,x0\n0,0,0.5\n0,2,0.25\n", "line 3: index 2 where 1 was expected"),
        ("realisation,index,x0\n0,0,0.5\n0,0,0.25\n", "line 3: index 0 where 1 was expected"),
        ("realisation,index,x0\n0,0,0.5\n0,1,0.25\n1,0,0.5\n", "set 1, before line 5, has 1 points, set 0 has 2"),
    ],
)
def test_text_that_is_no_point_set_names_the_line(text, message):
    with pytest.raises(UsageError, match=message):
        parse_points(text)


def npy(tmp_path, array, **options):
    path = tmp_path / "a.npy"
    np.save(path, array, **options)
    return path


@pytest.mark.parametrize(
    ("array", "message"),
    [
        (np.zeros((2, 2, 2, 2)), r"shape \[2, 2, 2, 2\]: expected \[points, dimensions\]"),
        (np.zeros(4), r"shape \[4\]"),
        (np.zeros(()), r"shape \[\]"),
        (np.zeros((0, 2)), "no points"),
        (np.zeros((2, 2), int), "holds int64: expected floating-point"),
        (np.zeros((2, 2), complex), "holds complex128"),
        (np.zeros((2, 2), [("x", float)]), "expected floating-point"),
    ],
)
def test_arrays_of_other_kinds_are_refused(tmp_path, array, message):
    with pytest.raises(UsageError, match=message):
        read_points(npy(tmp_path, array))


@pytest.mark.parametrize("dtype", ["<f8", ">f8", "<f4", "<f2"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_arrays_of_any_float_and_order(tmp_path, dtype, order):
    array = np.asarray(np.arange(12).reshape(2, 3, 2) / 16, dtype, order=order)
    points = read_points(npy(tmp_path, array))
    assert points.dtype == np.float64
    assert points.flags.c_contiguous
    assert np.array_equal(points, array)
    assert np.array_equal(read_points(npy(tmp_path, array[0])), array[:1])


class Bomb:
    def __reduce__(self):
        return pytest.fail, ("a pickle was loaded",)


def test_pickles_are_never_loaded(tmp_path):
    with pytest.raises(UsageError, match="Python objects"):
        read_points(npy(tmp_path, np.array([[Bomb()]], dtype=object), allow_pickle=True))


def test_damaged_arrays(tmp_path):
    path = npy(tmp_path, np.zeros((4, 2)))
    whole = path.read_bytes()
    for length in [*range(0, 130, 7), len(whole) - 1]:
        path.write_bytes(whole[:length])
        with pytest.raises(SamplekitError, match=r"damaged|no array file"):
            read_points(path)
    path.write_bytes(whole + b"x")
    with pytest.raises(SamplekitError, match="damaged: its numbers take 64 bytes, and it has 65"):
        read_points(path)
    for old, new in [(b"(4, 2)", b"(4,-2)"), (b"(4, 2)", b"(9**9)"), (b"<f8", b"<zz"), (b"'descr'", b"'desc\xff'")]:
        path.write_bytes(whole.replace(old, new))
        with pytest.raises(SamplekitError, match=r"damaged|no points"):
            read_points(path)
    path.write_bytes(whole.replace(b"(4, 2), }  ", b"(4, 2**60)}"))
    with pytest.raises(SamplekitError):
        read_points(path)


def test_damaged_binaries(tmp_path):
    path = write(tmp_path / "a.bin", SETS)
    whole = path.read_bytes()
    for data, message in [
        (b"", "no binary file of UTK"),
        (b"UTK", "no binary file of UTK"),
        (whole[:19], "ends within its header"),
        (whole[:-1], "damaged: 3 x 7 x 2 numbers take 356 bytes, and it has 355"),
        (whole + b"x", "and it has 357"),
        (whole[:4] + b"\x09" + whole[5:], "9 is no type of number"),
        (whole[:4] + b"\x01" + whole[5:], "integers"),
        (whole[:8] + b"\xff" * 12 + whole[20:], "damaged"),
        (whole[:8] + b"\x00" * 12, "no points"),
    ]:
        path.write_bytes(data)
        with pytest.raises(SamplekitError, match=message):
            read_points(path)


@pytest.mark.parametrize("value", [1.0, -0.1, np.nan, np.inf, -np.inf, 2.0])
@pytest.mark.parametrize("ending", ["npy", "bin", "csv", "dat"])
def test_values_outside_are_named(tmp_path, ending, value):
    points = SETS.copy()
    points[1, 2, 1] = value
    path = write(tmp_path / f"a.{ending}", points)
    with pytest.raises(UsageError, match=r"set 1, point 2, dimension 1 is .*: expected values in \[0, 1\)"):
        read_points(path)


@pytest.mark.parametrize(
    "name", ["none.npy", "none.bin", "none.csv", "folder", "folder.npy", "a.png", "a.svg", "\0.csv"]
)
def test_what_is_no_such_file_is_one_clear_line(tmp_path, name):
    path = tmp_path / name
    if "folder" in name:
        path.mkdir()
    elif name[0] == "a":
        path.write_bytes(b"\x89PNG\r\n\x1a\n")
    with pytest.raises(UsageError, match=r"cannot read .*: ") as error:
        read_points(path)
    assert "\n" not in str(error.value)


def test_other_bytes_are_no_text(tmp_path):
    path = tmp_path / "a.dat"
    path.write_bytes(b"\x89PNG\r\n\x1a\n")
    with pytest.raises(UsageError, match="no text"):
        read_points(path)
    path.write_bytes(b"\x00\x01\x02\n0.5 0.5\n")
    with pytest.raises(UsageError, match="line 2"):
        read_points(path)
