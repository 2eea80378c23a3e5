import pytest

from samplekit import UsageError
from samplekit.files import check_stem, text_writer, write_stem

ENDINGS = (".exr", ".error.png")


def listed(folder):
    return sorted(path.name for path in folder.iterdir())


def test_stems(tmp_path, monkeypatch):
    (tmp_path / "folder.exr").mkdir()
    assert check_stem(str(tmp_path), "name", ENDINGS) == tmp_path / "name"
    assert check_stem(str(tmp_path), "halton:base=2/3", ENDINGS) == tmp_path / "halton-base=2-3"
    assert check_stem(str(tmp_path / "folder.exr"), "name", ENDINGS) == tmp_path / "folder.exr" / "name"
    assert check_stem(str(tmp_path / "k0.5.exr"), "name", ENDINGS) == tmp_path / "k0.5"
    monkeypatch.chdir(tmp_path)
    assert check_stem("", "name-k0.5", ENDINGS).resolve() == tmp_path.resolve() / "name-k0.5"
    assert listed(tmp_path) == ["folder.exr"]


def test_stems_that_cannot_be(tmp_path):
    (tmp_path / "file").touch()
    (tmp_path / "a.png").mkdir()
    (tmp_path / "b.error.png").mkdir()
    wrong = ("none", "none/", "none.exr/", "none/a.exr", "file", "file/a.exr", "a.png/b.jpg", "nul\0", "b.exr")
    for output in wrong:
        with pytest.raises(UsageError) as caught:
            check_stem(f"{tmp_path}/{output}", "name", ENDINGS)
        assert "\n" not in str(caught.value)
    assert check_stem(f"{tmp_path}/b.exr", "name", [".exr"]) == tmp_path / "b"
    with pytest.raises(UsageError):
        check_stem(str(tmp_path), "n" * 300, ENDINGS)


def test_a_stem_with_a_dot_keeps_it(tmp_path):
    files = write_stem(tmp_path / "zoneplate-k0.5", {".csv": text_writer(["a"]), ".radial.csv": text_writer(["b"])})
    assert [path.name for path in files] == ["zoneplate-k0.5.csv", "zoneplate-k0.5.radial.csv"]
    assert [path.read_text() for path in files] == ["a", "b"]
