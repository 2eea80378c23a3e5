"""What a study is asked for: plain data, checked."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from samplekit._bases.realizations import check_seed
from samplekit._checks import check_positive, check_samples
from samplekit._errors import UsageError
from samplekit._memory import check_memory

if TYPE_CHECKING:
    from collections.abc import Sequence

UNIT_SQUARE = (1, 1)
"""The size of a study of the unit square as one pixel."""
_MOST_TRIALS = 2**24
_BYTES_PER_PIXEL = 16 * 8


@dataclass(frozen=True)
class Request:
    """All that errors depend on.

    Attributes
    ----------
    scenes, samplers
        As on the command line, in the form that their declarations write; none twice.
    counts
        Samples of a pixel, rising.
    trials
        Independent realisations.
    size
        Width and height in pixels; (1, 1): the unit square as one pixel.
    seed
        Of the first trial.
    """

    scenes: tuple[str, ...]
    samplers: tuple[str, ...]
    counts: tuple[int, ...]
    trials: int
    size: tuple[int, int]
    seed: int

    @property
    def one_pixel(self) -> bool:
        """Whether the unit square is one pixel."""
        return self.size == UNIT_SQUARE

    @property
    def pixels(self) -> int:
        """Number of pixels."""
        return self.size[0] * self.size[1]

    def plain(self) -> dict[str, Any]:
        """As JSON has it."""
        return {name: list(value) if isinstance(value, tuple) else value for name, value in asdict(self).items()}

    def command(self, *more: str) -> str:
        """The command that makes the study, with further options."""
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
    """The request, if it can be meant.

    Raises
    ------
    UsageError
        Nothing to compare, something twice, or numbers out of range.
    SamplekitError
        There is not the memory for such images.
    """
    for what, names in (("scene", scenes), ("sampler", samplers)):
        if not names:
            raise UsageError(f"no {what}: expected at least one --{what}")
        twice = next((name for name in names if list(names).count(name) > 1), None)
        if twice is not None:
            raise UsageError(f"{what} {twice} is given twice: each is compared once")
    if not counts:
        raise UsageError("no counts: expected at least one, such as --spp 4,16,64")
    width, height = (check_positive("size", side) for side in size)
    asked = Request(
        tuple(scenes),
        tuple(samplers),
        tuple(sorted({check_positive("spp", count) for count in counts})),
        check_positive("trials", trials),
        (width, height),
        check_seed(seed),
    )
    if asked.trials > _MOST_TRIALS:
        raise UsageError(f"trials {trials}: at most {_MOST_TRIALS}")
    check_samples(asked.pixels, asked.counts[-1], "a trial")
    check_memory(_BYTES_PER_PIXEL * asked.pixels, f"images of {asked.pixels} pixels", ": choose a smaller --size")
    return asked
