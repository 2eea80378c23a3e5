"""
n-rooks
=======

Dark on the axes alone: one point in each row and column helps functions of one coordinate.

    samplekit spectrum --sampler n-rooks --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("n-rooks"), __file__)
