"""
sobol
=====

Not random: a self-similar pattern of peaks.

    samplekit spectrum --sampler sobol --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("sobol"), __file__)
