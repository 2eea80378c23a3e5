"""
halton+owen
===========

Scrambled in both bases: the pattern has gone, the dark centre and the dark axes stay.

    samplekit spectrum --sampler halton+owen --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("halton+owen"), __file__)
