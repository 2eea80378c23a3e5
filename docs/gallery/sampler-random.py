"""
random
======

White noise: the spectrum is flat.

    samplekit spectrum --sampler random --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("random"), __file__)
