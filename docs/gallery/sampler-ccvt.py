"""
ccvt
====

Blue noise: no power at low frequencies, which rises as the fourth power of the frequency.

    samplekit spectrum --sampler ccvt --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("ccvt"), __file__)
