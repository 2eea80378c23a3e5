"""
Every sampler at 4 a pixel
==========================

The samplers part: the best stratified ones have a quarter of random's mean squared error. Sets that are the same in
every pixel have no noise: a grid of 2 x 2 is still fine enough for these rings, Halton and Hammersley points are not.

    samplekit render --scene zoneplate:k=300 --size 144 --spp 4 --sampler jittered
"""

from _shared import every_sampler, save

save(every_sampler(4), __file__)
