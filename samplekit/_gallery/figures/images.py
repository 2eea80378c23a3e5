"""Rendered scenes under several samplers, beside what they should be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit._gallery.figure import Figure
from samplekit._gallery.sheet import image_tile, rendering_tiles, sheet

if TYPE_CHECKING:
    from collections.abc import Sequence

    from samplekit._drawing.drawing import Drawing

CHAPTER = "Images"


def _beside(title: str, line: str, scene: str, samplers: Sequence[str], spp: int, size: int, enlarged: int) -> Drawing:
    """Images over their errors on one scale, and the reference at the end."""
    made = [samplekit.render(scene, name, spp, size=(size, size)) for name in samplers]
    first = made[0].metrics["mse"]
    scale = 3.0 * float(np.sqrt(first))
    tiles = []
    for name, result in zip(samplers, made, strict=True):
        mse = result.metrics["mse"]
        ratio = "" if result is made[0] else f"{mse / first:.3f} of {samplers[0]}'s"
        tiles.append(rendering_tiles(result, scale, name, f"mse {mse:.3g}", ratio, enlarged=enlarged))
    images, errors = zip(*tiles, strict=True)
    reference = made[0].reference
    assert reference is not None
    lines = [line, f"Below: the errors, blue -{scale:.2g}, white 0, red {scale:.2g}."]
    return sheet(title, lines, [[*images, image_tile(reference, "reference", enlarged=enlarged)], errors])


def random_and_jittered() -> Drawing:
    """The course's first comparison: 16 random and 16 jittered samples a pixel."""
    return _beside(
        "16 random and 16 jittered samples a pixel",
        "A checkerboard: all noise is along its edges.",
        "checker:cells=9",
        ("random", "jittered"),
        16,
        128,
        2,
    )


def depth_of_field() -> Drawing:
    """The course's figure of depth of field: random, uncorrelated jitter, and the reference."""
    return _beside(
        "Depth of field, 16 samples a pixel in four dimensions: place on the pixel, place on the lens",
        "Uncorrelated jitter stratifies pixel and lens apart; Owen-scrambled Sobol points stratify both together.",
        "depth-of-field",
        ("random", "uncorrelated-jitter", "sobol+owen"),
        16,
        240,
        1,
    )


def ambient_occlusion() -> Drawing:
    """The course's comparison on ambient occlusion: 96 rays into the sky from the middle of each pixel."""
    return _beside(
        "Ambient occlusion, 96 rays a pixel",
        "In the course's order: blue noise is best, then Poisson disk, then jitter.",
        "ambient-occlusion:pixel-filter=center",
        ("random", "jittered", "poisson-disk", "ccvt"),
        96,
        160,
        1,
    )


def motion_blur() -> Drawing:
    """Disks that move, through a lens: five dimensions."""
    return _beside(
        "Motion blur through a lens, 16 samples a pixel in five dimensions",
        "Place on the pixel, place on the lens, time.",
        "motion-blur:aperture=0.05",
        ("random", "uncorrelated-jitter", "sobol+owen"),
        16,
        240,
        1,
    )


FIGURES = [
    Figure(
        "random-and-jittered",
        "16 random against 16 jittered samples",
        "Jitter leaves a fraction of the noise at the same cost.",
        "samplekit render --scene checker:cells=9 --size 128 --spp 16 --sampler jittered",
        random_and_jittered,
        chapter=CHAPTER,
    ),
    Figure(
        "depth-of-field",
        "Depth of field",
        "Stratifying pixel and lens apart halves the error; stratifying all four dimensions together takes most of it.",
        "samplekit render --scene depth-of-field --size 240 --spp 16 --sampler uncorrelated-jitter",
        depth_of_field,
        chapter=CHAPTER,
    ),
    Figure(
        "ambient-occlusion",
        "Ambient occlusion",
        "At 96 rays CCVT is ahead of Poisson disk, which is ahead of jitter.",
        "samplekit render --scene ambient-occlusion:pixel-filter=center --size 160 --spp 96 --sampler ccvt",
        ambient_occlusion,
        ("samplekit-bluenoise",),
        CHAPTER,
    ),
    Figure(
        "motion-blur",
        "Motion blur through a lens",
        "Five dimensions: what is stratified in pairs is still noisy where motion and lens meet.",
        "samplekit render --scene motion-blur:aperture=0.05 --size 240 --spp 16 --sampler sobol+owen",
        motion_blur,
        chapter=CHAPTER,
    ),
]
