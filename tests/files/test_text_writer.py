import hashlib

import pytest

from samplekit._errors import SamplekitError
from samplekit.files._writing import text_writer


def test_text_keeps_its_line_ends(tmp_path):
    text_writer(["a\n", "ü\n"])(tmp_path / "text")
    assert (tmp_path / "text").read_bytes() == b"a\n\xc3\xbc\n"


def test_a_file_that_lost_its_end_is_an_error(tmp_path, monkeypatch):
    monkeypatch.setattr(hashlib, "file_digest", lambda file, _: hashlib.sha256(file.read()[:-1]))
    with pytest.raises(SamplekitError, match="read back"):
        text_writer(["abc"])(tmp_path / "text")
