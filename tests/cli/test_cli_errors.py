"""Wrong use: one line that says what would be right, the right exit status, and no file."""

import os
import subprocess
import sys

import pytest

from samplekit._integrate import rendering as renderer
from samplekit._registry import registry

GOOD = {"sampler": "hammersley", "spp": "4", "size": "8", "scene": "zoneplate"}


def render(**changes):
    options = {**GOOD, **changes}
    return ["render", *(f"--{name.replace('_', '-')}={value}" for name, value in options.items() if value is not None)]


def tree(folder):
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*"))


def assert_refused(command, folder, arguments, *reasons, status=2):
    """One line with all the reasons, on standard error alone, and nothing written; the same as JSON."""
    before = tree(folder)
    done = command(*arguments)
    assert (done.status, done.out) == (status, "")
    for reason in reasons:
        assert reason in done.error
    assert "internal error" not in done.error
    as_json = command(*arguments, "--json")
    assert (as_json.status, as_json.err) == (done.status, done.err)
    assert as_json.report == {"schema": "samplekit.error/1", "error": done.error}
    assert tree(folder) == before


@pytest.mark.parametrize(
    ("changes", "reasons"),
    [
        # Names, with the nearest that there are.
        ({"sampler": "hamersley"}, ["unknown sampler 'hamersley': did you mean hammersley"]),
        ({"sampler": "Sobol"}, ["unknown sampler 'Sobol': did you mean sobol"]),
        ({"sampler": "xqxqxq"}, ["unknown sampler 'xqxqxq': there are ", "halton", "sobol"]),
        ({"sampler": "sobol+owens"}, ["unknown randomizer 'owens': did you mean owen"]),
        ({"sampler": "sobol+xqxqxq"}, ["unknown randomizer", "owen", "shift", "xor"]),
        ({"sampler": "samplekit/nothing"}, ["unknown sampler 'samplekit/nothing'"]),
        ({"scene": "zone-plate"}, ["unknown scene 'zone-plate': did you mean zoneplate"]),
        ({"scene": "xqxqxq"}, ["unknown scene", "disk", "zoneplate"]),
        ({"scene": "disk:radios=1"}, ["disk has no option 'radios'", "radius, cx, cy"]),
        ({"sampler": "halton:base=2"}, ["halton has no option 'base'"]),
        # What is no name at all.
        ({"sampler": ""}, ["sampler ''"]),
        ({"sampler": "sobol+owen+shift"}, ["one randomizer at most"]),
        ({"sampler": "sobol+"}, ["sobol+"]),
        ({"sampler": "größe"}, ["expected NAME"]),
        ({"sampler": "a\nb"}, ["expected NAME"]),
        ({"scene": "zoneplate+owen"}, ["expected NAME"]),
        ({"scene": "../../etc/passwd"}, ["expected NAME"]),
        ({"scene": "disk:"}, ["expected NAME:option=value"]),
        ({"scene": "disk:radius"}, ["expected NAME:option=value"]),
        ({"scene": "disk:radius=1,radius=2"}, ["'radius' is given twice"]),
        # Options: out of range, of another type, not finite.
        ({"scene": "disk:radius=-1"}, ["radius=-1", "expected a number"]),
        ({"scene": "disk:radius=nan"}, ["radius=nan", "expected a number"]),
        ({"scene": "disk:radius=inf"}, ["radius=inf", "expected a number"]),
        ({"scene": "disk:cx=-inf"}, ["cx=-inf", "expected a number"]),
        ({"scene": "disk:cx=1e999"}, ["cx=1e999", "expected a number"]),
        ({"scene": "disk:radius=1e200"}, ["radius=1e200"]),
        ({"scene": "disk:radius=big"}, ["radius=big", "expected a number"]),
        ({"scene": "checker:cells=0"}, ["cells=0", "expected an integer"]),
        ({"scene": "checker:cells=2.5"}, ["cells=2.5", "expected an integer"]),
        ({"scene": "checker:cells=9999999999999999999999"}, ["cells=9999", "expected an integer"]),
        ({"scene": "gaussian:sigma=0"}, ["sigma=0"]),
        ({"scene": "zoneplate:k=-1"}, ["k=-1"]),
        # Counts.
        ({"spp": "0"}, ["spp 0", "positive integer"]),
        ({"spp": "-3"}, ["spp -3", "positive integer"]),
        ({"spp": "1e4"}, ["spp 1e4", "positive integer"]),
        ({"spp": "2.5"}, ["spp 2.5", "positive integer"]),
        ({"spp": "many"}, ["spp many", "positive integer"]),
        ({"spp": ""}, ["positive integer"]),
        ({"spp": "2^70"}, ["spp 2^70", "positive integer"]),
        ({"spp": "9" * 1000}, ["positive integer"]),
        ({"spp": "2^40", "size": "512"}, ["262144 pixels x 1099511627776 samples", "at most"]),
        ({"spp": "2^41"}, ["hammersley makes at most 1099511627776 points"]),
        ({"spp": "1009", "sampler": "jittered"}, ["not 1009", "1008 and 1012"]),
        ({"spp": "1009", "sampler": "regular"}, ["not 1009", "1008 and 1012"]),
        ({"spp": "1009", "sampler": "multi-jittered"}, ["not 1009", "1008 and 1012"]),
        # Dimensions.
        (
            {"sampler": "van-der-corput"},
            ["van-der-corput makes points in 1 dimension", "not 2", "zoneplate needs pixel 2"],
        ),
        ({"sampler": "n-rooks", "scene": "depth-of-field"}, ["n-rooks makes points in 2 dimensions, not 4", "random"]),
        # Sizes and crops.
        ({"size": "0"}, ["size 0", "expected W or WxH"]),
        ({"size": "0x5"}, ["size 0x5", "expected W or WxH"]),
        ({"size": "5x"}, ["size 5x", "expected W or WxH"]),
        ({"size": "-4"}, ["size -4", "expected W or WxH"]),
        ({"size": "8.5"}, ["size 8.5", "expected W or WxH"]),
        ({"size": "9999999999"}, ["expected W or WxH"]),
        ({"size": "100000x100000"}, ["1.12e+03 GiB of memory", "--crop X,Y,W,H"]),
        ({"crop": "8,0,1,1"}, ["crop 8,0,1,1", "inside the image of 8x8 pixels"]),
        ({"crop": "0,0,9,1"}, ["inside the image of 8x8 pixels"]),
        ({"crop": "0,0,0,1"}, ["inside the image of 8x8 pixels"]),
        ({"crop": "-1,0,1,1"}, ["expected X,Y,W,H"]),
        ({"crop": "1,2,3"}, ["expected X,Y,W,H"]),
        ({"crop": "all"}, ["expected X,Y,W,H"]),
        # Seeds and threads.
        ({"seed": "-1"}, ["seed -1", "from 0 to 18446744073709551615"]),
        ({"seed": str(2**64)}, ["from 0 to 18446744073709551615"]),
        ({"seed": "text"}, ["seed text"]),
        ({"seed": "1.5"}, ["seed 1.5"]),
        ({"seed": ""}, ["from 0 to 18446744073709551615"]),
        ({"threads": "0"}, ["threads 0", "positive integer"]),
        ({"threads": "-1"}, ["threads -1", "positive integer"]),
        ({"threads": "1.5"}, ["threads 1.5", "positive integer"]),
        ({"threads": "100000"}, ["threads 100000"]),
    ],
)
def test_what_cannot_be_rendered_is_refused(command, tmp_path, changes, reasons):
    assert_refused(command, tmp_path, render(**changes), *reasons)


@pytest.mark.parametrize("metric", ["--ssim", "--flip"])
def test_metrics_without_a_reference_are_refused(command, tmp_path, metric):
    assert_refused(command, tmp_path, [*render(), metric, "--no-error"], "--no-error leaves out")


def test_structural_similarity_of_a_few_pixels_is_refused(command, tmp_path):
    assert_refused(command, tmp_path, [*render(size="6"), "--ssim"], "at least 7 x 7 pixels, the image has 6 x 6")


def test_an_argument_of_a_hundred_thousand_letters_is_one_line(command, tmp_path):
    for name in ("sampler", "scene", "spp", "size", "crop", "seed", "threads"):
        done = command(*render(**{name: "a" * 100_000}))
        assert done.status == 2
        assert len(done.error) < 1000
    done = command(*render(output="a" * 100_000 + ".exr"))
    assert done.status == 2
    assert "File name too long" in done.error
    assert tree(tmp_path) == []


# --- where nothing can be written ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        ("a.png", "neither a folder that exists nor ends in .exr"),
        ("a.tiff", "neither a folder that exists nor ends in .exr"),
        ("a", "neither a folder that exists nor ends in .exr"),
        ("a.EXR", "neither a folder that exists nor ends in .exr"),
        (".exr", "neither a folder that exists nor ends in .exr"),
        ("missing/", "neither a folder that exists nor ends in .exr"),
        ("a.exr/", "neither a folder that exists nor ends in .exr"),
        (" ", "neither a folder that exists nor ends in .exr"),
        ("missing/a.exr", "missing does not exist"),
        ("file/a.exr", "file is not a folder"),
        ("file", "neither a folder that exists nor ends in .exr"),
        ("b.exr", "b.png: it is a folder"),
        ("x" * 300 + ".exr", "File name too long"),
        ("a\0b.exr", "null"),
    ],
)
def test_a_place_that_cannot_be_written_to_is_refused_before_any_work(command, tmp_path, monkeypatch, output, reason):
    monkeypatch.setattr(renderer, "render_plan", lambda *_, **__: pytest.fail("it was rendered first"))
    (tmp_path / "file").write_bytes(b"")
    (tmp_path / "b.png").mkdir()
    assert_refused(command, tmp_path, render(output=output), "cannot write", reason)


@pytest.mark.skipif(os.name == "nt", reason="needs devices and links")
def test_devices_are_not_replaced_by_files(command, tmp_path):
    (tmp_path / "a.exr").symlink_to("/dev/null")
    (tmp_path / "b.exr").symlink_to("b.exr")
    os.mkfifo(tmp_path / "c.exr")
    assert_refused(command, tmp_path, render(output="/dev/null"), "cannot write")
    assert_refused(command, tmp_path, render(output="a.exr"), "cannot write a.exr")
    assert_refused(command, tmp_path, render(output="b.exr"), "cannot write b.exr")
    assert_refused(command, tmp_path, render(output="c.exr"), "not a regular file")


@pytest.mark.skipif(sys.platform != "linux", reason="needs a folder in which nobody can write")
def test_where_the_system_says_no_its_reason_is_told(command, tmp_path):
    for output in ("/proc", "/proc/a.exr"):
        done = command(*render(output=output))
        assert done.status in (1, 2)
        assert "cannot write" in done.error
    assert tree(tmp_path) == []


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="the superuser may write anywhere")
def test_write_protected_folders_and_files_stay_as_they_are(command, tmp_path):
    (tmp_path / "folder").mkdir(mode=0o555)
    (tmp_path / "a.exr").write_bytes(b"mine")
    (tmp_path / "a.exr").chmod(0o444)
    assert_refused(command, tmp_path, render(output="folder"), "write-protected")
    assert_refused(command, tmp_path, render(output="folder/a.exr"), "write-protected")
    assert_refused(command, tmp_path, render(output="a.exr"), "write-protected")
    assert (tmp_path / "a.exr").read_bytes() == b"mine"


def test_a_folder_that_is_gone_is_refused(command, tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    try:
        (tmp_path / "gone").rmdir()
    except OSError:
        pytest.skip("a current folder cannot be removed here")
    assert_refused(command, tmp_path, render(), "cannot write")
    monkeypatch.chdir(tmp_path)


def test_old_files_stay_when_the_command_is_refused(command, tmp_path):
    for ending in (".exr", ".png", ".error.png"):
        (tmp_path / f"a{ending}").write_bytes(b"mine")
    for changes in ({"spp": "0"}, {"sampler": "nothing"}, {"size": "100000x100000"}, {"threads": "0"}):
        assert command(*render(output="a.exr", **changes)).status == 2
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"mine"}


# --- the command line itself -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["rendr"], "unknown command 'rendr': did you mean render or predict?"),
        (["xqxqxq"], "unknown command 'xqxqxq': there are "),
        (["größe"], "unknown command 'größe'"),
        (["--nothing"], "--nothing"),
        (["render", "--nothing"], "--nothing"),
        (["render"], "--sampler"),
        (["render", "--sampler", "random"], "--spp"),
        (["render", "--sampler"], "--sampler"),
        ([*render(), "extra"], "extra"),
        ([*render(), "--full=yes"], "--full"),
        (["list", "samplers", "scenes"], "scenes"),
        (["list", "nothing"], "list nothing"),
        (["list", "", "disk"], "expected samplers, scenes, randomizers or plugins"),
        (["info"], "FILE"),
    ],
)
def test_wrong_use_of_the_command_line_is_one_line(command, tmp_path, arguments, reason):
    done = command(*arguments)
    assert (done.status, done.out) == (2, "")
    assert reason in done.error
    assert tree(tmp_path) == []


def test_an_option_is_given_once(command, tmp_path):
    done = command(*render(), "--sampler", "random")
    assert (done.status, done.error) == (2, "--sampler is given 2 times: expected it once")
    assert "--output" in command(*render(output="a.exr"), "-o", "b.exr").error
    assert tree(tmp_path) == []
    # What says the same twice says nothing else.
    assert command(*render(), "--no-error", "--no-error", "--json", "--json").status == 0


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a device that is always full")  # noqa: PTH110
@pytest.mark.parametrize("arguments", ["list", "--help", "render --sampler random --spp 1 --size 4 --json"])
def test_a_full_standard_output_is_one_line(tmp_path, arguments):
    with open("/dev/full", "w") as full:  # noqa: PTH123
        done = subprocess.run(
            [sys.executable, "-m", "samplekit", *arguments.split()],
            cwd=tmp_path,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith("samplekit: cannot write to standard output: No space left")
    assert "internal" not in done.stderr
    assert "Exception" not in done.stderr


def test_an_interrupt_before_anything_has_begun_is_silent(process):
    program = (
        "import sys\n"
        "class Interrupt:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'typer':\n"
        "            raise KeyboardInterrupt\n"
        "sys.meta_path.insert(0, Interrupt())\n"
        "from samplekit.__main__ import main\n"
        "main()"
    )
    assert process(program=("-c", program)) == (130, "", "")


def test_a_missing_command_of_a_plugin_of_ours_says_where_it_is(command, monkeypatch):
    monkeypatch.setenv("SAMPLEKIT_PLUGINS", "")
    registry.cache_clear()
    try:
        done = command("spectrum", "--sampler", "halton")
    finally:
        registry.cache_clear()
    assert done.status == 2
    assert "comes with the plugin samplekit-spectrum" in done.error


def test_without_arguments_there_is_help_and_no_complaint(command):
    done = command()
    assert done.status == 2
    assert done.err == ""
    assert "render" in done.out
    assert "Usage: samplekit" in done.out


def test_help_tells_of_every_option(command):
    text = command("render", "--help").out
    for option in ("--sampler", "--spp", "--scene", "--size", "--crop", "--seed", "--output", "--no-error", "--full"):
        assert option in text
    for option in ("--threads", "--explain", "--json", "--ssim", "--flip"):
        assert option in text
    # Brackets are not markup.
    assert "NAME[:OPTION=VALUE,...][+RANDOMIZER]" in text
    assert "W[xH]" in text
    assert command("render", "-h").out == text
    for name in ("list", "info", "points", "check", "new-plugin"):
        assert command(name, "--help").status == 0


def test_a_fault_of_ours_is_one_line_too(command, monkeypatch):
    def broken(*arguments, **more):
        raise LookupError("two\nlines")

    monkeypatch.setattr(renderer, "make_plan", broken)
    done = command(*render())
    assert done.status == 1
    assert "internal error: LookupError: two lines (SAMPLEKIT_TRACEBACK=1 shows where)" in done.error
    monkeypatch.setenv("SAMPLEKIT_TRACEBACK", "1")
    with pytest.raises(LookupError):
        command(*render())


def test_a_memory_that_ends_is_one_line(command, monkeypatch):
    def broken(*arguments, **more):
        raise MemoryError

    monkeypatch.setattr(renderer, "render_plan", broken)
    done = command(*render())
    assert (done.status, done.error) == (1, "out of memory")


def test_a_process_says_the_same(process, tmp_path):
    done = process(*render(sampler="hamersley"))
    assert (done.status, done.out) == (2, "")
    assert "did you mean hammersley" in done.error
    assert tree(tmp_path) == []
