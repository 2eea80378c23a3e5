"""Plugins that exit, stay silent or are half removed: named, and harmless to everybody else."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import samplekit

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
