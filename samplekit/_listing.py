"""The declarations of everything that is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from samplekit._registry import Plugin, registry

if TYPE_CHECKING:
    from samplekit._specs import RandomizerSpec, SamplerSpec, SceneSpec


def samplers() -> list[SamplerSpec]:
    """Return the declarations of all samplers, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [spec.name for spec in samplekit.samplers() if spec.progressive == samplekit.AnyCount()][:2]
    ['halton', 'r2']
    """
    return [registration.spec for registration in registry().all("sampler").values()]


def scenes() -> list[SceneSpec]:
    """Return the declarations of all scenes, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [option.name for spec in samplekit.scenes() if spec.name == "zoneplate" for option in spec.options]
    ['k', 'cx', 'cy', 'pixel-filter']
    """
    return [registration.spec for registration in registry().all("scene").values()]


def randomizers() -> list[RandomizerSpec]:
    """Return the declarations of all randomizers, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [spec.name for spec in samplekit.randomizers()]
    ['owen', 'shift', 'xor']
    """
    return [registration.spec for registration in registry().all("randomizer").values()]


def plugins() -> list[Plugin]:
    """Return all installed plugins, also those that failed, with their problems.

    Examples
    --------
    >>> import samplekit
    >>> "lattice" in [plugin.name for plugin in samplekit.plugins()]
    True
    """
    registry().discover()
    return registry().plugins
