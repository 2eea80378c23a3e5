"""Strangers' errors in a message."""

import pytest

from samplekit._quoting import place


def test_place_is_the_line_of_the_stranger(tmp_path):
    path = tmp_path / "points.py"
    path.write_text("import numpy as np\n\n\ndef draw():\n    return np.ones(2) + np.ones(3)\n")
    scope = {}
    exec(compile(path.read_text(), str(path), "exec"), scope)
    with pytest.raises(ValueError, match="broadcast") as caught:
        scope["draw"]()
    assert place(caught.value) == " (points.py, line 5)"
    assert place(ValueError()) == ""
