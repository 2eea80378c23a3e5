"""The request for a study, which decides all errors, and its options, which change none of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from samplekit._arguments import check_positive, check_samples
from samplekit._bases.realizations import check_seed
from samplekit._errors import UsageError
from samplekit._memory import check_memory
from samplekit._threads import check_threads

if TYPE_CHECKING:
    from collections.abc import Sequence

UNIT_SQUARE = (1, 1)
"""The size of a study that takes the unit square as one pixel."""
_MOST_TRIALS = 2**24
_BYTES_PER_PIXEL = 16 * 8


@dataclass(frozen=True)
class Request:
    """Everything that the errors of a study depend on.

    Attributes
    ----------
    scenes, samplers
        Texts as on the command line, in the form that the declarations write; each occurs once.
    counts
        Numbers of samples per pixel, in rising order.
    trials
        Number of independent realisations.
    size
        Width and height in pixels; (1, 1) stands for the unit square as one pixel.
    seed
        Seed of the first trial.
    """

    scenes: tuple[str, ...]
    samplers: tuple[str, ...]
    counts: tuple[int, ...]
    trials: int
    size: tuple[int, int]
    seed: int

    @property
    def one_pixel(self) -> bool:
        """True if the unit square is one pixel."""
        return self.size == UNIT_SQUARE

    def command(self, *more: str) -> str:
        """Return the command that makes the study, followed by the options ``more``."""
        words = ["samplekit compare"]
        words += [f"--scene {scene}" for scene in self.scenes]
        words += [f"--sampler {sampler}" for sampler in self.samplers]
        words.append("--spp " + ",".join(str(count) for count in self.counts))
        words.append(f"--trials {self.trials} --size {self.size[0]}x{self.size[1]} --seed {self.seed}")
        return " ".join([*words, *more])


def checked_request(
    scenes: Sequence[str],
    samplers: Sequence[str],
    counts: Sequence[int],
    trials: int,
    size: tuple[int, int],
    seed: int,
) -> Request:
    """Check the parts of a request and put them together; the parameters are the attributes of :class:`Request`.

    Raises
    ------
    UsageError
        There is nothing to compare, something is given twice, a number is out of range, or the images need more memory
        than is free.
    """
    for what, names in (("scene", scenes), ("sampler", samplers)):
        if not names:
            raise UsageError(f"no {what}: expected at least one --{what}")
        twice = next((name for name in names if list(names).count(name) > 1), None)
        if twice is not None:
            raise UsageError(f"{what} {twice} is given twice: give each {what} once")
    if not counts:
        raise UsageError("no counts: expected at least one, such as --spp 4,16,64")
    width, height = (check_positive("size", side) for side in size)
    request = Request(
        tuple(scenes),
        tuple(samplers),
        tuple(sorted({check_positive("spp", count) for count in counts})),
        check_positive("trials", trials),
        (width, height),
        check_seed(seed),
    )
    if request.trials > _MOST_TRIALS:
        raise UsageError(f"trials {trials}: at most {_MOST_TRIALS}")
    pixels = width * height
    check_samples(pixels, request.counts[-1], "a trial")
    check_memory(_BYTES_PER_PIXEL * pixels, f"images of {pixels} pixels", ": choose a smaller --size")
    return request


@dataclass(frozen=True)
class ExecutionOptions:
    """How a study is carried out and which answers it gives. No error depends on these options.

    Attributes
    ----------
    threads, processes
        Number of threads or processes that share the jobs; more than one process takes the place of threads.
    dask
        Address of a Dask scheduler whose workers carry out the jobs instead.
    times
        Whether run times are measured.
    budget
        Seconds of the processor for measuring run times; None: a tenth of the time that the errors take, and at least
        one second.
    cost
        Extra cost per sample, in nanoseconds, as if a renderer shaded it.
    target
        Target mean squared error for the time-to-target table; None: one for each scene that all samplers reach.
    fitted
        First and last count that slopes are fitted to; None: all counts.

    Raises
    ------
    UsageError
        An option is out of range, or two options exclude each other.
    """

    threads: int | None = None
    processes: int = 1
    dask: str | None = None
    times: bool = True
    budget: float | None = None
    cost: float = 0.0
    target: float | None = None
    fitted: tuple[int, int] | None = None

    def __post_init__(self) -> None:
        check_threads(self.threads)
        check_positive("processes", self.processes)
        if self.processes > 1 and self.dask is not None:
            raise UsageError("--processes and --dask: the cluster brings its own workers: leave one option out")
        if self.budget is not None and not (math.isfinite(self.budget) and self.budget >= 0.0):
            raise UsageError(f"budget {self.budget}: expected seconds, at least 0")
        if not (math.isfinite(self.cost) and self.cost >= 0.0):
            raise UsageError(f"cost {self.cost}: expected nanoseconds for each sample, at least 0")
        if self.target is not None and not (math.isfinite(self.target) and self.target > 0.0):
            raise UsageError(f"target {self.target}: expected a mean squared error above 0")
        if self.fitted is not None and not 1 <= self.fitted[0] <= self.fitted[1]:
            raise UsageError(f"fit {self.fitted[0]}..{self.fitted[1]}: expected a rising range of counts")

    def command_options(self) -> list[str]:
        """Return the options of the command that the answers depend on."""
        return [
            *([f"--cost {self.cost:g}"] if self.cost else []),
            *([f"--target {self.target:g}"] if self.target else []),
            *([f"--fit {self.fitted[0]}..{self.fitted[1]}"] if self.fitted else []),
        ]
