"""
hammersley
==========

Not random: bars of power, and wide darkness between them.

    samplekit spectrum --sampler hammersley --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("hammersley"), __file__)
