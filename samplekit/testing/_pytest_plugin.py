"""The pytest plugin: ``pytest --pyargs samplekit.testing --sampler NAME``, and classes in test files.

It is imported in every run of pytest in its environment: its top level imports pytest alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from samplekit.testing._suite import Case

_CASES = pytest.StashKey["list[Case]"]()
FIXTURE = "samplekit_case"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options that name what is judged."""
    group = parser.getgroup("samplekit", "conformance of samplers and scenes")
    for kind, example in (("sampler", "halton+owen"), ("scene", "disk:radius=0.4")):
        text = f"judge this {kind}, such as {example} (may be repeated)"
        group.addoption(f"--{kind}", action="append", default=[], metavar="NAME", help=text)
    group.addoption("--samplekit-quick", action="store_true", help="smaller samples, no other processes: seconds")


def pytest_configure(config: pytest.Config) -> None:
    """Look up what is judged: a wrong name ends in one line, before any test is collected."""
    asked: dict[Any, list[str]] = {kind: config.getoption(f"--{kind}") for kind in ("sampler", "scene")}
    config.stash[_CASES] = []
    if not any(asked.values()):
        return
    from samplekit._errors import SamplekitError
    from samplekit.testing._suite import make_cases

    try:
        for kind, names in asked.items():
            for name in dict.fromkeys(names):
                config.stash[_CASES] += make_cases(name, kind, quick=config.getoption("--samplekit-quick"))
    except SamplekitError as error:
        raise pytest.UsageError(str(error)) from None


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Make a test of each check: of the samplers that the command names, or of those that a class declares."""
    if FIXTURE not in metafunc.fixturenames:
        return
    if metafunc.cls is not None and hasattr(metafunc.cls, "cases"):
        # An error here is the author's: in a declaration, or in specs().
        cases = metafunc.cls().cases()
    else:
        cases = metafunc.config.stash[_CASES]
    nothing = pytest.param(None, marks=pytest.mark.skip(reason="say what is judged: --sampler NAME or --scene NAME"))
    metafunc.parametrize(FIXTURE, [_parameter(case) for case in cases] or [nothing], indirect=True)


def _parameter(case: Case) -> Any:
    marks = [pytest.mark.xfail(reason=case.expected, strict=True)] if case.expected else []
    recipe = case.subject.recipe
    name = recipe if isinstance(recipe, str) else recipe.name
    return pytest.param(case, id=f"{name}-{case.check.name}", marks=marks)


@pytest.fixture
def samplekit_case(request: pytest.FixtureRequest) -> Any:
    """Return a check: calling it passes, fails with a counter-example, or is skipped with a reason."""
    case: Case = request.param

    def run() -> None:
        # Lines of samplekit's own code do not help the author of a sampler.
        __tracebackhide__ = True
        from samplekit.testing._result import CheckFailed, NotApplicable

        try:
            case.check.function(case.subject)
        except NotApplicable as nothing:
            # A check that is declared to fail, and has nothing to judge, did not fail: the command is as strict.
            if not case.expected:
                pytest.skip(str(nothing))
        except CheckFailed as failed:
            pytest.fail(str(failed), pytrace=False)

    return run
