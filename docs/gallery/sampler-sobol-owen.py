"""
sobol+owen
==========

Scrambled: even noise around a dark cross whose arms narrow outwards.

    samplekit spectrum --sampler sobol+owen --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("sobol+owen"), __file__)
