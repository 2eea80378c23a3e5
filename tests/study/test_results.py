"""Results as JSON: they are read back unchanged, and damaged or foreign text is refused."""

import json
import math
import sys
from dataclasses import asdict

import pytest

import samplekit
from samplekit._errors import UsageError
from samplekit._study.results import SCHEMA


@pytest.fixture(scope="module")
def results():
    ask = {"trials": 3, "size": (1, 1), "seed": 2**64 - 1, "budget": 0.0}
    return samplekit.compare(["random", "hammersley", "jittered"], ["disk", "step:offset=0.5"], [4, 5, 16], **ask)


def test_results_are_plain_data_with_all_digits(results):
    plain = json.loads(json.dumps(results.as_json(), allow_nan=False))
    assert (plain["schema"], plain["level"], plain["seed"]) == (SCHEMA, 0.95, str(2**64 - 1))
    assert [row["mse"] for row in plain["rows"]] == [asdict(row.mse) for row in results.rows]
    assert any(row.mse.estimate == 0.0 for row in results.rows)


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
    json.dumps(found.as_json(), allow_nan=False)


def test_dask_that_is_not_installed(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(UsageError, match=r"samplekit-core\[dask\]"):
        samplekit.compare("random", "disk", 4, trials=2, size=(1, 1), dask="tcp://nowhere:1")
