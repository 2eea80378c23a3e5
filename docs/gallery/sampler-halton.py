"""
halton
======

Not random: one fixed pattern, dark in the centre and along the axes.

    samplekit spectrum --sampler halton --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("halton"), __file__)
