"""Shell completion of names; silent whatever happens, and without importing any implementation."""

from __future__ import annotations


def complete_sampler(incomplete: str) -> list[tuple[str, str]]:
    """Samplers, and after a plus sign the randomizers."""
    sampler, plus, _ = incomplete.rpartition("+")
    if plus:
        return [(f"{sampler}+{name}", summary) for name, summary in _names("randomizer")]
    return _names("sampler")


def complete_scene(incomplete: str) -> list[tuple[str, str]]:
    """Scenes."""
    return _names("scene")


def complete_named(kinds: str, incomplete: str) -> list[tuple[str, str]]:
    """Return names of a kind (``samplers``, ``scenes``, ``randomizers``) with their summaries."""
    if kinds == "samplers":
        return complete_sampler(incomplete)
    return _names(kinds.removesuffix("s"))


def _names(kind: str) -> list[tuple[str, str]]:
    try:
        from samplekit._registry import registry

        return [(name, offer.spec.summary) for name, offer in registry().all(kind).items()]  # type: ignore[arg-type]
    except Exception:
        return []
