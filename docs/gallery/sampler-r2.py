"""
r2
==

A lattice: few strong peaks, none of them near the centre.

    samplekit spectrum --sampler r2 --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("r2"), __file__)
