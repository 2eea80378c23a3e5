import hashlib

import numpy as np
import pytest

from samplekit._errors import SamplekitError
from samplekit.files._pointsets.npy import npy_writer
from samplekit.files._pointsets.utk_binary import utk_binary_writer
from samplekit.files._writing import text_writer


def test_text_keeps_its_line_ends(tmp_path):
    text_writer(["a\n", "ü\n"])(tmp_path / "text")
    assert (tmp_path / "text").read_bytes() == b"a\n\xc3\xbc\n"


def test_a_file_that_lost_its_end_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr(hashlib, "file_digest", lambda file, _: hashlib.sha256(file.read()[:-1]))
    for writer in (text_writer(["abc"]), npy_writer(np.zeros((1, 1, 1))), utk_binary_writer(np.zeros((1, 1, 1)))):
        with pytest.raises(SamplekitError, match="read back"):
            writer(tmp_path / "file")
