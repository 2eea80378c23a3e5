"""
pmj02
=====

Progressive, and as well stratified: the spectrum of the scrambled Sobol points.

    samplekit spectrum --sampler pmj02 --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("pmj02"), __file__)
