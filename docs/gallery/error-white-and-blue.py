"""
White and blue error
====================

Three errors of one size. With random orders of the pixels z-sobol's is blue noise: it has moved to high frequencies,
where a blur leaves a tenth of it. Its own order leaves less after a blur, as a pattern.

    samplekit render --scene gaussian:sigma=0.3 --size 256 --spp 1 --sampler z-sobol --output blue.exr && samplekit spectrum --image blue.exr
"""

import numpy as np
from _shared import label, pixel_grid, save, show_error
from samplekit_spectrum.error_image import error_spectrum

import samplekit

SAMPLERS = ("random", "z-sobol:orders=random", "z-sobol")
SCENE = "gaussian:sigma=0.3"

figure, axes = pixel_grid(
    2,
    3,
    256,
    "White and blue error",
    f"{SCENE}, one sample a pixel. Above: a part of the error image. Below: its power, white is 2 and more.",
    notes=0,
    room=340,
)
chart = figure.add_axes((0.06, 0.06, 0.91, 0.25))
for sampler, (above, below) in zip(SAMPLERS, axes.T, strict=True):
    rendering = samplekit.render(SCENE, sampler, 1, size=(256, 256))
    mse, blurred = rendering.metrics["mse"], rendering.metrics["blurred_mse"]
    spectrum = error_spectrum(rendering.error)
    label(above, sampler)
    show_error(above, rendering.error[64:192, 64:192], 3.0 * np.sqrt(mse))
    below.imshow(np.nan_to_num(spectrum.power), cmap="gray", vmin=0.0, vmax=2.0, interpolation="nearest")
    label(below, "", f"mse {mse:.2e}, blurred {blurred:.1e}: {spectrum.verdict}")
    chart.plot(spectrum.radial.frequency, spectrum.radial.power, label=sampler)
label(chart, "power of the error, mean over rings")
chart.set(xlim=(0.0, 0.5), ylim=(1e-3, 1e2), yscale="log", xlabel="cycles per pixel")
chart.legend(loc="lower right")
save(figure, __file__)
