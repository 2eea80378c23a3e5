"""
Convergence on a Gaussian
=========================

The best case. From 4 to 4096 samples jitter and scrambled Halton points fall as N^-1.9, scrambled Sobol points as N^-2.4,
correlated multi-jitter as N^-3.

    samplekit compare -s random -s jittered -s latin-hypercube -s correlated-multi-jittered -s halton+owen -s sobol+owen -s pmj02 --scene gaussian --spp 2^2..2^12 --trials 1000 --size 1 --no-time
"""

from _shared import save

import samplekit

SAMPLERS = ("random", "jittered", "latin-hypercube", "correlated-multi-jittered", "halton+owen", "sobol+owen", "pmj02")

results = samplekit.compare(SAMPLERS, "gaussian", [2**m for m in range(2, 13)], trials=1000, size=(1, 1), times=False)
save(results.plot().figure_, __file__)
