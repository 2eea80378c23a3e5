"""How a study is carried out, and what its results are to say."""

from __future__ import annotations

import math
from dataclasses import dataclass

from samplekit._checks import check_positive
from samplekit._errors import UsageError
from samplekit._threads import check_threads


@dataclass(frozen=True)
class ExecutionOptions:
    """How a study is carried out and what its results are to say. No error depends on it.

    Attributes
    ----------
    threads, processes
        How many of them share the jobs; more than one process takes the place of threads.
    dask
        Address of a Dask scheduler whose workers do the jobs instead.
    times
        Measure run times.
    budget
        Seconds for run times; None: a tenth of what the errors take, and at least one.
    cost
        Extra cost per sample, in nanoseconds, as if a renderer shaded it.
    target
        Target mean squared error for the time-to-target table; None: one for each scene that all samplers reach.
    fitted
        First and last count that fits use; None: all.
    """

    threads: int | None = None
    processes: int = 1
    dask: str | None = None
    times: bool = True
    budget: float | None = None
    cost: float = 0.0
    target: float | None = None
    fitted: tuple[int, int] | None = None

    def check(self) -> None:
        """Raise :class:`UsageError` unless the numbers can be meant."""
        check_threads(self.threads)
        check_positive("processes", self.processes)
        if self.processes > 1 and self.dask is not None:
            raise UsageError("--processes and --dask: the cluster's workers are its own: leave one out")
        if self.budget is not None and not (math.isfinite(self.budget) and self.budget >= 0.0):
            raise UsageError(f"budget {self.budget}: expected seconds, at least 0")
        if not (math.isfinite(self.cost) and self.cost >= 0.0):
            raise UsageError(f"cost {self.cost}: expected nanoseconds for each sample, at least 0")
        if self.target is not None and not (math.isfinite(self.target) and self.target > 0.0):
            raise UsageError(f"target {self.target}: expected a mean squared error above 0")
        if self.fitted is not None and not 1 <= self.fitted[0] <= self.fitted[1]:
            raise UsageError(f"fit {self.fitted[0]}..{self.fitted[1]}: expected a rising range of counts")
