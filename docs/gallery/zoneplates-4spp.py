"""
Every sampler at 4 a pixel
==========================

The samplers part: what is stratified has less noise, what is the same in every pixel still aliases.

    samplekit render --scene zoneplate:k=300 --size 144 --spp 4 --sampler jittered
"""

from _shared import every_sampler, save

save(every_sampler(4), __file__)
