import numpy as np
import pytest
from samplekit_bluenoise import bank

from samplekit.files import _cache as cache


@pytest.fixture(scope="session", autouse=True)
def shared_cache(tmp_path_factory):
    """A cache of this run's own; banks are made once for all tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(cache.VARIABLE, str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture
def cache_folder(tmp_path, monkeypatch):
    """An empty cache, on disk and in memory."""
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setattr(bank, "_banks", type(bank._banks)())
    return tmp_path / "cache"


@pytest.fixture(scope="session")
def spectrum():
    """Mean of N |S(m)|^2 over realisations, for integer frequencies m from -F to F: index m + F along x and y."""

    def mean_power(points, largest):
        frequencies = np.arange(-largest, largest + 1)
        total = np.zeros((frequencies.size, frequencies.size))
        for x, y in points.transpose(0, 2, 1):
            along_x = np.exp(-2j * np.pi * np.outer(frequencies, x))
            along_y = np.exp(-2j * np.pi * np.outer(frequencies, y))
            # Not by a matrix product: its threads would wait for one another on a busy machine.
            total += np.abs(np.einsum("ik,jk->ij", along_x, along_y, optimize=False) / x.size) ** 2
        return total * points.shape[1] / points.shape[0]

    return mean_power


@pytest.fixture(scope="session")
def radial():
    """Means of a spectrum over rings k - 1/2 <= |m| < k + 1/2, from k = 0 to F."""

    def means(power):
        largest = power.shape[0] // 2
        m = np.arange(-largest, largest + 1)
        ring = np.rint(np.hypot(m[:, None], m)).astype(int)
        return np.array([power[ring == k].mean() for k in range(largest + 1)])

    return means
