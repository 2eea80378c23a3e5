"""What all samplers of the plugin have in common, fresh or from a bank."""

import os
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import samplekit
from samplekit import UsageError

FRESH = [
    "poisson-disk",
    "poisson-disk:radius=0.76",
    "poisson-disk:radius=0",
    "poisson-disk:method=elimination",
    "lloyd:bank=0",
    "lloyd:bank=0,initial=jittered",
    "lloyd:bank=0,initial=random",
    "ccvt:bank=0,capacity=16",
]
SHARED = ["poisson-disk:bank=5", "poisson-disk:method=elimination,bank=5", "lloyd:bank=5", "ccvt:bank=5,capacity=16"]


def fill(text, realizations, count, start=0, stop=None):
    out = np.full((len(realizations), 2, (count if stop is None else stop) - start), np.nan)
    samplekit.sampler(text).fill(out, realizations, count, start)
    return out


@pytest.mark.parametrize("text", FRESH + SHARED)
@pytest.mark.parametrize("count", [1, 2, 3, 4, 20, 97])
def test_parts_orders_and_batches_do_not_matter(text, count):
    realizations = samplekit.sampler("random").trials(0, 9, 3)
    whole = fill(text, realizations, count)
    assert whole.min() >= 0.0
    assert whole.max() < 1.0
    for start, stop in ((0, 1), (count // 2, count), (count - 1, count)):
        if start < stop:
            np.testing.assert_array_equal(fill(text, realizations, count, start, stop), whole[:, :, start:stop])
    for row in (8, 0, 4):
        np.testing.assert_array_equal(fill(text, realizations[row : row + 1], count)[0], whole[row])
    assert len(np.unique(whole[:, 0])) == 9 * count


@pytest.mark.parametrize("text", FRESH + SHARED)
def test_threads_give_the_same_points(text):
    realizations = samplekit.sampler("random").trials(0, 40, 1)
    whole = fill(text, realizations, 50)
    with ThreadPoolExecutor(8) as pool:
        parts = list(pool.map(lambda row: fill(text, realizations[row : row + 1], 50), range(40)))
    np.testing.assert_array_equal(np.concatenate(parts), whole)


@pytest.mark.parametrize("text", FRESH + SHARED)
def test_another_seed_gives_other_points(text):
    one = fill(text, samplekit.sampler("random").trials(0, 3, 0), 30)
    other = fill(text, samplekit.sampler("random").trials(0, 3, 1), 30)
    assert not np.any(one == other)


@pytest.mark.parametrize("text", FRESH + SHARED)
def test_points_are_uniform_and_estimates_unbiased(text):
    """A chi-square of 36 cells over 1500 sets of 6 points, bounded at 6 standard deviations, and the mean of x y at 5.

    The points of a set repel, which lowers the chi-square. False alarm of a test below 1e-6.
    """
    points = fill(text, samplekit.sampler("random").trials(0, 1500, 12), 6).transpose(0, 2, 1).reshape(-1, 2)
    cells = np.bincount((points * 6).astype(int) @ [6, 1], minlength=36)
    expected = len(points) / 36
    assert ((cells - expected) ** 2 / expected).sum() < 35 + 6 * np.sqrt(70)
    assert abs(points.prod(axis=1).mean() - 0.25) < 5 * np.sqrt(1 / 9 - 1 / 16) / np.sqrt(1500)


def test_another_process_gives_the_same_points():
    texts = [*FRESH, *SHARED]
    script = (
        "import sys, samplekit\n"
        "for text in sys.argv[1:]:\n"
        "    print(samplekit.points(text, 33, 2, realizations=3, seed=8).tobytes().hex())"
    )
    environment = {**os.environ, "SAMPLEKIT_CACHE": "", "PYTHONHASHSEED": "7"}
    run = subprocess.run(
        [sys.executable, "-c", script, *texts], env=environment, capture_output=True, text=True, check=True, timeout=120
    )
    here = [samplekit.points(text, 33, 2, realizations=3, seed=8).tobytes().hex() for text in texts]
    assert run.stdout.split() == here


@pytest.mark.parametrize("name", ["poisson-disk", "lloyd", "ccvt"])
def test_two_dimensions_and_no_more(name):
    with pytest.raises(UsageError, match="2 dimensions, not 3"):
        samplekit.points(name, 16, 3)


@pytest.mark.parametrize(("name", "most"), [("poisson-disk", 2**20), ("lloyd", 2**20), ("ccvt", 2**16)])
def test_too_many_points_are_refused(name, most):
    with pytest.raises(UsageError, match=f"at most {most} points"):
        samplekit.points(name, most + 1, 2)


def test_samplers_can_be_pickled():
    from samplekit_bluenoise.lloyd import Lloyd

    sampler = pickle.loads(pickle.dumps(Lloyd(steps=1, initial="random", bank=2)))
    out = np.empty((1, 2, 5))
    sampler.fill(out, samplekit.sampler("random").trials(0, 1, 0), 5, 0)


def test_naming_the_samplers_imports_no_implementation():
    script = (
        "import sys, samplekit_bluenoise as plugin\n"
        "print([spec.name for spec in plugin.samplekit_samplers()], 'numpy' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, timeout=60)
    assert run.stdout.strip() == "['poisson-disk', 'lloyd', 'ccvt'] False"


def test_a_part_of_a_set_costs_the_whole():
    assert not samplekit.sampler("poisson-disk").streams
    assert not samplekit.sampler("ccvt").streams
