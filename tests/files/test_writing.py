import errno
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from samplekit._errors import SamplekitError, UsageError
from samplekit.files._writing import check_targets, write_group


def writes(content):
    return lambda path: path.write_bytes(content) and None


def fails(error):
    def write(path):
        path.write_bytes(b"half")
        raise error

    return write


def one_line(excinfo):
    message = str(excinfo.value)
    assert message
    assert "\n" not in message
    return message


def test_writes_every_file(tmp_path):
    a, b = tmp_path / "a.x", tmp_path / "b.y"
    a.write_bytes(b"old")
    write_group([(a, writes(b"A")), (b, writes(b"B"))])
    assert (a.read_bytes(), b.read_bytes()) == (b"A", b"B")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.x", "b.y"]


def test_writers_get_a_name_in_the_same_folder_with_the_same_ending(tmp_path):
    seen = []
    write_group([(tmp_path / "a.exr", seen.append), (tmp_path / ("n" * 240 + ".png"), seen.append)])
    assert [path.suffix for path in seen] == [".exr", ".png"]
    assert {path.parent for path in seen} == {tmp_path}
    assert seen[0].name != "a.exr"


def test_all_are_written_before_the_first_is_renamed(tmp_path):
    a, b = tmp_path / "a", tmp_path / "b"

    def check(path):
        assert not a.exists()
        path.write_bytes(b"B")

    write_group([(a, writes(b"A")), (b, check)])
    assert a.exists()


@pytest.mark.parametrize(
    "error", [SamplekitError("it broke"), OSError(errno.EIO, "it broke"), ValueError("it broke"), KeyboardInterrupt()]
)
def test_a_failure_leaves_what_was_there(tmp_path, error):
    a, b = tmp_path / "a", tmp_path / "b"
    a.write_bytes(b"old")
    with pytest.raises((SamplekitError, ValueError, KeyboardInterrupt)):
        write_group([(a, writes(b"A")), (b, fails(error))])
    assert a.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [a]


def test_the_message_names_the_file_and_not_the_temporary_one(tmp_path):
    def write(path):
        raise SamplekitError(f"no luck with\n {path}")

    with pytest.raises(SamplekitError) as caught:
        write_group([(tmp_path / "a.exr", write)])
    assert one_line(caught) == f"cannot write {tmp_path / 'a.exr'}: no luck with a.exr"


def test_a_full_disk_that_shows_only_when_flushed(tmp_path, monkeypatch):
    def full(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    target = tmp_path / "a"
    target.write_bytes(b"old")
    with pytest.raises(SamplekitError) as caught:
        write_group([(target, writes(b"new"))])
    assert os.strerror(errno.ENOSPC) in one_line(caught)
    assert target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_file_system_without_flushing_is_no_error(tmp_path, monkeypatch):
    def unsupported(_):
        raise OSError(errno.EINVAL, "no")

    monkeypatch.setattr(os, "fsync", unsupported)
    write_group([(tmp_path / "a", writes(b"new"))])
    assert (tmp_path / "a").read_bytes() == b"new"


def test_a_full_disk(small_disk):
    target = small_disk / "a"
    target.write_bytes(b"old")
    with pytest.raises(SamplekitError) as caught:
        write_group([(target, writes(bytes(10**6)))])
    assert "space" in one_line(caught)
    assert target.read_bytes() == b"old"
    assert list(small_disk.iterdir()) == [target]


def test_paths_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_bytes(b"x")
    (tmp_path / "folder").mkdir()
    wrong = {
        tmp_path / "none" / "a": "does not exist",
        tmp_path / "file" / "a": "is not a folder",
        tmp_path / "file" / "a" / "b": "not",
        tmp_path / "folder": "it is a folder",
        tmp_path / ("n" * 300): "",
        tmp_path / "new\nline" / "a": "does not exist",
        tmp_path / "nul\0" / "a": "",
        Path(): "it is a folder",
    }
    for path, reason in wrong.items():
        with pytest.raises(UsageError) as caught:
            write_group([(path, lambda path: pytest.fail("written before it was checked"))])
        assert reason in one_line(caught)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder"]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes in folders here")
def test_what_is_no_file_is_not_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for path in (pipe, Path(os.devnull)):
        with pytest.raises(UsageError, match="not a regular file"):
            write_group([(path, writes(b"x"))])
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert stat.S_ISCHR(Path(os.devnull).stat().st_mode)


def test_write_protected(tmp_path, monkeypatch):
    target = tmp_path / "a"
    target.write_bytes(b"old")
    for protected in (target, tmp_path):  # root may write anywhere, so ask a system that says no
        monkeypatch.setattr(os, "access", lambda path, mode, protected=protected: Path(path) != protected)
        with pytest.raises(UsageError, match="write-protected"):
            write_group([(target, writes(b"new"))])
    assert target.read_bytes() == b"old"


def test_one_path_twice(tmp_path):
    with pytest.raises(UsageError, match="twice"):
        write_group([(tmp_path / "a", writes(b"1")), (tmp_path / "." / "a", writes(b"2"))])
    with pytest.raises(UsageError, match="twice"):
        check_targets([tmp_path / "a", tmp_path / "a"])
    assert not list(tmp_path.iterdir())


def test_links_are_followed(tmp_path):
    (tmp_path / "folder").mkdir()
    target, link = tmp_path / "folder" / "a", tmp_path / "link"
    try:
        link.symlink_to(target)
    except OSError:
        pytest.skip("no right to make links")
    for content in (b"1", b"2"):  # first through a dangling link
        write_group([(link, writes(content))])
        assert link.is_symlink()
        assert target.read_bytes() == content
    loop = tmp_path / "loop"
    loop.symlink_to(loop)
    with pytest.raises(UsageError) as caught:
        write_group([(loop, writes(b"x"))])
    one_line(caught)


@pytest.mark.skipif(os.name != "posix", reason="modes of files are POSIX")
@pytest.mark.parametrize(("umask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_new_files_have_the_permissions_of_new_files(tmp_path, umask, mode):
    before = os.umask(umask)
    try:
        write_group([(tmp_path / "a", writes(b"x"))])
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == mode


def test_a_rename_that_fails_says_what_is_new(tmp_path, monkeypatch):
    a, b = tmp_path / "a", tmp_path / "b"
    b.write_bytes(b"old")
    replace = Path.replace

    def refuse(self, target):
        if Path(target).name == "b":
            raise PermissionError(errno.EACCES, "in use")
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(SamplekitError) as caught:
        write_group([(a, writes(b"A")), (b, writes(b"B"))])
    assert one_line(caught) == f"cannot write {b}: in use; new already: {a}"
    assert b.read_bytes() == b"old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no such signal here")
def test_a_kill_leaves_the_old_file(tmp_path):
    (tmp_path / "a").write_bytes(b"old")
    script = (
        "import os, signal, pathlib; from samplekit.files._writing import write_group\n"
        "def write(path):\n path.write_bytes(b'half')\n os.kill(os.getpid(), signal.SIGKILL)\n"
        "write_group([(pathlib.Path('a'), write)])"
    )
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, check=False)
    assert done.returncode == -signal.SIGKILL
    assert (tmp_path / "a").read_bytes() == b"old"


def test_imports_no_more_than_it_needs():
    script = (
        "import sys, samplekit.files._images, samplekit.files._writing\n"
        "print(sorted({'numpy', 'OpenImageIO', 'scipy', 'skimage'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_writer_that_cannot_open_its_file_says_so(tmp_path):
    import numpy as np

    from samplekit.files._images.exr import parts_writer
    from samplekit.files._images.png import png_writer

    for write in (parts_writer({"image": [[1.0]]}, {}), png_writer(np.zeros((1, 1, 3), np.uint8), {})):
        with pytest.raises(SamplekitError) as caught:
            write(tmp_path / "none" / "a")
        one_line(caught)
    assert not list(tmp_path.iterdir())
