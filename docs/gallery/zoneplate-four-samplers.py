"""
One zone plate, four samplers
=============================

A regular grid answers rings that are too fine for it with false coarse ones. Random points answer with noise
everywhere; jittered and scrambled Sobol points keep more of the true rings clean before noise takes over.

    samplekit render --scene zoneplate:k=1600 --size 232 --spp 4 --sampler sobol+owen
"""

from _shared import LINE, label, pixel_grid, save, show_error, show_image

import samplekit

SAMPLERS = ("regular", "random", "jittered", "sobol+owen")
SCALE = 0.5

figure, axes = pixel_grid(
    2,
    4,
    232,
    "One zone plate, four samplers",
    f"4 samples a pixel. Below: the error against the exact image, blue -{SCALE}, white 0, red {SCALE}.",
    notes=0,
    room=LINE,
)
for sampler, (above, below) in zip(SAMPLERS, axes.T, strict=True):
    rendering = samplekit.render("zoneplate:k=1600", sampler, 4, size=(232, 232))
    label(above, sampler)
    show_image(above, rendering.image)
    show_error(below, rendering.error, SCALE)
    label(below, "", f"mse {rendering.metrics['mse']:.4f}")
save(figure, __file__)
