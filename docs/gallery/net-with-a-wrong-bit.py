"""
A net with a wrong bit
======================

By eye both look well distributed. The check finds the intervals that hold two points (red) or none (blue), in the
smallest set that shows it.

    samplekit check sobol --quick
"""

from textwrap import fill

import matplotlib.pyplot as plt
import numpy as np
from _shared import save

import samplekit
from samplekit.testing import check_sampler


class WrongBit(samplekit.Sampler):
    """Sobol points; one constant of the generator matrices has a wrong bit."""

    def fill(self, out, realizations, count, start):
        samplekit.sampler("sobol").fill(out, realizations, count, start)
        if out.shape[1] > 1:
            wrong = (np.arange(start, start + out.shape[2], dtype=np.uint64) >> 3 & 1) << 29
            out[:, 1] = ((out[:, 1] * 2.0**32).astype(np.uint64) ^ wrong) * 2.0**-32


spec = samplekit.SamplerSpec("wrong-bit", f"{__name__}:WrongBit", "a wrong bit", promises=(samplekit.Net(),))
(outcome,) = check_sampler(spec, quick=True, only=["elementary-intervals"])
panels = {
    "sobol: conforms": samplekit.points("sobol", 16)[0],
    "one constant of a generator matrix changed": outcome.example.points,
}

figure, axes = plt.subplots(1, 2, figsize=(7.0, 4.5), layout="constrained")
figure.suptitle("16 points of a net, and of the same net with one wrong bit")
figure.supxlabel(fill(f"samplekit check: {outcome.message}", 100), fontsize="small")
for panel, (name, points) in zip(axes, panels.items(), strict=True):
    held, _, _ = np.histogram2d(points[:, 1], points[:, 0], bins=(8, 2), range=((0, 1), (0, 1)))
    panel.pcolormesh([0, 0.5, 1], np.linspace(0, 1, 9), held - 1, cmap="seismic", vmin=-8, vmax=8, edgecolors="0.9")
    panel.plot(*points.T, "o", color="black", clip_on=False)
    panel.set_title(name, fontsize="medium")
    panel.set(aspect="equal", xlim=(0, 1), ylim=(1, 0), xticks=[], yticks=[])
save(figure, __file__)
