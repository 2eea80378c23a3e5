"""What a request does not need is neither drawn, nor sampled, nor computed, nor imported."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import samplekit
from samplekit import UsageError

OURS = [
    "samplekit.quadrature._numerical",
    "samplekit.quadrature._pixel_means",
    "samplekit.quadrature._pieces",
    "samplekit.quadrature._kept_means",
    "samplekit.files._cache",
    "samplekit._metrics",
    "samplekit._builtin.scenes.depth_of_field",
    "samplekit._builtin.scenes.depth_of_field_bounds",
    "samplekit._builtin.scenes.depth_of_field_lens",
    "samplekit._builtin.scenes.motion_blur",
    "samplekit._builtin.scenes.motion_blur_means",
    "samplekit._builtin.scenes.ambient_occlusion",
    "samplekit.files._pointsets",
]
FOREIGN = [
    "numpy",
    "numba",
    "OpenImageIO",
    "scipy.special",
    "scipy.linalg",
    "scipy.stats",
    "skimage",
    "psutil",
    "platformdirs",
]

DRIVER = """
import contextlib, io, json, sys
from samplekit._cli import run
with contextlib.redirect_stdout(io.StringIO()):
    status = run({arguments})
print(json.dumps([status, sorted(set({names}) & set(sys.modules)), len(sys.modules)]))
"""

RENDER = ["render", "--sampler", "random", "--spp", "4", "--size", "8", "--scene"]


def imported(arguments, folder):
    """The modules of interest that a command imported, and the number of all its modules."""
    done = subprocess.run(
        [sys.executable, "-c", DRIVER.format(arguments=arguments, names=OURS + FOREIGN)],
        cwd=folder,
        env={**os.environ, "TERM": "dumb"},
        capture_output=True,
        text=True,
        timeout=200,
        check=True,
    )
    status, names, total = json.loads(done.stdout)
    assert status == 0
    return set(names), total


ADAPTIVE = {"_pixel_means", "_pieces", "_kept_means"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "ours"),
    [
        ("--version", set()),
        ("list scenes", set()),
        ("render disk", {"_metrics"}),
        ("render depth-of-field --no-error", {"depth_of_field", "depth_of_field_bounds"}),
        (
            "render depth-of-field:pixel-filter=center",
            {"depth_of_field", "depth_of_field_bounds", "depth_of_field_lens", "_metrics"},
        ),
        (
            "render depth-of-field",
            {"depth_of_field", "depth_of_field_bounds", "depth_of_field_lens", "_metrics", *ADAPTIVE},
        ),
        ("render motion-blur --no-error", {"motion_blur"}),
        ("render ambient-occlusion --no-error", {"ambient_occlusion"}),
    ],
)
def test_each_command_imports_what_it_uses_and_nothing_else(tmp_path, command, ours):
    verb, *rest = command.split()
    names, total = imported([*RENDER, *rest] if verb == "render" else [verb, *rest], tmp_path)
    assert {name.rpartition(".")[2] for name in names & set(OURS)} == ours
    assert names - set(OURS) == ({"numpy", "numba", "OpenImageIO"} if verb == "render" else set())
    # Counted with NumPy 2.4 and numba 0.68: 163 and 303 modules, and about 740 for a rendering.
    assert total < (1000 if verb == "render" else 450)


@pytest.mark.slow
def test_a_sampler_that_cannot_names_those_that_can():
    with pytest.raises(UsageError) as caught:
        samplekit.render("depth-of-field", "n-rooks", 16, size=(4, 4))
    message = str(caught.value)
    assert message.startswith("n-rooks makes points in 2 dimensions, not 4: depth-of-field needs pixel 2, lens 2; ")
    able = message.rpartition("; ")[2].removesuffix(" can").split(", ")
    assert {"random", "latin-hypercube", "sobol", "halton", "jittered"} <= set(able)
    assert "n-rooks" not in able
    for sampler in able:
        samplekit.render("depth-of-field", sampler, 16, size=(2, 2), error=False)
    # 17 points form no grid: those that want one are not named.
    with pytest.raises(UsageError) as caught:
        samplekit.estimate("ambient-occlusion", "van-der-corput", 17)
    assert "pixel 2, direction 2" in str(caught.value)
    assert "jittered" not in str(caught.value)


@pytest.mark.parametrize("sampler", ["random", "sobol+owen", "halton+owen", "latin-hypercube", "uncorrelated-jitter"])
def test_dropping_later_dimensions_does_not_change_those_before(sampler):
    # uncorrelated-jitter shuffles blocks, and its first block is the pixel's.
    three = samplekit.scene("motion-blur:aperture=0.1")
    pixel_of = {}
    for options in ("shutter=0", "shutter=0.5", "shutter=0.5,aperture=0.1"):
        scene = samplekit.scene(f"motion-blur:{options}")
        seen = []
        inner = scene._scene

        class Spy:
            def __getattr__(self, name, inner=inner):
                return getattr(inner, name)

            def sums(self, tile, boxes, out, inner=inner, seen=seen):
                seen.append(tile[:, :2].copy())
                inner.sums(tile, boxes, out)

        scene._scene = Spy()
        samplekit.estimate(scene, sampler, 16, realizations=3)
        pixel_of[options] = np.concatenate(seen)
    first, *others = pixel_of.values()
    assert three.blocks == (2, 2, 1)
    for other in others:
        np.testing.assert_array_equal(first, other)


def test_the_plan_explains_which_purposes_are_left_out():
    result = samplekit.render("motion-blur:pixel-filter=center", "random", 4, size=(4, 4), error=False)
    lines = "\n".join(result.plan.explain())
    assert "dimensions: 1 (time 1)" in lines
    assert "left out: the dimensions of pixel, lens: not needed with these options" in lines
    assert "left out: the reference, the error and the metrics (--no-error)" in lines
