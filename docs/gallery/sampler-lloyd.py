"""
lloyd
=====

Relaxed points: a sharp, round ring, and no crystal yet.

    samplekit spectrum --sampler lloyd --count 256 --realizations 400 --max-frequency 64
"""

from _shared import plate, save

save(plate("lloyd"), __file__)
