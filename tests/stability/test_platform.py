"""The same numbers and words everywhere: without the compiler, optimised, with denormals flushed, in any locale."""

import json
import locale
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import samplekit
from samplekit._cli import run

pytestmark = pytest.mark.slow

HERE = Path(__file__).parent
PROGRAM = (str(HERE / "platform_numbers.py"),)
FLUSH = """
#include <xmmintrin.h>
void flush_denormals_to_zero(void) { _mm_setcsr(_mm_getcsr() | 0x8040); }
"""


def answer(arguments, folder, **environment):
    """What a Python process wrote to standard output in UTF-8; standard error stays empty."""
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**os.environ, "TERM": "dumb", "COLUMNS": "100", **environment},
        capture_output=True,
        timeout=300,
        check=False,
    )
    err = [line for line in done.stderr.decode().splitlines() if not line.startswith("samplekit: compiling kernels")]
    assert (done.returncode, err) == (0, [])
    return done.stdout.decode()


@pytest.fixture(scope="module")
def numbers(tmp_path_factory):
    return json.loads(answer(PROGRAM, tmp_path_factory.mktemp("numbers")))


def test_without_the_compiler_and_docstrings_and_asserts_every_bit_is_the_same(numbers, tmp_path):
    """Samplers, randomizers and scenes; in one process, since each optimisation level compiles kernels of its own."""
    assert len(numbers) > 50
    found = json.loads(
        answer(PROGRAM, tmp_path, NUMBA_DISABLE_JIT="1", PYTHONOPTIMIZE="2", PYTHONDONTWRITEBYTECODE="1")
    )
    assert found == numbers


@pytest.fixture(scope="module")
def flush(tmp_path_factory):
    """A library as others are that set the processor's flush-to-zero and denormals-are-zero."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    folder = tmp_path_factory.mktemp("flush")
    if compiler is None or not sys.platform.startswith("linux"):
        pytest.skip("needs a C compiler")
    (folder / "flush.c").write_text(FLUSH)
    done = subprocess.run(
        [compiler, "-O1", "-shared", "-fPIC", "flush.c", "-o", "flush.so"], cwd=folder, capture_output=True, check=False
    )
    if done.returncode:
        pytest.skip("the processor has no such register")
    return folder / "flush.so"


def test_with_denormals_flushed_to_zero_every_bit_is_the_same(numbers, flush, tmp_path):
    assert json.loads(answer((*PROGRAM, str(flush)), tmp_path)) == numbers


def test_an_image_has_the_same_bits_from_a_process_that_flushes_denormals(flush, tmp_path):
    """Threads included, which have registers of their own; no library warns."""
    program = (
        f"import ctypes, sys; ctypes.CDLL({str(flush)!r}).flush_denormals_to_zero()\n"
        "assert 5e-324 * float(sys.argv[1]) == 0.0, 'denormals are there'\n"
        "import numpy, samplekit\n"
        "made = samplekit.render('gaussian', 'sobol+owen', 16, size=(16, 16), threads=2)\n"
        "print((made.image.tobytes() + made.error.tobytes()).hex())"
    )
    here = samplekit.render("gaussian", "sobol+owen", 16, size=(16, 16))
    assert answer(("-c", program, "1"), tmp_path).strip() == (here.image.tobytes() + here.error.tobytes()).hex()


@pytest.mark.parametrize("scene", ["disk", "depth-of-field"])
def test_threads_change_no_bit(scene):
    one, two = (samplekit.render(scene, "jittered", 16, size=(40, 24), seed=5, threads=t) for t in (1, 2))
    assert np.array_equal(one.image, two.image)
    assert np.array_equal(one.error, two.error)
    assert one.metrics == two.metrics


def test_threads_change_no_number_of_a_study():
    one, two = (
        samplekit.compare(["random", "sobol+owen"], "disk", [4, 16], trials=32, size=(4, 4), times=False, threads=t)
        for t in (1, 2)
    )
    assert [(row.mse, row.variance, row.bias) for row in one.rows] == [
        (row.mse, row.variance, row.bias) for row in two.rows
    ]


def test_optimised_checks_and_help_are_there(tmp_path):
    """No check is an assert, and no docstring is needed: wrong use is refused, and a broken sampler is found out."""
    program = (
        "from samplekit._cli import run\n"
        "from mutants import MUTANTS\n"
        "assert False\n"
        "codes = [run(['render', '-s', 'jittered', '-n', '7', '--size', '8'])]\n"
        "codes += [run(['--help']), run(['points', '--help'])]\n"
        "codes.append(run(['check', 'jittered', '--quick', '--only', 'range']))\n"
        "print(codes, MUTANTS[0].spec().summary)"
    )
    path = os.pathsep.join(filter(None, [str(Path(__file__).parents[1] / "testing"), os.environ.get("PYTHONPATH")]))
    done = subprocess.run(
        [sys.executable, "-OO", "-c", program],
        cwd=tmp_path,
        env={
            **os.environ,
            "PYTHONPATH": path,
            "NUMBA_DISABLE_JIT": "1",
            "TERM": "dumb",
            "PYTHONDONTWRITEBYTECODE": "1",
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert "[2, 0, 0, 0]" in done.stdout, done.stdout + done.stderr
    assert "samplekit: jittered makes" in done.stderr
    assert "the points of a sampler" in done.stdout
    assert "Traceback" not in done.stderr


LOCALES = {"C": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}, "German": {"LC_ALL": "de_DE.UTF-8"}}


@pytest.mark.parametrize("environment", LOCALES.values(), ids=LOCALES)
def test_words_and_numbers_in_any_locale(environment, tmp_path):
    """A study, points and what is listed, on a terminal of letters as the locale has them: points in all decimals."""
    program = (
        "import locale, sys\n"
        "try: locale.setlocale(locale.LC_ALL, '')\n"
        "except locale.Error: pass\n"
        "from samplekit._cli import run\n"
        "for words in ('points -s random -n 2 -o a.csv', 'points -s halton -n 3', 'list', '--help', 'render --help',\n"
        "  'compare -s random -s jittered --scene gaussian --spp 4,16 --trials 8 --size 1 --budget 0.1 -o study',\n"
        "  'stability -s random --scene spike:area=0.1 --count 4',\n"
        "  'predict -s jittered --scene disk -n 4 --trials 50',\n"
        "  'points -s random -n é', 'list samplers größe', 'info é.exr'):\n"
        "    print(run(words.split()))\n"
    )
    (tmp_path / "program.py").write_text(program, "utf-8")
    done = subprocess.run(
        [sys.executable, "program.py"],
        cwd=tmp_path,
        env={**os.environ, "TERM": "dumb", **environment},
        capture_output=True,
        check=False,
    )
    out, err = done.stdout.decode("ascii" if "PYTHONUTF8" in environment else "utf-8"), done.stderr.decode()
    assert done.returncode == 0, err
    statuses = [line for line in out.splitlines() if line.isdigit()]
    assert statuses == ["0"] * 8 + ["2"] * 3, out + err
    assert "Traceback" not in err
    assert "internal error" not in err
    assert out.count("0.5,0.3333333333333333") == 1
    assert (tmp_path / "a.csv").read_text("utf-8").count(".") == 4
    results = json.loads((tmp_path / "study" / "results.json").read_text("utf-8"))
    assert len(results["rows"]) == 4
    assert "é" not in err or environment.get("LC_ALL") != "C"


def test_decimal_commas_of_a_locale_change_no_number(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    before = locale.setlocale(locale.LC_ALL)
    try:
        locale.setlocale(locale.LC_ALL, "de_DE.UTF-8")
    except locale.Error:
        pytest.skip("no such locale")
    try:
        assert run(["points", "-s", "halton", "-n", "2"]) == 0
    finally:
        locale.setlocale(locale.LC_ALL, before)
    assert capsys.readouterr().out.splitlines()[2] == "0,1,0.5,0.3333333333333333"
