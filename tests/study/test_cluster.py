"""A real Dask cluster of two processes on this machine: the same errors, also when one of them dies."""

import os
import signal
import threading
import warnings

import pytest

import samplekit
from samplekit._errors import UsageError

pytestmark = pytest.mark.slow

ASK = (["random", "sobol+owen"], ["disk"], [16, 256])


@pytest.fixture(scope="module")
def cluster():
    with warnings.catch_warnings():
        # Dask's own affairs (ports that are taken, sockets that are closed late) are not what is tested.
        warnings.simplefilter("ignore")
        from distributed import LocalCluster

        with LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, memory_limit=0, silence_logs=50
        ) as made:
            yield made


@pytest.mark.filterwarnings("ignore")
def test_errors_are_those_of_one_machine_also_when_a_worker_dies(cluster):
    pids = [worker.pid for worker in cluster.workers.values()]
    seen = []

    def kill_one(what, done, total):
        if what == "computing errors" and not seen:
            seen.append(done / total)
            threading.Thread(target=os.kill, args=(pids[0], signal.SIGTERM)).start()

    ask = {"trials": 40_000, "size": (1, 1), "times": False}
    spread = samplekit.compare(*ASK, **ask, dask=cluster.scheduler_address, progress=kill_one)
    assert seen
    assert seen[0] < 0.9
    assert spread.workers.startswith("Dask at tcp://")
    assert spread.rows == samplekit.compare(*ASK, **ask, threads=1).rows


@pytest.mark.filterwarnings("ignore")
def test_no_scheduler(monkeypatch):
    from samplekit._study import cluster

    monkeypatch.setattr(cluster, "_PATIENCE", 0.5)
    with pytest.raises(UsageError, match="no Dask scheduler answers at"):
        samplekit.compare(*ASK, trials=2, size=(1, 1), dask="tcp://127.0.0.1:1")
