"""Shell completion of names. It never prints an error, and imports no implementation."""

from __future__ import annotations


def complete_sampler(incomplete: str) -> list[tuple[str, str]]:
    """Return samplers, and after a plus sign randomizers, with their summaries."""
    sampler, plus, _ = incomplete.rpartition("+")
    if plus:
        return [(f"{sampler}+{name}", summary) for name, summary in names("randomizer")]
    return names("sampler")


def complete_scene(incomplete: str) -> list[tuple[str, str]]:
    """Return scenes with their summaries."""
    return names("scene")


def names(kind: str) -> list[tuple[str, str]]:
    """Return the names of a kind (``sampler``, ``scene``, ``randomizer``) with their summaries."""
    try:
        from samplekit._registry import registry

        return [(name, offer.spec.summary) for name, offer in registry().all(kind).items()]  # type: ignore[arg-type]
    except Exception:
        return []
