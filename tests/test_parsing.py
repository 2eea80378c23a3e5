"""The command line's small languages."""

import pytest

from samplekit._arguments import check_crop
from samplekit._choices import Choice, parse_choice
from samplekit._errors import UsageError
from samplekit.commands import parse_count, parse_crop, parse_seed, parse_size


@pytest.mark.parametrize(
    ("text", "choice"),
    [
        ("halton", Choice("halton")),
        ("sobol+owen", Choice("sobol", {}, "owen")),
        ("lattice/r2", Choice("lattice/r2")),
        ("sobol+mine/owen", Choice("sobol", {}, "mine/owen")),
        ("van-der-corput:base=3", Choice("van-der-corput", {"base": "3"})),
        ("van-der-corput:base=3+shift", Choice("van-der-corput", {"base": "3"}, "shift")),
        ("toy:a=1, b = two ,c=x=y", Choice("toy", {"a": "1", "b": "two", "c": "x=y"})),
        # A plus sign in a number is no randomizer.
        ("toy:a=1e+16", Choice("toy", {"a": "1e+16"})),
        ("toy:a=+5+owen", Choice("toy", {"a": "+5"}, "owen")),
        ("toy:a=1+", Choice("toy", {"a": "1+"})),
        ("Unknown.Name_1", Choice("Unknown.Name_1")),
    ],
)
def test_samplers_have_options_and_a_randomizer(text, choice):
    assert parse_choice(text, "sampler") == choice


def test_scenes_have_options_alone():
    assert parse_choice("zoneplate:k=1e+3,cx=-0.5", "scene") == Choice("zoneplate", {"k": "1e+3", "cx": "-0.5"})
    with pytest.raises(UsageError, match="expected NAME"):
        parse_choice("zoneplate+owen", "scene")


@pytest.mark.parametrize(
    "text",
    [
        "", " ", ":", "+owen", "sobol+", "/sobol", "a//sobol", "sobol+/owen", "sobol+owen+shift", "sobol:", "sobol:a",
        "sobol:a=", "sobol:=1", "sobol:a=1,", "sobol:,a=1", "sobol:a=1,a=2", "sobol:a =1,a= 2", "so bol", "sobol\n",
        "söbol", "日本", "sobol;ls", "a\0b", "'sobol'", "+", "++", "*",
    ],
)  # fmt: skip
def test_other_texts_are_refused_in_one_line_that_repeats_them(text):
    with pytest.raises(UsageError) as error:
        parse_choice(text, "sampler")
    message = str(error.value)
    assert message.startswith(f"sampler {text!r}")
    assert "\n" not in message


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("1", 1),
        ("16", 16),
        ("2^4", 16),
        (" 7 ", 7),
        ("10^3", 1000),
        ("5^0", 1),
        ("2^63", 2**63),
        ("007", 7),
        ("1^999", 1),
    ],
)
def test_counts_are_integers_or_powers(text, count):
    assert parse_count(text, "spp") == count


@pytest.mark.parametrize(
    "text",
    [
        "", " ", "0", "-3", "+3", "2.5", "1e4", "16.0", "2^", "^4", "2^-1", "2^2^2", "2**4", "0^0^0", "0^3", "2^64",
        "2^70", "9223372036854775809", "9" * 20, "9" * 1000, "99999^999", "2^9999", "nan", "inf", "1_000", "1,000",
        "0x10", "٣", "４", "sixteen", "1 6", "spp",
    ],
)  # fmt: skip
def test_other_counts_are_refused(text):
    with pytest.raises(UsageError, match=r"^spp .*: expected a positive integer"):
        parse_count(text, "spp")


@pytest.mark.parametrize("seed", [0, 1, 2**32, 2**53 + 1, 2**64 - 1])
def test_seeds_are_exact_up_to_64_bits(seed):
    assert parse_seed(str(seed)) == seed


@pytest.mark.parametrize(
    "text", ["", "-1", "+1", str(2**64), "9" * 30, "1.0", "1e3", "0x1", "text", "nan", "²", "٣", "1 2"]
)
def test_other_seeds_are_refused(text):
    with pytest.raises(UsageError, match="expected an integer from 0 to 18446744073709551615"):
        parse_seed(text)


@pytest.mark.parametrize(
    ("text", "size"), [("512", (512, 512)), ("640x480", (640, 480)), ("1", (1, 1)), ("1x1", (1, 1)), (" 3x2 ", (3, 2))]
)
def test_sizes_are_width_and_height(text, size):
    assert parse_size(text) == size


@pytest.mark.parametrize(
    "text", ["", "0", "0x5", "5x0", "-1", "5x-1", "x", "5x", "x5", "5x5x5", "5*5", "5.5", "1e3", "5 x 5", "٣", "9" * 10]
)
def test_other_sizes_are_refused(text):
    with pytest.raises(UsageError, match="expected W or WxH"):
        parse_size(text)


@pytest.mark.parametrize("text", ["0,0,8,6", "7,5,1,1", "0,5,8,1"])
def test_crops_lie_inside_the_image(text):
    assert parse_crop(text, (8, 6)) == tuple(map(int, text.split(",")))


@pytest.mark.parametrize(
    "text", ["8,0,1,1", "0,6,1,1", "0,0,9,6", "0,0,8,7", "1,0,8,6", "0,0,0,1", "0,0,1,0", "999999999,0,1,1"]
)
def test_crops_outside_or_empty_are_refused_with_the_image_size(text):
    with pytest.raises(UsageError, match="inside the image of 8x6 pixels"):
        parse_crop(text, (8, 6))


@pytest.mark.parametrize(
    "text", ["", "1,2,3", "1,2,3,4,5", "a,b,c,d", "-1,0,1,1", "0.5,0,1,1", "0, 0, 1, 1", "0;0;1;1", "1e0,0,1,1"]
)
def test_other_crops_are_refused_with_an_example(text):
    with pytest.raises(UsageError, match="expected X,Y,W,H in pixels"):
        parse_crop(text, (8, 6))


def test_crops_from_python_are_checked_alike():
    assert check_crop((1, 2, 3, 4), (8, 6)) == (1, 2, 3, 4)
    for crop in ((-1, 0, 1, 1), (0, -1, 1, 1), (0, 0, 0, 1), (0, 0, 1, -1), (2**40, 0, 1, 1)):
        with pytest.raises(UsageError, match="inside the image"):
            check_crop(crop, (8, 6))
