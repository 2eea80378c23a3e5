"""The zone plate under every sampler: rings where there are none are aliasing, grain is noise."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import samplekit
from samplekit._gallery.figure import Figure
from samplekit._gallery.sheet import Tile, image_tile, rendering_tiles, sheet

if TYPE_CHECKING:
    from samplekit._drawing.drawing import Drawing

CHAPTER = "Zone plates"
SAMPLERS = (
    "regular",
    "random",
    "jittered",
    "latin-hypercube",
    "multi-jittered",
    "correlated-multi-jittered",
    "poisson-disk",
    "lloyd",
    "ccvt",
    "hammersley",
    "halton",
    "halton+owen",
    "sobol",
    "sobol+shift",
    "sobol+xor",
    "sobol+owen",
    "owen-sobol",
    "pmj02",
    "z-sobol",
    "r2",
    "rank1",
    "orthogonal-array",
    "niederreiter+owen",
    "faure+owen",
)
_COLUMNS = 6


def hero() -> Drawing:
    """Four samplers, and their errors on one scale."""
    scene, spp, names = "zoneplate:k=1600", 4, ("regular", "random", "jittered", "sobol+owen")
    scale = 0.5
    tiles = []
    for name in names:
        result = samplekit.render(scene, name, spp, size=(232, 232))
        tiles.append(rendering_tiles(result, scale, name, f"mse {result.metrics['mse']:.4f}"))
    lines = [f"4 samples a pixel. Below: the error against the exact image, blue -{scale}, white 0, red {scale}."]
    return sheet("One zone plate, four samplers", lines, list(zip(*tiles, strict=True)))


def _every_sampler(spp: int) -> Drawing:
    tiles = []
    for name in SAMPLERS:
        sampler = samplekit.sampler(name)
        rule = sampler.spec.counts
        count = spp if rule.allows(spp, 2) else rule.below(spp, 2)
        if count is None:
            blank = np.full((144, 144, 3), 236, np.uint8)
            tiles.append(Tile(blank, name, (f"no set of {spp} or fewer",)))
            continue
        result = samplekit.render("zoneplate:k=300", sampler, count, size=(144, 144))
        note = f"mse {result.metrics['mse']:.3g}" + (f", {count} a pixel" if count != spp else "")
        tiles.append(image_tile(result.image, name, note))
    rows = [tiles[start : start + _COLUMNS] for start in range(0, len(tiles), _COLUMNS)]
    what = "1 sample" if spp == 1 else f"{spp} samples"
    lines = [f"{what} a pixel, 144 x 144 pixels. Rings around other centres than the upper left corner are aliasing."]
    return sheet(f"The zone plate under every sampler, {what} a pixel", lines, [list(row) for row in rows])


FIGURES = [
    Figure(
        "zoneplate-four-samplers",
        "One zone plate, four samplers",
        "A regular grid answers rings that are too fine for it with false coarse ones. Random points answer with noise "
        "everywhere; jittered and scrambled Sobol points keep more of the true rings clean before noise takes over.",
        "samplekit render --scene zoneplate:k=1600 --size 232 --spp 4 --sampler sobol+owen",
        hero,
        chapter=CHAPTER,
    ),
    *(
        Figure(
            f"zoneplates-{spp}spp",
            f"Every sampler at {spp} a pixel",
            caption,
            f"samplekit render --scene zoneplate:k=300 --size 144 --spp {spp} --sampler jittered",
            partial(_every_sampler, spp),
            ("samplekit-bluenoise", "samplekit-lattice"),
            CHAPTER,
        )
        for spp, caption in (
            (1, "With one sample a pixel every random sampler is the random one; those that are not random alias."),
            (4, "The samplers part: what is stratified has less noise, what is the same in every pixel still aliases."),
            (
                16,
                "The noise of good samplers has gone; regular structure has moved to finer rings, and is still there.",
            ),
        )
    ),
]
