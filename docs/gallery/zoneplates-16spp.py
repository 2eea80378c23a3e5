"""
Every sampler at 16 a pixel
===========================

The noise of good samplers has gone; regular structure has moved to finer rings, and is still there.

    samplekit render --scene zoneplate:k=300 --size 144 --spp 16 --sampler jittered
"""

from _shared import every_sampler, save

save(every_sampler(16), __file__)
