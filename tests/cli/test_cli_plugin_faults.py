"""Plugins that exit, stay silent or are half removed: named, and harmless to everybody else."""

import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import samplekit
from samplekit._cli import run

TOY_SAMPLER = 'SamplerSpec("toy", "toy_points:Toy", "a toy")'
TOY_SCENE = 'SceneSpec("toy", "toy_scene:Toy", "a toy")'
RENDER_SCENE = ("render", "--scene", "toy", "--sampler", "random", "--spp", "4", "--size", "8")


def offer_scene(plugins, body):
    plugins.offer("toys", "scene", TOY_SCENE)
    plugins.module("toy_scene", f"import numpy as np\nfrom samplekit import Scene\n{body}")


def test_what_a_scene_does_not_write_is_no_result(plugins):
    offer_scene(plugins, "class Toy(Scene):\n  def sums(self, tile, boxes, out): pass")
    assert np.isnan(samplekit.render("toy", "random", 4, size=(8, 8), error=False).image).all()


def test_a_reference_that_is_not_finite_is_reported(command, plugins):
    body = (
        "class Toy(Scene):\n  def value(self, p): return p[0]\n  def exact(self, x, y): return np.full((8, 8), np.nan)"
    )
    offer_scene(plugins, body)
    done = command(*RENDER_SCENE)
    assert done.status == 1
    assert "internal" not in done.err


def test_a_hook_that_exits_does_not_end_the_program(command, plugins):
    plugins.add("toys", "import sys\n@hookimpl\ndef samplekit_samplers():\n    sys.exit(0)\n")
    done = command("list", "plugins")
    assert done.status == 0
    assert "SystemExit" in done.out


def test_a_distribution_without_metadata_is_unknown(command, plugins):
    plugins.offer("toys", "sampler", TOY_SAMPLER, metadata=False)
    assert command("list", "plugins").status == 0


def test_brackets_in_a_summary_are_no_markup(command, plugins):
    plugins.offer("toys", "command", "CommandSpec('juggle','toyp:x','a [/b] c')")
    done = command("--help")
    assert done.status == 0
    assert "[/b]" in done.out


@pytest.mark.parametrize("call", ["samplekit list >&-", "samplekit list nope --json 2>&-"])
def test_a_closed_stream_does_no_harm(tmp_path, call):
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", call],
        check=False,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env={**os.environ, "PATH": path},
    )
    assert "internal error" not in done.stdout + done.stderr
    assert done.stdout.count("\n") <= 1


def test_nobody_takes_a_command_of_ours(plugins):
    plugins.offer("toys", "command", "CommandSpec('render','toyp:x','mine')")
    (toys,) = [plugin for plugin in samplekit.plugins() if plugin.name == "toys"]
    assert toys.problems == ["command 'render': the name belongs to samplekit's own command"]


def test_a_command_of_two_plugins_is_chosen_by_its_plugin(command, plugins):
    for name in ("blocks", "cars"):
        plugins.offer(name, "command", f"CommandSpec('juggle','toy_{name}:juggle','')")
        plugins.module(f"toy_{name}", f"def juggle():\n    print('{name}')\n")
    assert "blocks/juggle or cars/juggle" in command("juggle").error
    assert command("cars/juggle").out == "cars\n"
    assert "blocks/juggle" in command("--help").out


@pytest.mark.parametrize("target", ["5", "lambda a: {}['b']"])
def test_what_is_no_command_is_named(command, plugins, target):
    plugins.offer("toys", "command", "CommandSpec('juggle','toy_command:juggle','')")
    plugins.module("toy_command", f"juggle = {target}")
    assert "command juggle of plugin toys" in command("juggle", "1").error


def test_what_a_plugin_prints_while_it_is_found_is_no_result(command, plugins):
    plugins.add("toys", "print('hello')\n")
    done = command("list", "--json")
    assert "plugins" in done.report
    assert done.err == "hello\n"


@pytest.mark.parametrize(
    "declared",
    [
        "options=(Option('r', float('inf'), '', 0, float('inf')),)",
        "options=(Option('r', float('nan')),)",
        "options=(Option('r', 1.0, object()),)",
        "expected_failures=[object()]",
        "fresh_options={'x': object()}",
        "reference=object()",
        "promises=(__import__('samplekit').MinimumDistance(float('nan')),)",
    ],
)
def test_declarations_that_are_no_plain_data_are_a_problem_of_their_plugin_alone(command, plugins, declared):
    plugins.offer("toys", "sampler", f"SamplerSpec('toy', 'toyp:X', 's', {declared})")
    report = command("list", "--json").report
    assert "toy" not in [sampler["name"] for sampler in report["samplers"]]
    (toys,) = [plugin for plugin in report["plugins"] if plugin["name"] == "toys"]
    assert len(toys["problems"]) == 1


@pytest.mark.parametrize(
    "body",
    [
        "Toy = dict",
        "class Toy(Scene):\n  def dimensions(self): return {'pixel': 'two'}",
        "class Toy(Scene):\n  def dimensions(self): return {}",
        "class Toy(Scene):\n  def dimensions(self): return {'pixel': 2.5}",
        "class Toy(Scene):\n  def value(self, p): return p[0]\n  def exact(self, x, y): return np.full((8, 8), 'a')",
        "class Toy(Scene):\n  def value(self, p): return p[0]\n  def constant(self, x, y): return np.full((8, 8), 'a')",
    ],
)
def test_a_scene_that_answers_nonsense_is_named(command, plugins, body):
    offer_scene(plugins, body)
    done = command(*RENDER_SCENE)
    assert done.status == 1
    assert done.error.startswith("scene toy of plugin toys (toys-distribution 1.0) cannot ")


def test_what_a_plugin_prints_at_work_is_no_result(command, plugins):
    plugins.offer("toys", "sampler", TOY_SAMPLER)
    body = "def fill(self, out, realizations, count, start):\n    print('noise')\n    out[...] = 0.5\n"
    plugins.module("toy_points", f"from samplekit import Sampler\nclass Toy(Sampler):\n  {body}")
    done = command("points", "--sampler", "toy", "--count", "2", "--json")
    assert done.report["points"] == [[[0.5, 0.5], [0.5, 0.5]]]
    assert set(done.err.split()) == {"noise"}
    study = "compare --sampler toy --scene disk --spp 4 --trials 8 --size 1 --no-time --threads 2 --json"
    assert command(*study.split()).report["rows"]
    # Beside its calls, and after them, standard output is as it was.
    assert command("points", "--sampler", "toy", "--count", "1").out == "realisation,index,x0,x1\n0,0,0.5,0.5\n"


@pytest.mark.parametrize(
    ("body", "status", "error"),
    [
        ("sys.exit('two\\nlines')", 1, "samplekit: two lines\n"),
        ("sys.exit(7)", 7, ""),
        ("sys.exit()", 0, ""),
        ("return 3", 3, ""),
        ("return True", 0, ""),
        ("return 10**400", 1, "expected an exit status from 0 to 255, or None\n"),
    ],
)
def test_a_command_that_ends_in_its_own_way_has_a_status(command, plugins, body, status, error):
    plugins.offer("toys", "command", "CommandSpec('juggle','toy_command:juggle','')")
    plugins.module("toy_command", f"import sys\ndef juggle():\n    {body}\n")
    done = command("juggle")
    assert done.status == status
    assert done.err.endswith(error)
    assert done.err.count("\n") == (1 if error else 0)


def test_a_command_whose_disk_is_full_is_one_line(plugins, monkeypatch):
    """Also where standard output is no file."""
    plugins.offer("toys", "command", "CommandSpec('juggle','toy_command:juggle','')")
    plugins.module("toy_command", "def juggle():\n    raise OSError(28, 'full')\n")
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    assert run(["juggle"]) == 1
