"""
Poisson disk against jitter
===========================

On a Gaussian, Poisson disk is ahead up to 64 samples, jitter from 256 on.

    samplekit compare -s jittered -s poisson-disk --scene gaussian --spp 4^1..4^6 --trials 400 --size 1 --no-time
"""

from _shared import save

import samplekit

counts = [4**m for m in range(1, 7)]
results = samplekit.compare(["jittered", "poisson-disk"], "gaussian", counts, trials=400, size=(1, 1), times=False)
save(results.plot().figure_, __file__)
