"""Parts for the commands of plugins: shared options, values from text, progress, notices, and exit statuses."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
