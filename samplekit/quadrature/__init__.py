"""Adaptive quadrature: the mean of an integrand over each pixel, for scenes that have no closed form."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
