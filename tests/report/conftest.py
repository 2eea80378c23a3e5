from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

from samplekit._study.results import (
    Choice,
    Fit,
    Interval,
    LeftOut,
    Pictures,
    Results,
    Row,
    Seconds,
    Spread,
    Times,
)
from samplekit.files import parts_writer, write_group

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

SAMPLERS = ("random", "jittered", "sobol+owen", "poisson-disk")
# Exponent of the error, own seconds a sample. Poisson disk needs the fewest samples at first and takes the longest:
# it wins where samples are dear.
LAWS = {"random": (-1.0, 2e-9), "jittered": (-1.5, 5e-9), "sobol+owen": (-2.0, 2e-8), "poisson-disk": (-1.3, 1e-6)}


def law(sampler: str) -> tuple[float, float]:
    return LAWS.get(sampler, (-1.0 - 0.1 * (len(sampler) % 8), 1e-9 * len(sampler)))


def error_of(sampler: str, count: int) -> float:
    exponent, _ = law(sampler)
    return (0.01 if sampler == "poisson-disk" else 0.04) * count**exponent


def around(value: float, share: float) -> Interval:
    return Interval(value, value - abs(value) * share, value + abs(value) * share)


def clock(seconds: float) -> Seconds:
    spread = Spread(seconds, 0.9 * seconds, 1.2 * seconds)
    return Seconds(spread, spread)


def make_row(
    scene: str, sampler: str, count: int, size: tuple[int, int], pictures: Pictures | None, timed: bool = True
) -> Row:
    mse = error_of(sampler, count)
    pixels = size[0] * size[1]
    seconds = law(sampler)[1] * count * pixels
    spent = around(seconds, 0.02)
    times = None
    if timed:
        parts = clock(0.7 * seconds), clock(0.3 * seconds), clock(seconds)
        times = Times(*parts, 0.02, 0.03, laps=18, rounds=9, seconds=spent)
    return Row(
        scene=scene,
        sampler=sampler,
        count=count,
        asked=[count],
        replaced="",
        dims=2,
        samples=count * pixels,
        trials=8,
        shared_draw=False,
        no_interval="",
        mse=around(mse, 0.02),
        rmse=around(math.sqrt(mse), 0.1),
        bias=Interval(-0.01 * mse, -0.05 * mse, 0.03 * mse),
        variance=around(0.9 * mse, 0.2),
        squared_bias=Interval(0.1 * mse),
        blurred_mse=None if pictures is None else around(0.05 * mse, 0.3),
        efficiency=around(1 / (mse * seconds), 0.2) if timed else None,
        ratio=None,
        reference_error=0.0,
        reference_kind="exact",
        invalid_pixels=0,
        times=times,
        time=spent if timed else None,
        fitted=True,
        left_out="",
        notes=[],
        pictures=pictures,
    )


def make_study(
    scenes: Sequence[str] = ("disk", "gaussian"),
    samplers: Sequence[str] = SAMPLERS,
    counts: Sequence[int] = (4, 16, 64),
    size: tuple[int, int] = (1, 1),
    folder: Path | None = None,
    timed: bool = True,
) -> Results:
    """A study whose errors and times follow exact laws, with images of independent noise of that error."""
    rows = []
    for scene_index, scene in enumerate(scenes):
        across = np.linspace(0.0, 1.0, size[0]) + 0.0 * np.linspace(0.0, 1.0, size[1])[:, None]
        for sampler_index, sampler in enumerate(samplers):
            for count in counts:
                pictures = None
                if folder is not None:
                    stem = f"{scene_index}-{sampler_index}-{count}"
                    noise = np.random.default_rng([scene_index, sampler_index, count]).standard_normal(across.shape)
                    error = math.sqrt(error_of(sampler, count)) * noise
                    parts = {"image": across + error, "reference": across, "error": error}
                    write_group([(folder / f"{stem}.exr", parts_writer(parts, {}))])
                    pictures = Pictures(f"{stem}.exr", f"{stem}.png", f"{stem}.error.png", 1.0)
                rows.append(make_row(scene, sampler, count, size, pictures, timed))
    fits = [
        Fit(
            scene=scene,
            sampler=sampler,
            slope=around(law(sampler)[0], 0.03),
            constant=0.04,
            scatter=0.0,
            first=counts[0],
            last=counts[-1],
            counts=list(counts),
            left_out={},
            case="worst",
            theory=-1.0 if sampler == "random" else None,
        )
        for scene in scenes
        for sampler in samplers
    ]
    front = (
        [
            Choice(scene, [samplers[0]], 1e-6, 1e-4),
            Choice(scene, [samplers[-1]], 1e-4, None),
        ]
        if (scene := scenes[0])
        else []
    )
    return Results(
        command="samplekit compare --sampler random --scene disk",
        versions={"samplekit": "0.1.0", "python": "3.11"},
        machine={"system": "Linux", "processor": "a processor"},
        scenes=list(scenes),
        samplers=list(samplers),
        counts=list(counts),
        trials=8,
        size=size,
        seed=2**64 - 1,
        workers="1 thread",
        cost=0.0,
        target=dict.fromkeys(scenes, 1e-3),
        complete=True,
        rows=rows,
        fits=fits,
        to_target=[],
        front=front,
        flips=[],
        left_out=[LeftOut(scenes[0], "van-der-corput", None, "it has 1 dimension, not 2")],
        sentences=[f"{scenes[0]}: {samplers[-1]} is best from 0.1 ms on", "a sentence about everything"],
        notes=["a note on the method"],
    )


@pytest.fixture(scope="session")
def study() -> Callable[..., Results]:
    return make_study
