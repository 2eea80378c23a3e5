"""Carry out jobs on the workers of a Dask cluster, given the address of its scheduler."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

from samplekit._errors import SamplekitError, UsageError
from samplekit._provenance import versions
from samplekit._study.trials import Array, carry_out

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from samplekit._study.jobs import Job
    from samplekit._study.processes import JobResults

_AHEAD = 3
"""Jobs for each thread that are handed out at a time."""
_PATIENCE = 20.0
"""Seconds to wait for the scheduler, and for a first worker."""


def connect(address: str) -> Any:
    """Return a client of the Dask scheduler at an address such as ``tcp://host:8786``; the caller closes it.

    Raises
    ------
    UsageError
        The extra ``dask`` is not installed, or there is no scheduler or no worker at the address.
    """
    try:
        from distributed import Client
    except ImportError:
        raise UsageError("--dask needs the package distributed: pip install 'samplekit-core[dask]'") from None
    try:
        client = Client(address, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise UsageError(f"no Dask scheduler answers at {address}: {' '.join(str(error).split())}") from None
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except Exception as error:
        client.close()
        raise UsageError(f"the Dask scheduler at {address} has no workers: {error}") from None
    return client


def count_threads(client: Any) -> int:
    """Return the number of threads of all workers together."""
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    return sum(int(worker["nthreads"]) for worker in workers) or 1


def on_cluster(client: Any, parts: Iterable[Sequence[Job]], tick: Callable[[int], None]) -> JobResults:
    """Carry out jobs, and yield each with its sums in the order in which they end.

    If a worker dies, other workers repeat its jobs.

    Parameters
    ----------
    client, parts
        What :func:`connect` returned, and the jobs to carry out, part after part.
    tick
        Called with the number of samples of each job that ends.

    Raises
    ------
    SamplekitError
        A job fails, a worker has other versions, or workers keep dying of a job.
    """
    for jobs in parts:
        yield from _on_cluster(client, jobs, tick)


def _on_cluster(client: Any, jobs: Sequence[Job], tick: Callable[[int], None]) -> JobResults:
    from distributed import KilledWorker, as_completed

    expected = versions()
    waiting = iter(jobs)

    def submit(job: Job) -> Any:
        return client.submit(_carry_out_there, job, expected, pure=False)

    running = {submit(job): job for job in itertools.islice(waiting, _AHEAD * count_threads(client))}
    try:
        finished = as_completed(list(running), loop=client.loop)
        for future in finished:
            job = running.pop(future)
            try:
                sums = future.result()
            except KilledWorker:
                raise SamplekitError(
                    f"workers keep dying of {job.sampler} with {job.counts[-1]} samples on {job.scene}:"
                    " out of memory? With --output, --resume continues from what was done"
                ) from None
            except OSError as error:
                raise SamplekitError(f"the Dask cluster was lost: {' '.join(str(error).split())}") from None
            for following in itertools.islice(waiting, 1):
                running[submit(following)] = following
                finished.add(next(reversed(running)))
            tick(job.samples)
            yield job, sums
    finally:
        client.cancel(list(running))


def _carry_out_there(job: Job, expected: dict[str, str]) -> Array:
    # Checked with each job, since workers may join at any time.
    found = versions()
    for name, version in expected.items():
        if found.get(name) != version:
            raise SamplekitError(f"a Dask worker has {name} {found.get(name)}, this is {version}: results would differ")
    return carry_out(job)
