"""
The course's table
==================

Poisson disk's slope on the disk is steeper than its asymptotic -1: its low plateau is reached late.

    samplekit compare -s random -s jittered -s poisson-disk -s ccvt --scene disk --scene gaussian --spp 2^4..2^9 --trials 400 --size 1 --no-time
"""

import matplotlib.pyplot as plt
from _shared import save

import samplekit

SAMPLERS = ("random", "jittered", "poisson-disk", "ccvt")
SCENES = ("disk", "gaussian")

counts = [2**m for m in range(4, 10)]
results = samplekit.compare(SAMPLERS, SCENES, counts, trials=400, size=(1, 1), times=False)
# A study of one pixel makes every set afresh, and calls a sampler that has a bank NAME:bank=0.
fits = {(fit.sampler.partition(":")[0], fit.scene): fit for fit in results.fits}

rows = []
for sampler in SAMPLERS:
    row = []
    for scene in SCENES:
        fit = fits[sampler, scene]
        slope = fit.slope
        row += [f"{fit.theory:g}", f"{slope.estimate:.2f}  ({slope.low:.2f} to {slope.high:.2f})"]
    rows.append(row)

figure, axes = plt.subplots(figsize=(8.6, 2.6), layout="constrained")
axes.set_axis_off()
axes.set_title("Exponents of the mean squared error: N = 16 to 512, 400 trials")
header = [f"{scene}: {what}" for scene in SCENES for what in ("theory", "measured, 95 %")]
table = axes.table(rows, rowLabels=SAMPLERS, colLabels=header, cellLoc="left", loc="center", edges="horizontal")
table.auto_set_font_size(False)
table.set_fontsize(9)
table.auto_set_column_width(list(range(len(header))))
table.scale(1.0, 2.0)
save(figure, __file__)
