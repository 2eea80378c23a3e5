"""
multi-jittered
==============

Both at once: a dark centre and a dark cross.

    samplekit spectrum --sampler multi-jittered --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("multi-jittered"), __file__)
