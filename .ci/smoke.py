"""A smoke test of an installation: render, compare and check a little, and hold the numbers to the recorded ones.

``python .ci/smoke.py`` fails where a number differs. Points and images are equal bit for bit under every version of
Python and of the libraries. References and intervals go through special functions of NumPy and SciPy, whose last bit
changes between versions: they agree to 1e-12 of their size.
``python .ci/smoke.py --record`` writes the numbers of this installation.
"""

import hashlib
import json
import math
import sys
from pathlib import Path

import numpy as np

import samplekit
from samplekit.testing import check_sampler

RECORD = Path(__file__).with_name("smoke.json")
RENDERINGS = [
    ("zoneplate", "hammersley", 16),
    ("disk", "sobol+owen", 16),
    ("gaussian", "halton+owen", 9),
    ("step:width=1e-3", "correlated-multi-jittered", 16),
    ("depth-of-field", "uncorrelated-jitter", 16),
    ("motion-blur", "random", 4),
]


def digest(array: np.ndarray) -> str:
    return hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()


def measure() -> dict[str, str | float]:
    """Return a digest of each image and point set, and each root mean square error and bound of an interval."""
    found: dict[str, str | float] = {}
    for scene, sampler, spp in RENDERINGS:
        result = samplekit.render(scene, sampler, spp, size=(64, 48))
        found[f"image {scene} {sampler} {spp}"] = digest(result.image)
        found[f"error {scene} {sampler} {spp}"] = math.sqrt(np.square(result.error).mean())
    for spec in samplekit.samplers():
        if spec.dimensions[0] <= 2 and not spec.required_options and not spec.fresh_options:
            count = spec.counts.below(65, 2)
            if count and (spec.dimensions[1] is None or spec.dimensions[1] >= 2):
                found[f"points {spec.name}"] = digest(samplekit.points(spec.name, count, 2, realizations=3, seed=1))
    study = samplekit.compare(["random", "sobol+owen"], "gaussian", [4, 16], trials=16, size=(16, 16), times=False)
    for row in study.rows:
        for part in ("estimate", "low", "high"):
            found[f"mse {part} {row.sampler} {row.count}"] = getattr(row.mse, part)
    return found


def agrees(found: str | float | None, expected: str | float | None) -> bool:
    if isinstance(found, float) and isinstance(expected, float):
        return math.isclose(found, expected, rel_tol=1e-12)
    return found == expected


def main() -> int:
    found = measure()
    if "--record" in sys.argv:
        RECORD.write_text(json.dumps(found, indent=1) + "\n")
        return 0
    expected = json.loads(RECORD.read_text())
    wrong = sorted(name for name in expected | found if not agrees(found.get(name), expected.get(name)))
    wrong += [f"check {o.check}: {o.message}" for o in check_sampler("sobol+owen", quick=True) if o.status == "failed"]
    versions = ", ".join(f"{name} {version}" for name, version in samplekit.versions().items())
    print(f"{len(found) - len(wrong)} of {len(found)} numbers agree with {versions}")
    for name in wrong:
        print(f"differs: {name}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
