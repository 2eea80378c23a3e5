"""
jittered
========

Dark in the centre: the power rises as the square of the frequency.

    samplekit spectrum --sampler jittered --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("jittered"), __file__)
