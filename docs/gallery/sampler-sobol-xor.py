"""
sobol+xor
=========

A random digital shift moves no power: the pattern of peaks stays.

    samplekit spectrum --sampler sobol+xor --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("sobol+xor"), __file__)
