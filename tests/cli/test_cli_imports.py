"""What is not needed is not imported: names, help and completion need no mathematics and no implementation."""

import json
import os
import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

HEAVY = ["numpy", "scipy", "numba", "OpenImageIO", "skimage", "psutil", "matplotlib"]

DRIVER = """
import contextlib, io, json, sys

def here(*names):
    return sorted(name for name in sys.modules if any(name == n or name.startswith(n + ".") for n in names))

import samplekit
found = {{"import samplekit": here(*{heavy})}}
from samplekit._cli import run
for arguments in {commands}:
    with contextlib.redirect_stdout(io.StringIO()) as out:
        status = run(arguments)
    found[" ".join(arguments)] = [status, len(out.getvalue()) > 10, here(*{heavy})]
folders = ["samplers", "scenes", "randomizers"]
found["implementations"] = here(*["samplekit._builtin." + folder for folder in folders])
print(json.dumps(found))
"""


def driven(commands, heavy, tmp_path, **environment):
    done = subprocess.run(
        [sys.executable, "-c", DRIVER.format(commands=commands, heavy=heavy)],
        cwd=tmp_path,
        env={**os.environ, "TERM": "dumb", "COLUMNS": "200", **environment},
        capture_output=True,
        text=True,
        timeout=100,
        check=True,
    )
    return json.loads(done.stdout)


def test_version_help_and_lists_import_no_mathematics_and_no_implementation(tmp_path):
    commands = [
        ["--version"],
        ["--help"],
        ["render", "--help"],
        ["info", "--help"],
        ["check", "--help"],
        ["list", "--help"],
        ["list"],
        ["list", "--json"],
        ["list", "samplers"],
        ["list", "plugins"],
    ]
    found = driven(commands, HEAVY, tmp_path)
    assert found.pop("import samplekit") == []
    assert found.pop("implementations") == []
    assert found == {" ".join(arguments): [0, True, []] for arguments in commands}


@pytest.fixture
def completed(plugins, tmp_path):
    """What the shell would offer, in a process of its own, and the heavy modules that it took."""
    program = (
        "import atexit, sys\n"
        f"atexit.register(lambda: print(sorted(set({HEAVY}) & set(sys.modules)), file=sys.stderr))\n"
        "from samplekit._cli import main\nmain()"
    )

    def complete(words, place=None):
        place = len(words.split(" ")) - 1 if place is None else place
        done = subprocess.run(
            [sys.executable, "-c", program],
            cwd=tmp_path,
            env={
                **plugins.environment,
                "_SAMPLEKIT_COMPLETE": "complete_bash",
                "COMP_WORDS": words,
                "COMP_CWORD": str(place),
            },
            capture_output=True,
            text=True,
            timeout=100,
            check=True,
        )
        assert done.stderr == "[]\n"
        return done.stdout.split()

    return complete


def test_behind_a_command_that_is_none_completion_says_nothing_on_standard_error(completed):
    assert "--sampler" not in completed("samplekit nope ")


def test_the_shell_completes_names_of_ours_and_of_plugins(completed, plugins):
    plugins.add(
        "toys",
        """
        @hookimpl
        def samplekit_samplers():
            return [SamplerSpec("toy", "no_such_module:X", "")]

        @hookimpl
        def samplekit_scenes():
            return [SceneSpec("toy-scene", "no_such_module:X", "")]

        @hookimpl
        def samplekit_randomizers():
            return [RandomizerSpec("toy-randomizer", "no_such_module:X", "")]

        @hookimpl
        def samplekit_commands():
            return [CommandSpec("toy-command", "no_such_module:x", "")]
        """,
    )
    plugins.add("broken", "raise ValueError('at import')")
    samplers = completed("samplekit render --sampler ")
    assert {"halton", "sobol", "toy"} <= set(samplers)
    assert completed("samplekit render --sampler to") == ["toy"]
    assert completed("samplekit points --sampler hammer") == ["hammersley"]
    assert {"sobol+owen", "sobol+shift", "sobol+xor", "sobol+toy-randomizer"} <= set(
        completed("samplekit render --sampler sobol+")
    )
    assert {"disk", "zoneplate", "toy-scene"} <= set(completed("samplekit render --sampler toy --scene "))
    assert {"render", "list", "info", "toy-command"} <= set(completed("samplekit "))
    assert completed("samplekit rend") == ["render"]
    assert completed("samplekit list pl") == ["plugins"]


def test_rendering_without_error_imports_neither_metrics_nor_statistics(tmp_path):
    arguments = ["render", "--sampler", "sobol+owen", "--spp", "4", "--size", "8", "--scene", "disk"]
    heavy = ["skimage", "scipy.stats", "scipy.special"]
    found = driven([[*arguments, "--no-error", "--json"]], heavy, tmp_path)
    assert found[" ".join([*arguments, "--no-error", "--json"])] == [0, True, []]
    # Of the implementations those that were asked for.
    assert not {"samplekit._builtin.scenes.gaussian", "samplekit._builtin.samplers.radical_inverses"} & set(
        found["implementations"]
    )
    assert {"samplekit._builtin.scenes.disk", "samplekit._builtin.samplers.sobol"} <= set(found["implementations"])


def test_rendering_with_error_imports_no_statistics_and_no_scikit_image(tmp_path):
    arguments = ["render", "--sampler", "random", "--spp", "4", "--size", "8", "--scene", "disk"]
    assert driven([arguments], ["skimage", "scipy.stats"], tmp_path)[" ".join(arguments)] == [0, True, []]


def test_matplotlib_is_imported_only_when_something_is_drawn(tmp_path):
    compare = ["compare", "-s", "random", "-s", "jittered", "--scene", "disk", "--spp", "1,4", "--trials", "2"]
    commands = [
        ["list"],
        ["--help"],
        ["points", "--help"],
        ["render", "--sampler", "random", "--spp", "4", "--size", "8", "--scene", "disk"],
        [*compare, "--size", "4", "--no-time"],
        ["points", "--sampler", "random", "--count", "4"],
        ["points", "--sampler", "random", "--count", "4", "--output", "points.csv", "--json"],
        ["stability", "--scene", "offset", "--sampler", "random", "--count", "4", "--realizations", "2"],
    ]
    found = driven(commands, ["matplotlib", "PIL"], tmp_path)
    del found["import samplekit"], found["implementations"]
    assert found == {" ".join(arguments): [0, True, []] for arguments in commands}
    assert {path.name for path in tmp_path.glob("*.png")} == {"disk-random-4spp.png", "disk-random-4spp.error.png"}


def test_pictures_need_no_windows_and_no_global_figures(tmp_path):
    arguments = ["points", "--sampler", "random", "--count", "4", "--output", "points.svg"]
    found = driven([arguments], ["matplotlib.pyplot", "tkinter"], tmp_path)
    assert found[" ".join(arguments)] == [0, True, []]


def test_the_public_names_are_loaded_when_they_are_used():
    code = (
        "import sys, samplekit\n"
        "assert set(samplekit.__all__) <= set(dir(samplekit))\n"
        "samplekit.SamplerSpec, samplekit.hookimpl, samplekit.UsageError\n"
        "assert 'numpy' not in sys.modules\n"
        "from samplekit import *\n"
        "assert points is samplekit.points and render is samplekit.render\n"
        "try:\n    samplekit.nothing\nexcept AttributeError as error:\n    assert 'nothing' in str(error)\n"
        "else:\n    raise AssertionError\n"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)
