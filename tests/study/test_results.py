"""Results as JSON: they are read back unchanged, and damaged or foreign text is refused."""

import json
import math
import sys
from dataclasses import replace

import pytest

import samplekit
from samplekit._errors import UsageError
from samplekit._study.results import SCHEMA, from_json, to_json


@pytest.fixture(scope="module")
def results():
    ask = {"trials": 3, "size": (1, 1), "seed": 2**64 - 1, "budget": 0.0}
    return samplekit.compare(["random", "hammersley", "jittered"], ["disk", "step:offset=0.5"], [4, 5, 16], **ask)


def test_results_come_back_as_they_were(results):
    text = to_json(results)
    assert from_json(text) == results
    plain = json.loads(text, parse_constant=pytest.fail)
    assert (plain["schema"], plain["level"], plain["seed"]) == (SCHEMA, 0.95, str(2**64 - 1))
    assert any(row.mse.estimate == 0.0 for row in results.rows)


def test_old_results_have_no_crossings(results):
    plain = json.loads(to_json(results))
    del plain["crossings"]
    assert from_json(json.dumps(plain)) == replace(results, crossings=[])


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"schema": "samplekit.study/0"}, "version 'samplekit.study/0'.*run the study anew"),
        ({"trials": "many"}, "damaged"),
        ({"surprise": 1}, "damaged"),
        ({"rows": [{}]}, "damaged"),
    ],
)
def test_other_versions_and_damage_are_refused(results, change, message):
    with pytest.raises(UsageError, match=message):
        from_json(json.dumps(json.loads(to_json(results)) | change))
    with pytest.raises(UsageError, match="expected one JSON object"):
        from_json("[1, 2")


def test_values_beyond_float_have_no_estimate(plugins):
    plugins.module(
        "huge",
        """
        import numpy as np
        from samplekit import Scene

        class Huge(Scene):
            def value(self, points):
                return np.where(points[0] < 0.5, 1e200, -1e200)

            def exact(self, x_edges, y_edges):
                return np.zeros((y_edges.size - 1, x_edges.size - 1))
        """,
    )
    plugins.offer("hugeness", "scene", 'SceneSpec("huge", "huge:Huge", "squares beyond float64")')
    found = samplekit.compare("random", "huge", 3, trials=5, size=(1, 1), times=False)
    (row,) = found.rows
    assert row.mse.estimate is None or math.isfinite(row.mse.estimate)
    assert not row.fitted
    assert from_json(to_json(found)) == found


def test_dask_that_is_not_installed(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UsageError, match=r"samplekit-core\[dask\]"):
        samplekit.compare("random", "disk", 4, trials=2, size=(1, 1), dask="tcp://nowhere:1")
