"""What holds for the scenes alike: crops and tiles change no bit, constants and compilation neither."""

import os
import subprocess
import sys

import numpy as np
import pytest

import samplekit

TEXTS = ["bilinear", "checker:cells=11", "disk", "gaussian", "step:angle=33,offset=0.7", "zoneplate"]


@pytest.mark.parametrize("text", TEXTS)
def test_sums_are_the_same_bits_in_any_tile(text, boxes_of, sums):
    scene = samplekit.scene(text)
    edges = np.arange(8) / 7
    boxes = boxes_of(edges, edges)
    tile = np.random.default_rng(3).random((49, 2, 53))
    whole = sums(scene, tile, boxes)
    for size in (1, 3, 16):
        parts = [
            sums(scene, tile[i : i + size], np.ascontiguousarray(boxes[:, i : i + size])) for i in range(0, 49, size)
        ]
        assert np.array_equal(np.concatenate(parts), whole)


@pytest.mark.parametrize(
    "text",
    [*TEXTS, "gaussian:sigma=1e-3", "zoneplate:k=1024,cx=0.3,cy=0.6", "zoneplate:k=1e7,cx=0.3,cy=0.6"],
)
def test_exact_of_a_crop_is_the_crop_of_the_exact(text):
    edges = np.arange(129) / 128
    scene = samplekit.scene(text)
    assert np.array_equal(scene.exact(edges[30:71], edges[13:100]), scene.exact(edges, edges)[13:99, 30:70])


NUMBERS = """
import sys
import numpy as np
import samplekit
random = np.random.default_rng(24)
edges = np.arange(25) / 24
out = np.empty(8)
scene = samplekit.scene(sys.argv[1])
scene.sums(random.random((8, 2, 16)), random.random((4, 8)), out)
print(scene.exact(edges, edges).tobytes().hex(), out.tobytes().hex())
"""


@pytest.mark.parametrize("text", ["disk", "step:angle=33,offset=0.7"])
def test_numbers_are_the_same_without_compiling(text):
    compiled, interpreted = (
        subprocess.run(
            [sys.executable, "-c", NUMBERS, text],
            env={**os.environ, "NUMBA_DISABLE_JIT": disabled},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for disabled in ("0", "1")
    )
    assert compiled == interpreted


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        *((f"checker:cells={cells}", "checker: option cells") for cells in ("0", "-1", 2**20 + 1, "2.5")),
        *((f"disk:radius={radius}", "radius") for radius in ("-0.1", "nan", "inf", "1e200", "1e-200")),
        ("disk:cx=nan", "cx"),
        ("disk:cy=-inf", "cy"),
        ("ellipse:cx=1e61", "ellipse: option cx"),
        *((f"gaussian:sigma={sigma}", "gaussian: option sigma") for sigma in ("0", "-1", "nan", "inf")),
        ("gaussian:cx=1e51", "gaussian: option cx"),
        *((f"step:angle={angle}", "angle") for angle in ("nan", "inf")),
        ("step:offset=nan", "offset"),
        ("step:offset=1e200", "offset"),
        ("step:width=1e-200", "step: width"),
        ("spike:cx=2.5", "spike: option cx"),
        *((f"zoneplate:k={k}", "zoneplate: option k") for k in ("-1", "inf", "nan")),
        ("zoneplate:cx=1e101", "zoneplate: option cx"),
        ("zoneplate:cy=nan", "zoneplate: option cy"),
    ],
)
def test_options_out_of_range_are_refused_in_one_line(text, reason):
    with pytest.raises(samplekit.UsageError, match=reason) as caught:
        samplekit.scene(text)
    assert "\n" not in str(caught.value)
