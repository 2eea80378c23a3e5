"""``samplekit list KIND NAME``: one declaration in full."""

import json
import subprocess
import sys

import pytest

from samplekit import (
    AnyCount,
    Exactly,
    FibonacciNumbers,
    GridStrata,
    LatinStrata,
    MinimumDistance,
    Net,
    Option,
    OrthogonalArray,
    PowersOf,
    PrimePowers,
    Products,
    SamplerSpec,
)
from samplekit._cli import declaration_words as words
from samplekit._cli import run
from samplekit._cli.sheet import describe, lines
from samplekit._registry import Plugin, registry

PLUGIN = Plugin("toys", "Toys", "1.0")


def printed(capsys, *arguments, status=0):
    assert run(["list", *arguments]) == status
    found = capsys.readouterr()
    return found.out if status == 0 else found.err


def test_a_sampler_in_full(capsys):
    text = printed(capsys, "samplers", "orthogonal-array")
    assert text.splitlines()[0] == "orthogonal-array"
    for part in (
        "reference      Jarosz",
        "dimensions     2 and more",
        "points         squares of primes: 4, 9, 25, 49,",
        "progressive    no: another number of points is another set",
        "one point in each of the s^2 cells of any 2 dimensions",
        "strength=2         number of dimensions that are stratified together; from 2 to 3",
        "largest index  4294967295",
        "period         none",
    ):
        assert part in text


def test_options_and_randomizers_change_what_is_shown(capsys):
    assert "cubes of primes: 8, 27, 125" in printed(capsys, "samplers", "orthogonal-array:strength=3")
    assert "random         no" in printed(capsys, "samplers", "halton")
    assert "random         yes" in printed(capsys, "samplers", "halton+owen")


def test_an_option_that_is_required_needs_no_value_to_be_shown(capsys):
    assert "(required)" in printed(capsys, "samplers", "file")


def test_scenes_randomizers_and_plugins_in_full(capsys):
    scene = printed(capsys, "scenes", "disk")
    assert "dimensions  pixel 2" in scene
    assert "radius=0.3" in scene
    assert "keeps       net" in printed(capsys, "randomizers", "owen")
    assert "status        loaded" in printed(capsys, "plugins", "samplekit")


def test_json_has_the_record_and_the_words(capsys):
    report = json.loads(printed(capsys, "samplers", "jittered", "--json"))
    (record,) = report["samplers"]
    assert report["schema"] == "samplekit.list/1"
    assert record["name"] == "jittered"
    assert record["promises"] == [{"promise": "grid", "block": None}]
    assert record["in_words"]["promises"] == ["one point in each cell of a grid of near-equal sides"]
    (plugin,) = json.loads(printed(capsys, "plugins", "samplekit", "--json"))["plugins"]
    assert plugin["in_words"]["status"] == ["loaded"]


def test_a_range_without_end_is_json(capsys, monkeypatch):
    spec = SamplerSpec("endless", "a:B", "", options=(Option("far", 1.0, "", 0.0, float("inf")),))
    offer = type(registry().find("sampler", "random"))(spec, PLUGIN, "endless")
    monkeypatch.setitem(registry()._registered["sampler"], "endless", [offer])
    (record,) = json.loads(printed(capsys, "samplers", "endless", "--json"))["samplers"]
    assert record["options"][0]["maximum"] == "inf"
    assert record["options"][0]["minimum"] == 0.0
    assert "far=1.0  from 0 to inf" in printed(capsys, "samplers", "endless")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("samplers", "haltn"), "did you mean halton"),
        (("samplers", "halton:base=2"), "halton has no option 'base'"),
        (("scenes", "dsk"), "did you mean disk"),
        (("plugins", "nobody"), "unknown plugin 'nobody': there are"),
        (("sampler", "halton"), "expected samplers, scenes, randomizers or plugins"),
    ],
)
def test_wrong_names(capsys, arguments, message):
    error = printed(capsys, *arguments, status=2)
    assert message in error
    assert error.count("\n") == 1


def test_promises_in_words():
    said = [
        promise.describe()
        for promise in (
            GridStrata(block=3),
            LatinStrata(dims=(1,)),
            Net(dims=(0, 1), base=3, t=1, sequence=False),
            OrthogonalArray(3),
            MinimumDistance(0.7),
        )
    ]
    assert said == [
        "one point in each cell of a grid of near-equal sides of every block of 3 dimensions",
        "one point in each of N intervals of dimension 1",
        "dimensions 0, 1: the first 3^m points are a (1, m, 2)-net in base 3",
        "one point in each of the s^3 cells of any 3 dimensions, N = s^3",
        "points at least 0.7 of the densest packing's distance apart, on the torus",
    ]
    assert words.short_promises([Net(base=2), Net(base=3), LatinStrata()]) == "net in base 2, 3; Latin"


def test_every_declaration_has_words():
    for kind in ("sampler", "scene", "randomizer"):
        for name, offer in registry().all(kind).items():
            rows = describe(offer.spec, offer.plugin)
            assert rows["what it is"] == [offer.spec.summary]
            assert all("\n" not in line for line in lines(name, rows))


@pytest.mark.parametrize(
    ("counts", "said", "short"),
    [
        (AnyCount(), "any number", "any"),
        (Products(), "products of near-equal sides (a grid) in 2D: 1, 2, 4, 6, 8, 9, 12, 15, ...", "a grid"),
        (Products(2), "products of two near-equal sides (a grid): 1, 2, 4, 6, 8, 9, 12, 15, ...", "a grid in 2D"),
        (PowersOf(4), "powers of 4: 1, 4, 16, 64, 256, 1024, 4096, 16384, ...", "4^m"),
        (FibonacciNumbers(), "Fibonacci numbers: 1, 2, 3, 5, 8, 13, 21, 34, ...", "Fibonacci"),
        (PrimePowers(3), "cubes of primes: 8, 27, 125, 343, 1331, 2197, 4913, 6859, ...", "prime^3"),
        (Exactly(12), "exactly 12 points", "only 12"),
    ],
)
def test_counts_in_words(counts, said, short):
    spec = SamplerSpec("x", "a:B", "", counts=counts)
    assert words.counts(spec) == said
    assert counts.short() == short


def test_progressivity_in_words():
    specs = [SamplerSpec("x", "a:B", "", progressive=each) for each in (None, AnyCount(), PowersOf(2))]
    assert [words.short_progressive(spec) for spec in specs] == ["", "always", "at 2^m"]
    assert "the first 2^m are a good set" in words.progressive(specs[2])
    assert [words.progressive_word(spec) for spec in specs] == ["no", "every-count", "powers-of-2"]


def test_extensibility_in_words():
    specs = [SamplerSpec("x", "a:B", "", **declared) for declared in ({}, {"extensible_dims": False})]
    assert words.extensible(specs[0]) == "yes: the first dimensions stay when there are more"
    assert words.extensible(specs[1]) == "no: another number of dimensions is another set"
    fixed = SamplerSpec("x", "a:B", "", dimensions=(2, 2))
    assert words.extensible(fixed) == "no: the number of dimensions is fixed"


def test_a_plain_name_imports_no_implementation():
    code = (
        "import sys; from samplekit._cli import run; run(['list', 'samplers', 'sobol']);"
        "print(sorted({'numpy', 'numba', 'samplekit._builtin.samplers.sobol'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
