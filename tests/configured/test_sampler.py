import pickle

import numpy as np
import pytest

import samplekit
from samplekit import LatinStrata, Net, SamplekitError, UsageError
from samplekit._builtin import samplekit_randomizers, samplekit_samplers

SPECS = [spec for spec in samplekit_samplers() if not any(option.required for option in spec.options)]
NAMES = [spec.name for spec in SPECS]
RANDOMIZERS = {spec.name: spec for spec in samplekit_randomizers()}


def test_a_sampler_is_written_as_it_was_chosen():
    assert samplekit.sampler("jittered").text == "jittered"
    assert samplekit.sampler("sobol+owen").text == "sobol+owen"
    assert samplekit.sampler("van-der-corput:base=3").text == "van-der-corput:base=3"
    assert samplekit.sampler("van-der-corput:base=3+xor").text == "van-der-corput:base=3+xor"
    assert repr(samplekit.sampler("sobol+xor")) == "<sampler sobol+xor>"


def test_options_by_keyword_and_in_text_are_the_same():
    by_text = samplekit.sampler("van-der-corput:base=7").points(100, 1)
    assert np.array_equal(samplekit.sampler("van-der-corput", base=7).points(100, 1), by_text)
    assert np.array_equal(samplekit.sampler("van-der-corput", base="7").points(100, 1), by_text)
    assert samplekit.sampler("van-der-corput", base=7).text == "van-der-corput:base=7"
    assert np.array_equal(samplekit.points(samplekit.sampler("van-der-corput:base=7"), 100, 1), by_text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("jitered", "unknown sampler 'jitered': did you mean jittered"),
        ("sobol+owne", "unknown randomizer 'owne': did you mean owen"),
        ("sobol+owen+shift", "one randomizer at most"),
        ("sobol:base=3", "sobol has no option 'base': it takes none"),
        ("van-der-corput:bases=3", "no option 'bases': it takes base"),
        ("van-der-corput:base=1", "base=1: expected an integer from 2 to 1000"),
        ("van-der-corput:base=1001", "base=1001: expected an integer from 2 to 1000"),
        ("van-der-corput:base=2.5", "base=2.5: expected an integer"),
        ("van-der-corput:base=", "expected NAME:option=value"),
        ("van-der-corput:base=2,base=3", "given twice"),
        ("", "expected NAME"),
        ("disk", "unknown sampler 'disk'"),
    ],
)
def test_bad_choices_are_errors(text, message):
    with pytest.raises(UsageError, match=message):
        samplekit.sampler(text)


@pytest.mark.parametrize(
    ("text", "count", "dims", "message"),
    [
        ("jittered", 97, 2, "jittered makes products .* in 2 dimensions, not 97: the nearest are 96 and 98"),
        ("jittered+shift", 97, 2, r"jittered\+shift makes .* the nearest are 96 and 98"),
        ("jittered", 5, 3, "in 3 dimensions, not 5: the nearest are 4 and 8"),
        ("multi-jittered", 3, 2, "products of two near-equal sides .* not 3: the nearest are 2 and 4"),
        ("multi-jittered", 16, 1, "at least 2 dimensions, not 1"),
        ("n-rooks", 16, 3, "in 2 dimensions, not 3"),
        ("n-rooks", 16, 1, "in 2 dimensions, not 1"),
        ("van-der-corput", 16, 2, "not 2"),
        ("halton", 16, 1025, "in 1 to 1024 dimensions, not 1025"),
        ("hammersley", 16, 1026, "in 1 to 1025 dimensions, not 1026"),
        ("sobol", 16, 4097, "in 1 to 4096 dimensions, not 4097"),
        ("sobol", 2**32 + 1, 2, "at most 4294967296 points, not 4294967297"),
        ("halton", 2**40 + 1, 2, "at most 1099511627776 points"),
        ("halton+owen", 2**32 + 1, 2, "at most 4294967296 points"),
        ("random", 2**63 + 1, 2, "at most 9223372036854775808 points"),
        ("random", 0, 2, "count 0: expected a positive integer"),
        ("random", -3, 2, "count -3: expected a positive integer"),
        ("random", 1.0, 2, "count 1.0: expected a positive integer"),
        ("random", True, 2, "count True: expected a positive integer"),
        ("random", "16", 2, "count 16: expected a positive integer"),
        ("random", 16, 0, "dims 0: expected a positive integer"),
        ("random", 16, 2.0, "dims 2.0: expected a positive integer"),
        ("random", 16, True, "dims True: expected a positive integer"),
    ],
)
def test_what_a_sampler_cannot_make_is_an_error(text, count, dims, message):
    sampler = samplekit.sampler(text)
    for request in (sampler.check, sampler.points, lambda n, d: samplekit.points(text, n, d)):
        with pytest.raises(UsageError, match=message):
            request(count, dims)


@pytest.mark.parametrize("realizations", [0, -1, 1.0, True, "3"])
def test_bad_numbers_of_realisations_are_errors(realizations):
    for request in (
        lambda: samplekit.points("random", 4, realizations=realizations),
        lambda: samplekit.estimate("disk", "random", 4, realizations=realizations),
    ):
        with pytest.raises(UsageError, match=f"realizations {realizations}: expected a positive integer"):
            request()


@pytest.mark.parametrize(("start", "stop"), [(-1, 4), (4, 4), (5, 3), (0, 17), (16, 17), (0.5, 4), (True, 4)])
def test_bad_slices_are_errors(start, stop):
    with pytest.raises(UsageError, match=f"slice {start}:{stop}: expected integers with 0 <= start < stop <= 16"):
        samplekit.sampler("random").points(16, start=start, stop=stop)


def test_shapes_and_types():
    points = samplekit.points("random", 5, 3, realizations=7)
    assert points.shape == (7, 5, 3)
    assert points.dtype == np.float64
    assert points.flags.c_contiguous
    assert samplekit.sampler("random").points(9, 1, start=4).shape == (1, 5, 1)
    same = samplekit.points("random", np.int64(5), np.int32(3), realizations=np.int16(7), seed=np.uint8(0))
    assert np.array_equal(points, same)


@pytest.mark.parametrize("randomizer", RANDOMIZERS)
@pytest.mark.parametrize("name", NAMES)
def test_the_declaration_of_a_randomized_sampler(name, randomizer):
    """It is random and unbiased, keeps what the randomizer keeps, and nothing else changes."""
    plain, spec = samplekit.sampler(name).spec, samplekit.sampler(f"{name}+{randomizer}").spec
    kept = RANDOMIZERS[randomizer].keeps
    assert spec.randomized
    assert spec.unbiased
    assert spec.period is None
    assert set(spec.promises) <= set(plain.promises)
    assert all(promise.keyword in kept for promise in spec.promises)
    assert [p for p in spec.promises if isinstance(p, Net)] == [
        p for p in plain.promises if isinstance(p, Net) and "net" in kept
    ]
    assert not any(isinstance(promise, LatinStrata) for promise in spec.promises)
    assert spec.largest_index == (plain.largest_index if randomizer == "shift" else min(plain.largest_index, 2**32 - 1))
    same = ("dimensions", "counts", "progressive", "name")
    assert [getattr(spec, field) for field in same] == [getattr(plain, field) for field in same]


def test_the_declaration_without_a_randomizer_is_the_samplers():
    for spec in SPECS:
        if not spec.options:
            assert samplekit.sampler(spec.name).spec == spec


@pytest.mark.parametrize("text", [*NAMES, "sobol+owen", "halton+xor", "jittered+shift", "van-der-corput:base=5"])
def test_samplers_pickle(text):
    sampler = samplekit.sampler(text)
    copy = pickle.loads(pickle.dumps(sampler))
    dims = min(2, sampler.spec.dimensions[1] or 2)
    assert copy.text == text
    assert copy.spec == sampler.spec
    assert np.array_equal(copy.points(4, dims, seed=3), sampler.points(4, dims, seed=3))


@pytest.mark.parametrize("name", NAMES)
def test_built_in_samplers_are_fresh_and_stream(name):
    sampler = samplekit.sampler(name)
    assert sampler.fresh() is sampler
    assert sampler.streams
    assert samplekit.sampler(f"{name}+shift").streams
    assert sampler.notes(4, 2) == []


def test_errors_are_one_family():
    assert issubclass(UsageError, SamplekitError)
