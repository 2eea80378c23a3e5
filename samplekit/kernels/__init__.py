"""Building blocks of samplers and scenes: compiled kernels, hashing, digits, nets, scrambling, exact sums.

Each name is loaded when it is first used; ``@kernel`` compiles a function, ``@helper`` marks one that kernels inline.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
