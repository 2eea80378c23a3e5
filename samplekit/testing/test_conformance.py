"""The suite as tests: ``pytest --pyargs samplekit.testing --sampler NAME``; without a name they are skipped."""

from collections.abc import Callable


def test_conformance(samplekit_case: Callable[[], None]) -> None:
    """Run one check of what the command names."""
    samplekit_case()
