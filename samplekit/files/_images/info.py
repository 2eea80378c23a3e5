"""How an image was made: what `samplekit info` shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from samplekit.files._images import reading

if TYPE_CHECKING:
    from pathlib import Path


def read_info(path: Path) -> dict[str, Any]:
    """Size, parts and metadata of an EXR or PNG file that samplekit wrote. Reads no pixels.

    Returns
    -------
    dict
        ``format`` (``"openexr"`` or ``"png"``), ``width``, ``height``, ``window`` (left, top, and size of the whole
        image), ``parts`` (a list of ``name``, ``channels``, ``type``; a PNG has one part without a name),
        ``metadata``. All of it is JSON.

    Raises
    ------
    UsageError
        No such file, or one that samplekit did not write.
    SamplekitError
        The file is damaged.
    """
    with reading.opened(path) as file:
        specs = reading.specs(file)
        first = specs[0]
        return {
            "format": file.format_name(),
            "width": first.width,
            "height": first.height,
            "window": [first.x, first.y, first.full_width, first.full_height],
            "parts": [
                {
                    "name": spec.get_string_attribute("oiio:subimagename"),
                    "channels": list(spec.channelnames),
                    "type": str(spec.format),
                }
                for spec in specs
            ],
            "metadata": reading.metadata(first),
        }
