"""Numbers of every sampler, randomizer and scene at tiny sizes, as one JSON object: floats in hexadecimal, to the bit.

python platform_numbers.py [LIBRARY]; the library, if there is one, has had the processor flush denormals to zero.
"""

from __future__ import annotations

import ctypes
import json
import sys

if len(sys.argv) > 1:
    ctypes.CDLL(sys.argv[1]).flush_denormals_to_zero()

import numpy as np

import samplekit
from samplekit import scene as configured_scene
from samplekit._registry import registry


def numbers() -> dict[str, list[str]]:
    found = {}
    for name, offer in registry().all("sampler").items():
        options = {option.name: option for option in offer.spec.options}
        if not any(option.required for option in options.values()):
            suffixes = ("", "+owen", "+shift", "+xor") if name in ("halton", "sobol") else ("",)
            for suffix in suffixes:
                text = name + (":bank=0" if "bank" in options else "") + suffix
                found[text] = _hexadecimal(_points(samplekit.sampler(text)))
    for name in registry().all("scene"):
        scene, edges = configured_scene(name), np.array([0.3, 0.41])
        sums = np.empty(1)
        tile = np.random.default_rng(0).random((1, scene.dims, 4))
        scene.sums(tile, np.array([[0.3], [0.11], [0.3], [0.11]]), sums)
        found[f"sums of {name}"] = _hexadecimal(sums)
        found[f"mean of {name}"] = _hexadecimal(scene.exact(edges, edges))
    return found


def _points(sampler: samplekit.Sampler) -> np.ndarray:
    dims = min(2, sampler.spec.dimensions[1] or 2)
    for count in (4, 8, 9):
        try:
            return sampler.points(count, dims, seed=7)
        except samplekit.UsageError:
            continue
    raise AssertionError(f"{sampler.text} makes no small set")


def _hexadecimal(values: np.ndarray) -> list[str]:
    return [float(value).hex() for value in np.ravel(values)]


if __name__ == "__main__":
    sys.stdout.write(json.dumps(numbers()))
