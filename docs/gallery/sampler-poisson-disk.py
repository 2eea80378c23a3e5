"""
poisson-disk
============

A ring at the distance that the points keep; within it a plateau that does not vanish.

    samplekit spectrum --sampler poisson-disk --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("poisson-disk"), __file__)
