"""
Convergence on the disk
=======================

The worst case. Random points and Latin hypercubes fall as N^-1, the other samplers as about N^-1.5: their fits from 4 to
4096 samples are between -1.4 and -1.6.

    samplekit compare -s random -s jittered -s latin-hypercube -s correlated-multi-jittered -s halton+owen -s sobol+owen -s pmj02 --scene disk --spp 2^2..2^12 --trials 1000 --size 1 --no-time
"""

from _shared import save

import samplekit

SAMPLERS = ("random", "jittered", "latin-hypercube", "correlated-multi-jittered", "halton+owen", "sobol+owen", "pmj02")

results = samplekit.compare(SAMPLERS, "disk", [2**m for m in range(2, 13)], trials=1000, size=(1, 1), times=False)
save(results.plot().figure_, __file__)
