import numpy as np

from samplekit.files._pointsets.npy import npy_writer


def test_every_bit_comes_back(tmp_path):
    points = np.random.default_rng(1).random((3, 5, 2))
    points[0, 0] = [-0.0, 5e-324]
    path = tmp_path / "points.npy"
    npy_writer(points)(path)
    read = np.load(path, allow_pickle=False)
    assert read.dtype == np.float64
    assert read.shape == (3, 5, 2)
    assert np.array_equal(read.view(np.uint64), points.view(np.uint64))


def test_an_array_in_any_order_is_written_in_one(tmp_path):
    points = np.random.default_rng(2).random((2, 3, 5))
    npy_writer(points.transpose(0, 2, 1))(tmp_path / "a.npy")
    npy_writer(np.ascontiguousarray(points.transpose(0, 2, 1)))(tmp_path / "b.npy")
    assert (tmp_path / "a.npy").read_bytes() == (tmp_path / "b.npy").read_bytes()
