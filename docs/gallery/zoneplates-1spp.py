"""
Every sampler at 1 a pixel
==========================

With one sample a pixel every random sampler has the mean squared error of the random one; those that are not random
alias.

    samplekit render --scene zoneplate:k=300 --size 144 --spp 1 --sampler jittered
"""

from _shared import every_sampler, save

save(every_sampler(1), __file__)
