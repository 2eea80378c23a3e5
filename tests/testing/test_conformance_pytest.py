"""The suite through pytest: by name, and by a class for a sampler that is not installed."""

import subprocess
import sys

import pytest

pytestmark = pytest.mark.slow

PYTEST = ("pytest", "-q", "-p", "no:cacheprovider", "-rA")
FEW = "strata or range or light or elementary"
SUITE = (*PYTEST, "--pyargs", "samplekit.testing", "--samplekit-quick")


def test_by_name(samplekit_with, tmp_path):
    names = ("--sampler", "known", "--sampler", "pessimist", "--sampler", "not-latin")
    result = samplekit_with(*SUITE, *names, "-k", FEW, cwd=tmp_path)
    assert result.returncode == 1
    assert "XFAIL" in result.stdout
    assert "a first try" in result.stdout
    assert "[XPASS(strict)] might reach 1" in result.stdout
    assert "2 failed" in result.stdout
    assert "1 xfailed" in result.stdout
    assert "it promises no net" in result.stdout
    # A failure shows its counter-example alone.
    assert "holds 2 points, expected 1" in result.stdout
    assert "Traceback" not in result.stdout


def test_wrong_names_are_one_line(samplekit_with, tmp_path):
    result = samplekit_with(*SUITE, "--sampler", "sobool", cwd=tmp_path)
    assert result.returncode == 4
    assert "unknown sampler 'sobool': did you mean sobol" in result.stderr
    assert result.stderr.strip().count("\n") == 0
    result = samplekit_with(*SUITE, "--sampler", "misspelt", cwd=tmp_path)
    assert result.returncode == 4
    assert "unknown check 'rnage'" in result.stderr


def test_without_a_name_it_says_how(samplekit_with, tmp_path):
    result = samplekit_with(*SUITE, cwd=tmp_path)
    assert result.returncode == 0
    assert "say what is judged: --sampler NAME or --scene NAME" in result.stdout


def test_a_class_for_what_is_not_installed(samplekit_with, tmp_path):
    (tmp_path / "test_mine.py").write_text(
        "from samplekit import LatinStrata, SamplerSpec\n"
        "from samplekit.testing import SamplerConformance\n\n"
        "class TestMine(SamplerConformance):\n"
        "    quick = True\n"
        "    def specs(self):\n"
        "        promises = (LatinStrata(),)\n"
        "        return [SamplerSpec('mine', 'faulty_samplers:Plain', 'mine', promises=promises)]\n"
    )
    result = samplekit_with(*PYTEST, "test_mine.py", "-k", FEW, cwd=tmp_path)
    assert "FAILED test_mine.py::TestMine::test_conformance[mine-strata]" in result.stdout
    assert "1 failed" in result.stdout
    assert "SKIPPED" in result.stdout
    assert "it is not installed" in result.stdout


def test_the_plugin_imports_little():
    """It is loaded in every run of pytest in its environment."""
    program = (
        "import sys, pytest; before = set(sys.modules); import samplekit.testing._pytest_plugin;"
        "print(*sorted({m.partition('.')[0] for m in set(sys.modules) - before}))"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert result.stdout.split() == ["lazy_loader", "samplekit"]


def test_checks_need_no_pytest():
    program = "import sys; import samplekit.testing._suite; sys.exit('pytest' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
