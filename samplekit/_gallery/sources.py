"""What a picture was made from: the code and the versions, as one short text that changes when any of them does."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
from pathlib import Path

from samplekit._provenance import versions

_PACKAGES = ("samplekit", "samplekit_spectrum", "samplekit_bluenoise", "samplekit_lattice")


@functools.cache
def made_from() -> str:
    """Digest of all sources of samplekit and of the plugins that come with it, and of the libraries' versions."""
    digest = hashlib.sha256(repr(sorted(versions().items())).encode())
    for package in _PACKAGES:
        spec = importlib.util.find_spec(package)
        for location in sorted(spec.submodule_search_locations or []) if spec else []:
            for path in sorted(Path(location).rglob("*.py")):
                digest.update(path.relative_to(location).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
