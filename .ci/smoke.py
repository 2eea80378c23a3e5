"""A smoke test of an installation: render, compare and check a little, and hold the numbers to the recorded digests.

``python .ci/smoke.py`` fails where a digest differs: numbers do not depend on the versions of Python and of libraries.
``python .ci/smoke.py --record`` writes the digests of this installation.
"""

import hashlib
import json
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


def digest(*arrays: np.ndarray) -> str:
    found = hashlib.sha256()
    for array in arrays:
        found.update(np.ascontiguousarray(array).tobytes())
    return found.hexdigest()


def measure() -> dict[str, str]:
    """Return a digest for each request."""
    found = {}
    for scene, sampler, spp in RENDERINGS:
        result = samplekit.render(scene, sampler, spp, size=(64, 48))
        found[f"render {scene} {sampler} {spp}"] = digest(result.image, result.error)
    for spec in samplekit.samplers():
        if spec.dimensions[0] <= 2 and not spec.required_options and not spec.fresh_options:
            count = spec.counts.below(65, 2)
            if count and (spec.dimensions[1] is None or spec.dimensions[1] >= 2):
                found[f"points {spec.name}"] = digest(samplekit.points(spec.name, count, 2, realizations=3, seed=1))
    study = samplekit.compare(["random", "sobol+owen"], "gaussian", [4, 16], trials=16, size=(16, 16), times=False)
    found["compare"] = digest(np.array([[row.mse.estimate, row.mse.low, row.mse.high] for row in study.rows]))
    return found


def main() -> int:
    found = measure()
    if "--record" in sys.argv:
        RECORD.write_text(json.dumps(found, indent=1) + "\n")
        return 0
    expected = json.loads(RECORD.read_text())
    wrong = sorted(name for name in expected | found if expected.get(name) != found.get(name))
    wrong += [f"check {o.check}: {o.message}" for o in check_sampler("sobol+owen", quick=True) if o.status == "failed"]
    versions = ", ".join(f"{name} {version}" for name, version in samplekit.versions().items())
    print(f"{len(found) - len(wrong)} of {len(found)} digests agree with {versions}")
    for name in wrong:
        print(f"differs: {name}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
