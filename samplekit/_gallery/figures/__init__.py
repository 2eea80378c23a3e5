"""All figures, chapter by chapter, in the order of the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from samplekit._gallery.figure import Figure


def all_figures() -> list[Figure]:
    """Every figure of the gallery."""
    from samplekit._gallery.figures import conformance, convergence, error_spectra, images, samplers, zoneplates

    modules = (zoneplates, samplers, convergence, images, error_spectra, conformance)
    figures = [figure for module in modules for figure in module.FIGURES]
    chapters = list(dict.fromkeys(figure.chapter for figure in figures))
    return sorted(figures, key=lambda figure: chapters.index(figure.chapter))
