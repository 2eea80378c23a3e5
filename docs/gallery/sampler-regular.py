"""
regular
=======

A comb: all power in single frequencies, where the grid aliases.

    samplekit spectrum --sampler regular --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("regular"), __file__)
