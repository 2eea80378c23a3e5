"""Declarations: nonsense is refused where it is written, options where they are given."""

import math
import subprocess
import sys
import types
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from samplekit import (
    AnyCount,
    CommandSpec,
    GridStrata,
    LatinStrata,
    MinimumDistance,
    Net,
    Option,
    OrthogonalArray,
    Powers,
    PowersOf,
    PrimePowers,
    Products,
    RandomizerSpec,
    SamplerSpec,
    SceneSpec,
)
from samplekit._errors import SamplekitError, UsageError
from samplekit._specs import Strata
from samplekit._specs.declaration import API_VERSION

KINDS = [SamplerSpec, RandomizerSpec, SceneSpec, CommandSpec]


def sampler(**more):
    return SamplerSpec("toy", "toys:Toy", "a toy", **more)


@pytest.mark.parametrize("name", ["a", "disk", "n-rooks", "r2", "a-", "a1-b2"])
def test_names_of_lower_case_digits_and_dashes_are_taken(name):
    for kind in KINDS:
        assert kind(name, "a:b", "").name == name


@pytest.mark.parametrize(
    "name",
    ["", "A", "Disk", "1a", "-a", "a b", " a", "a_b", "a/b", "a+b", "a:b", "ä", "a,b", "a=b", "a.b", None, 5, b"a"],
)
def test_other_names_are_refused(name):
    for kind in KINDS:
        with pytest.raises(ValueError, match="name must be of the form"):
            kind(name, "a:b", "")
    with pytest.raises(ValueError, match="name must be of the form"):
        Option(name, 1)


@pytest.mark.parametrize("target", ["toys:Toy", "a.b.c:D", "_a._b:_c", "a:b1"])
def test_targets_name_a_module_and_an_attribute(target):
    assert SceneSpec("toy", target, "").target == target


@pytest.mark.parametrize(
    "target", ["", "toys", "toys:", ":Toy", "toys:Toy:x", "toys:a.b", "a b:c", "1a:b", "a/b:c", None, 5]
)
def test_other_targets_are_refused(target):
    with pytest.raises(ValueError, match="target must be of the form"):
        SceneSpec("toy", target, "")


def test_a_target_is_imported_when_it_is_loaded_and_not_before():
    code = (
        "import sys\nfrom samplekit._specs import SceneSpec\n"
        "spec = SceneSpec('toy', 'colorsys:rgb_to_hls', '')\nassert 'colorsys' not in sys.modules\n"
        "assert spec.load() is sys.modules['colorsys'].rgb_to_hls"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.parametrize(
    ("target", "reason"),
    [
        ("no_such_module_anywhere:X", "ModuleNotFoundError"),
        ("math:no_such_attribute", "AttributeError"),
        ("samplekit_toy_that_exits:X", "SystemExit"),
        ("samplekit_toy_that_fails:X", "ZeroDivisionError"),
    ],
)
def test_a_target_that_cannot_be_imported_says_which_and_why(target, reason, plugins):
    plugins.module("samplekit_toy_that_exits", "raise SystemExit(3)")
    plugins.module("samplekit_toy_that_fails", "1 / 0")
    with pytest.raises(SamplekitError) as error:
        SceneSpec("toy", target, "").load()
    assert str(error.value).startswith(f"toy: cannot import {target}: {reason}")
    assert not isinstance(error.value, UsageError)


@pytest.mark.parametrize("kind", KINDS)
def test_a_declaration_for_a_newer_interface_is_refused(kind):
    with pytest.raises(ValueError, match="upgrade samplekit-core"):
        kind("toy", "toys:Toy", "", api_version=API_VERSION + 1)


@pytest.mark.parametrize(
    "more",
    [
        {"options": [Option("k", 1)]},
        {"options": ("k",)},
        {"options": (Option("k", 1), Option("k", 2.0))},
        {"dimensions": 2},
        {"dimensions": (1,)},
        {"dimensions": [1, 2]},
        {"dimensions": (0, 2)},
        {"dimensions": (3, 2)},
        {"dimensions": ("1", None)},
        {"dimensions": (1.0, None)},
        {"dimensions": (1, 2.0)},
        {"dimensions": (None, 2)},
        {"counts": "some"},
        {"counts": "any"},
        {"counts": PowersOf},
        {"counts": None},
        {"counts": 2},
        {"progressive": True},
        {"progressive": "no"},
        {"progressive": "every-count"},
        {"progressive": PowersOf},
        {"extensible_dims": 1},
        {"period": 0},
        {"period": -1},
        {"largest_index": -1},
        {"largest_index": 2**64},
        {"promises": ("net",)},
        {"promises": (Net,)},
        {"promises": [Net()]},
        {"randomized": 1},
        {"unbiased": None},
        {"period": 2.5},
        {"period": True},
        {"largest_index": 2.0**20},
        {"screen_block": 1},
        {"screen_block": 16.0},
        {"api_version": "1"},
        {"reference": object()},
        {"reference": "two\nlines"},
        {"expected_failures": [object()]},
        {"expected_failures": {"range": object()}},
        {"expected_failures": {5: "why"}},
        {"expected_failures": {"range": "two\nlines"}},
        {"fresh_options": {"k": 1}},
        {"fresh_options": {"k": object()}, "options": (Option("k", 1),)},
        {"fresh_options": {"k": 5}, "options": (Option("k", 1, "", 0, 3),)},
    ],
)
def test_nonsense_about_a_sampler_is_refused_with_its_name(more):
    with pytest.raises(ValueError, match=r"^toy: "):
        sampler(**more)


@pytest.mark.parametrize("summary", [None, 5, ["a"], "two\nlines", "a\ttab", "\x1b[31mred"])
def test_a_summary_is_text_of_one_line(summary):
    with pytest.raises(ValueError, match="summary"):
        SceneSpec("toy", "toys:Toy", summary)
    with pytest.raises(ValueError, match="summary"):
        Option("k", 1, summary)


@pytest.mark.parametrize(
    "declare",
    [
        lambda: Option("k", math.inf, maximum=math.inf),
        lambda: Option("k", math.nan),
        lambda: Option("k", 1j),
        lambda: Option("k", None),
        lambda: Option("k", 1.0, minimum=math.nan),
        lambda: Option("k", 1.0, minimum="0"),
        lambda: Option("k", 5, maximum=4),
        lambda: Option("k", "c", choices=("a", "b")),
        lambda: Option("k", "a", choices=["a", "b"]),
        lambda: Option("k", "a", choices="a"),
        lambda: Option("k", 1, required="yes"),
        lambda: Net(dims=[0, 1]),
        lambda: Net(dims=()),
        lambda: Net(dims=(0, 0)),
        lambda: Net(base=1),
        lambda: Net(t=-1),
        lambda: Net(sequence="yes"),
        lambda: LatinStrata(dims=(-1,)),
        lambda: GridStrata(block=0),
        lambda: OrthogonalArray(strength=2.0),
        lambda: MinimumDistance(math.nan),
        lambda: MinimumDistance(1.5),
        lambda: RandomizerSpec("toy", "a:b", "", keeps=("nets",)),
        lambda: RandomizerSpec("toy", "a:b", "", keeps="net"),
        lambda: RandomizerSpec("toy", "a:b", "", largest_index=None),
        lambda: SceneSpec("toy", "a:b", "", purposes=5),
        lambda: SceneSpec("toy", "a:b", "", purposes=(("pixels", 2),)),
        lambda: SceneSpec("toy", "a:b", "", purposes=(("pixel", 0),)),
    ],
)
def test_nonsense_in_the_parts_of_a_declaration_is_refused(declare):
    with pytest.raises(ValueError, match=r"."):
        declare()


def test_mappings_are_taken_as_plain_copies():
    reasons = {"range": "might reach 1"}
    spec = sampler(expected_failures=types.MappingProxyType(reasons))
    assert type(spec.expected_failures) is dict
    reasons["shape"] = "later"
    assert spec.expected_failures == {"range": "might reach 1"}


def test_what_a_sampler_may_declare_is_taken():
    for counts in (AnyCount(), Products(), Products(2), Powers(2), PrimePowers(2), PrimePowers(3), PowersOf(2)):
        assert sampler(counts=counts).counts == counts
    for progressive in (None, AnyCount(), PowersOf(3)):
        assert sampler(progressive=progressive).progressive == progressive
    promises = (Net(), LatinStrata(), GridStrata(), OrthogonalArray(), MinimumDistance(0.7))
    spec = sampler(dimensions=(2, 2), period=128, largest_index=2**64 - 1, promises=promises)
    assert spec.promises == promises
    assert spec.promised(Net) == [Net()]
    assert spec.promised(Strata) == [LatinStrata(), GridStrata(), OrthogonalArray()]
    assert {promise.keyword for promise in promises} == {"net", "latin", "grid", "orthogonal-array", "distance"}


def test_declarations_do_not_change():
    with pytest.raises(AttributeError):
        sampler().name = "other"
    with pytest.raises(AttributeError):
        Option("k", 1).default = 2


# --- options ---------------------------------------------------------------------------------------------------------

RADIUS = Option("radius", 0.3, minimum=0.0)
ANY_NUMBER = Option("cx", 0.5)
UP_TO_INFINITY = Option("far", 1.0, minimum=0.0, maximum=math.inf)
CELLS = Option("cells", 8, minimum=1, maximum=2**20)
FLAG = Option("flag", False)
TEXT = Option("text", "a")
STYLE = Option("style", "one", choices=("one", "two"))


@pytest.mark.parametrize(
    ("option", "given", "value"),
    [
        (RADIUS, "0", 0.0),
        (RADIUS, "1e-3", 1e-3),
        (RADIUS, " .5 ", 0.5),
        (RADIUS, 1, 1.0),
        (RADIUS, np.float32(0.5), 0.5),
        (RADIUS, "1.7976931348623157e308", 1.7976931348623157e308),
        (ANY_NUMBER, "-5", -5.0),
        (UP_TO_INFINITY, "inf", math.inf),
        (CELLS, "1", 1),
        (CELLS, "+7", 7),
        (CELLS, 2**20, 2**20),
        (CELLS, np.int64(3), 3),
        (FLAG, "true", True),
        (FLAG, "false", False),
        (FLAG, True, True),
        (TEXT, "any thing", "any thing"),
        (STYLE, "two", "two"),
    ],
)
def test_options_take_text_and_values_of_their_type(option, given, value):
    parsed = option.parse(given)
    assert parsed == value
    assert type(parsed) is type(option.default)


@pytest.mark.parametrize(
    ("option", "given"),
    [
        (RADIUS, "-1e-300"),
        (RADIUS, "nan"),
        (RADIUS, math.nan),
        (RADIUS, "inf"),
        (RADIUS, "1e999"),
        (RADIUS, "abc"),
        (RADIUS, ""),
        (RADIUS, "1_0"),
        (RADIUS, "0x10"),
        (RADIUS, "1,5"),
        (RADIUS, None),
        (RADIUS, True),
        (RADIUS, 1j),
        (RADIUS, [0.5]),
        (ANY_NUMBER, "-inf"),
        (ANY_NUMBER, "nan"),
        (UP_TO_INFINITY, "nan"),
        (UP_TO_INFINITY, "-inf"),
        (CELLS, "0"),
        (CELLS, str(2**20 + 1)),
        (CELLS, "9" * 5000),
        (CELLS, "2.5"),
        (CELLS, "2.0"),
        (CELLS, "1e3"),
        (CELLS, "1_0"),
        (CELLS, "0x10"),
        (CELLS, "nan"),
        (CELLS, ""),
        (CELLS, 2.0),
        (CELLS, np.float32(2.5)),
        (CELLS, Decimal("2.5")),
        (CELLS, Fraction(5, 2)),
        (CELLS, True),
        (CELLS, None),
        (FLAG, "True"),
        (FLAG, "1"),
        (FLAG, 1),
        (FLAG, ""),
        (TEXT, 5),
        (TEXT, None),
        (TEXT, b"a"),
        (STYLE, "three"),
        (STYLE, "One"),
        (STYLE, ""),
        (STYLE, 1),
    ],
)
def test_what_an_option_does_not_take_is_refused_with_what_it_takes(option, given):
    with pytest.raises(UsageError) as error:
        option.parse(given)
    message = str(error.value)
    assert message.startswith(f"option {option.name}=")
    assert "expected" in message
    if option is STYLE:
        assert "one or two" in message


@pytest.mark.parametrize("default", [None, [1], (1,), 1j, b"a", {}])
def test_a_default_has_a_type_that_options_can_have(default):
    with pytest.raises(ValueError, match="default"):
        Option("k", default)


def test_options_not_given_keep_their_defaults():
    spec = sampler(options=(RADIUS, CELLS, FLAG))
    assert spec.parse_options({}) == {"radius": 0.3, "cells": 8, "flag": False}
    assert spec.parse_options({"cells": "4"}) == {"radius": 0.3, "cells": 4, "flag": False}


def test_a_wrong_option_names_those_there_are():
    spec = sampler(options=(RADIUS, CELLS))
    with pytest.raises(UsageError, match="toy has no option 'cell': it takes radius, cells"):
        spec.parse_options({"cell": "4"})
    with pytest.raises(UsageError, match="it takes none"):
        sampler().parse_options({"cell": "4"})
    with pytest.raises(UsageError, match=r"^toy: option cells=0: expected an integer"):
        spec.parse_options({"cells": "0"})


def test_a_required_option_that_is_missing_is_asked_for():
    spec = sampler(options=(Option("file", "", "where points are", required=True),))
    with pytest.raises(UsageError, match=r"toy needs the option file \(where points are\)"):
        spec.parse_options({})
    assert spec.parse_options({"file": "points.csv"}) == {"file": "points.csv"}
