"""``report.html``: a study as one page that needs no network.

``page`` puts it together from the template and scripts in ``assets``, ``answers`` arranges what comes first, ``pixels``
packs the images, ``wording`` writes numbers.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

    from samplekit._study.results import Results

NAME = "report.html"


def write_report(results: Results, folder: Path) -> Path:
    """Write the page of a study beside its other files.

    Parameters
    ----------
    results
        What was found.
    folder
        Where the images are, at the paths in ``results``, and where the page goes.

    Returns
    -------
    Path
        Of the page.

    Raises
    ------
    UsageError, SamplekitError
        An image is missing, damaged or of another size, or the page cannot be written; there is then the old one or
        none.
    """
    from samplekit._report.page import page
    from samplekit.files._writing import text_writer, write_group

    path = folder / NAME
    write_group([(path, text_writer([page(results, folder)]))])
    return path
