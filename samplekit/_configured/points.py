"""Points of a sampler in one call, and in a file."""

from __future__ import annotations

import shlex
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from samplekit._configured.sampler import sampler as configured_sampler

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from samplekit._configured.sampler import ConfiguredSampler
    from samplekit._specs import SamplerSpec

    Progress = Callable[[str, int, int], None]

SCHEMA = "samplekit.points/1"


def points(
    sampler: str | SamplerSpec | ConfiguredSampler,
    count: int,
    dims: int = 2,
    *,
    realizations: int = 1,
    seed: int = 0,
    output: str | os.PathLike[str] | None = None,
    progress: Progress = lambda _, __, ___: None,
) -> NDArray[np.float64]:
    """Return points of a sampler.

    Parameters
    ----------
    sampler
        ``NAME[:option=value,...][+RANDOMIZER]``, or what :func:`samplekit.sampler` returned.
    count, dims, realizations
        Points of a set, dimensions, number of independent sets.
    seed
        From 0 to 2^64 - 1.
    output
        A file that the points are written to, of the kind that its ending says: ``.csv``, ``.plain.csv``, ``.npy``,
        ``.dat``, ``.bin``, or a picture ``.svg``, ``.png``, ``.pdf``; None: no file.
    progress
        Called with what is being done, how much of it is done, and how much there is to do.

    Returns
    -------
    float64[realizations, count, dims], in [0, 1).

    Raises
    ------
    UsageError
        The sampler is unknown or cannot make such sets, or there can be no such file.
    SamplekitError
        A plugin failed, or the file cannot be written.

    Examples
    --------
    >>> import samplekit
    >>> samplekit.points("hammersley", count=4)[0].tolist()
    [[0.0, 0.0], [0.25, 0.5], [0.5, 0.25], [0.75, 0.75]]
    """
    path = None if output is None else Path(output)
    is_picture = path is not None and _check_output(path, realizations, dims)
    source = configured_sampler(sampler)
    values = source.points(
        count,
        dims,
        realizations=realizations,
        seed=seed,
        progress=partial(progress, "preparing"),
    )
    if path is None:
        return values
    if is_picture:
        from samplekit.plots import PointsDisplay

        PointsDisplay.of_set(source, values[0], seed).save(path, _describe(source, int(count), int(dims), seed))
    else:
        from samplekit.files._pointsets.formats import write_points

        write_points(values, path, progress=partial(progress, "writing"))
    return values


def _check_output(path: Path, realizations: int, dims: int) -> bool:
    """Check that such points fit into such a file; return True for a picture."""
    from samplekit.files._pointsets.formats import PICTURES, check_path

    if check_path(path, realizations) not in PICTURES:
        return False
    from samplekit.plots._points import check_dims

    check_dims(dims)
    return True


def _describe(source: ConfiguredSampler, count: int, dims: int, seed: int) -> dict[str, Any]:
    """Return how the points of a picture were made; the same for the same request, so without times and paths."""
    from samplekit._provenance import versions

    words = ["samplekit", "points", "--sampler", source.text, "--count", str(count), "--dims", str(dims)]
    words += ["--seed", str(seed)]
    return {
        "schema": SCHEMA,
        "command": shlex.join(words),
        "versions": versions(),
        # As text, as in the images of renderings: many JSON readers round integers beyond 2^53.
        "seed": str(seed),
        "sampler": source.text,
        "sampler_plugin": str(source.plugin),
        "sampler_notes": source.notes(count, dims),
        "count": count,
        "dims": dims,
        "realizations": 1,
    }
