"""How an image was made, as one JSON string: the only form that EXR and PNG both keep unchanged."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from samplekit._errors import SamplekitError, UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping

KEY = "samplekit"
"""Name of the string attribute that holds the JSON."""


def encode_metadata(metadata: Mapping[str, Any]) -> str:
    """Return the same text for the same metadata: keys in order, ASCII.

    Raises
    ------
    SamplekitError
        JSON cannot hold a value; NaN and infinity are such values.
    """
    try:
        return json.dumps(dict(metadata), sort_keys=True, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise SamplekitError(f"the metadata cannot be stored as JSON: {error}") from error


def _refuse(constant: str) -> None:
    raise ValueError(f"{constant} is no JSON")


def decode_metadata(text: str) -> dict[str, Any]:
    """Return the metadata in the text of an attribute, which is empty where the image has none.

    Raises
    ------
    UsageError
        There is none, so samplekit did not write the image.
    SamplekitError
        The text is no JSON object.
    """
    if not text:
        raise UsageError("it was not made by samplekit: it has no samplekit metadata")
    try:
        metadata = json.loads(text, parse_constant=_refuse)
        # JSON can write half of a character, which no terminal can show: that is refused here as well.
        json.dumps(metadata, ensure_ascii=False).encode()
    except (ValueError, RecursionError) as error:
        raise SamplekitError(f"its metadata is damaged: {error}") from None
    if not isinstance(metadata, dict):
        raise SamplekitError("its metadata is damaged: it is no JSON object")
    return metadata
