"""
sobol+xor
=========

A random digital shift leaves a pattern of peaks, and no power at two of three frequencies, as without it.

    samplekit spectrum --sampler sobol+xor --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("sobol+xor"), __file__)
