"""
Error against time
==================

The scene costs next to nothing here, so what a sampler's points cost matters: `--cost` adds a renderer's. That
`random` takes less time with 16 samples than with 4 is no error of measurement: kernels compute eight samples at once,
and what is left over one by one.

    samplekit compare -s random -s jittered -s latin-hypercube -s correlated-multi-jittered -s halton+owen -s sobol+owen -s pmj02 -s poisson-disk --scene zoneplate:k=100 --spp 4^1..4^5 --trials 4 --size 64 --budget 20
"""

from _shared import save

import samplekit

SAMPLERS = (
    "random",
    "jittered",
    "latin-hypercube",
    "correlated-multi-jittered",
    "halton+owen",
    "sobol+owen",
    "pmj02",
    "poisson-disk",
)

counts = [4**m for m in range(1, 6)]
results = samplekit.compare(SAMPLERS, "zoneplate:k=100", counts, trials=4, size=(64, 64), budget=20.0)
save(results.plot(against="time").figure_, __file__)
