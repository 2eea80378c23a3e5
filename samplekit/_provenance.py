"""The versions of the software that results depend on."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import version

from samplekit import __version__

_LIBRARIES = ("numpy", "numba", "scipy", "OpenImageIO")
_library_version = cache(version)


def versions() -> dict[str, str]:
    """Return the versions of samplekit, of Python and of the libraries that numbers depend on.

    Examples
    --------
    >>> import samplekit
    >>> sorted(samplekit.versions())
    ['OpenImageIO', 'numba', 'numpy', 'python', 'samplekit', 'scipy']
    """
    libraries = {name: _library_version(name) for name in _LIBRARIES}
    return {"samplekit": __version__, "python": platform.python_version(), **libraries}
