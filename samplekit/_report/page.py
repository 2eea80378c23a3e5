"""``report.html``: template, style, scripts and data of a study in one page that needs no network."""

from __future__ import annotations

import base64
import hashlib
from dataclasses import asdict
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import jinja2
from markupsafe import Markup

from samplekit._report import wording
from samplekit._report.answers import answers
from samplekit._report.pixels import STEPS, packed
from samplekit._study.folder import CSV, JSON
from samplekit._study.results import LEVEL
from samplekit.files._images import diverging
from samplekit.files._images.png import RESERVED

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from samplekit._study.results import Results

_ASSETS = files("samplekit._report") / "assets"
_LIBRARY = "vendor/d3.min.js"


def page(results: Results, folder: Path) -> str:
    """Return the page as text.

    Every text of the study is escaped. The content security policy of the page lists the hashes of its own scripts: no
    other script runs, and no connection is allowed.

    Parameters
    ----------
    results
        The study.
    folder
        Where the paths of images in ``results`` begin.

    Raises
    ------
    UsageError, SamplekitError
        An image is missing or damaged.
    """
    style = _joined("style")
    scripts = [asset(_LIBRARY), '"use strict";\n' + _joined("scripts")]
    scenes, blobs = packed(results, folder)
    data = {
        "study": asdict(results) | {"seed": str(results.seed)},
        "pictures": scenes,
        "error_colours": diverging.table().tobytes().hex(),
        "invalid_colour": RESERVED,
    }
    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(asset), autoescape=True, undefined=jinja2.StrictUndefined, lstrip_blocks=True
    )
    environment.filters |= wording.FILTERS
    environment.policies["json.dumps_kwargs"] = {"allow_nan": False, "separators": (",", ":")}
    return environment.get_template("page.html").render(
        title="Error against samples and run time",
        study=results,
        size=tuple(results.size),
        samplers=results.samplers,
        level=LEVEL,
        answers=answers(results),
        fits={(fit.scene, fit.sampler): fit for fit in results.fits},
        timed=any(row.times for row in results.rows),
        blurred=any(row.blurred_mse for row in results.rows),
        references=references(results),
        files=[JSON, CSV, *results.plots],
        pictures=scenes,
        steps=STEPS,
        data=data,
        blobs=list(blobs.items()),
        style=Markup(style),
        scripts=[Markup(script) for script in scripts],
        policy=policy([style], scripts),
        library=asset(_LIBRARY).partition("\n")[0].removeprefix("// "),
        library_licence=asset("vendor/d3.LICENSE"),
    )


def asset(name: str) -> str:
    """Return the text of a file in ``assets``."""
    return _ASSETS.joinpath(*name.split("/")).read_text(encoding="utf-8")


def _joined(folder: str) -> str:
    """Return the texts of a folder in ``assets`` as one; their names begin with their place in the order."""
    names = sorted(file.name for file in _ASSETS.joinpath(folder).iterdir())
    return "\n".join(asset(f"{folder}/{name}") for name in names)


def policy(styles: Sequence[str], scripts: Sequence[str]) -> str:
    """Return the content security policy: a browser may use the page's own styles and scripts, and nothing else."""

    def hashes(texts: Sequence[str]) -> str:
        digests = (hashlib.sha256(text.encode()).digest() for text in texts)
        return " ".join(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)

    allowed = {
        "default-src": "'none'",
        "script-src": hashes(scripts),
        "style-src": hashes(styles),
        "base-uri": "'none'",
        "form-action": "'none'",
    }
    return "; ".join(f"{name} {value}" for name, value in allowed.items())


def references(results: Results) -> dict[str, str]:
    """Return for each scene the kind of its reference, and how far the reference may be off."""
    found: dict[str, Any] = {}
    for row in results.rows:
        bound = "" if row.reference_error == 0.0 else f", off by at most {wording.number(row.reference_error, 2)}"
        found.setdefault(row.scene, row.reference_kind + bound)
    return found
