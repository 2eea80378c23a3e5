"""
16 random against 16 jittered samples
=====================================

Jitter leaves a quarter of random's mean squared error with the same number of samples.

    samplekit render --scene checker:cells=9 --size 128 --spp 16 --sampler jittered
"""

from _shared import beside, save

import samplekit

SAMPLERS = ("random", "jittered")

renderings = {name: samplekit.render("checker:cells=9", name, 16, size=(128, 128)) for name in SAMPLERS}
figure = beside(
    renderings,
    "16 random and 16 jittered samples a pixel",
    "A checkerboard: all noise is along its edges.",
    enlarged=2,
)
save(figure, __file__)
