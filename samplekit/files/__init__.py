"""Images and point sets in files: read them, write them whole or not at all.

This is the one package that uses OpenImageIO.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
