"""
correlated-multi-jittered
=========================

The same strata, one shuffle for all rows: darker in the centre, with structure.

    samplekit spectrum --sampler correlated-multi-jittered --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("correlated-multi-jittered"), __file__)
