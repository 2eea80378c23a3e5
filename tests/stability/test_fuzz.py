"""A small part of what benchmarks/fuzz.py does: requests and files that nobody wrote on purpose."""

import io
import os
import pickle
import signal

import numpy as np
import pytest
from fuzzing.cases import CASES
from fuzzing.doors import Doors
from fuzzing.files import Bomb

from samplekit import UsageError
from samplekit.commands import _notices as notices
from samplekit.files._pointsets.formats import read_points

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def doors(tmp_path_factory):
    handler, folder, environment = signal.getsignal(signal.SIGINT), os.getcwd(), dict(os.environ)  # noqa: PTH109
    announce = notices.announce_compilation
    yield Doors(tmp_path_factory.mktemp("doors"))
    notices.announce_compilation = announce
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    signal.signal(signal.SIGINT, handler)


@pytest.mark.skipif(not hasattr(signal, "SIGALRM"), reason="needs an alarm")
@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize(("kind", "number"), [("commands", 50), ("strings", 2000), ("files", 30), ("plugins", 20)])
def test_no_request_and_no_file_is_answered_wrongly(doors, kind, number):
    cases = [CASES[kind](doors, f"test {kind} {k}") for k in range(number)]
    assert [case for case in cases if case.wrong] == []
    assert any(case.status == 0 for case in cases)


@pytest.mark.parametrize("ending", [".npy", ".csv", ".bin", ".dat"])
def test_points_are_read_without_executing_anything(tmp_path, ending):
    """An array of Python objects, and a bare pickle: what they would do does not happen."""
    bomb = Bomb(tmp_path / "executed")
    array = io.BytesIO()
    np.save(array, np.array([[bomb]], object), allow_pickle=True)
    for data in (array.getvalue(), pickle.dumps(bomb)):
        path = tmp_path / f"a{ending}"
        path.write_bytes(data)
        with pytest.raises(Exception) as refusal:  # noqa: PT011 - which one depends on the ending
            read_points(path)
        assert isinstance(refusal.value, UsageError) or "damaged" in str(refusal.value)
        assert not (tmp_path / "executed").exists()
    pickle.loads(pickle.dumps(bomb))
    assert (tmp_path / "executed").exists()
