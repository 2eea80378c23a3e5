import pytest

from samplekit._errors import UsageError
from samplekit.commands import parse_counts


@pytest.mark.parametrize(
    ("text", "counts"),
    [
        ("16", [16]),
        ("1,4,16", [1, 4, 16]),
        ("2^0..2^4", [1, 2, 4, 8, 16]),
        ("4^1..4^5", [4, 16, 64, 256, 1024]),
        ("10^3", [1000]),
        ("2^3..2^3", [8]),
        ("16, 4, 2^1..2^4", [2, 4, 8, 16]),
    ],
)
def test_lists_and_ranges_are_read_as_rising_counts(text, counts):
    assert parse_counts(text, "count") == counts


@pytest.mark.parametrize(
    "text",
    ["", ",", "0", "-1", "1e3", "4..16", "2^0..4^2", "2^5..2^3", "2^0..", "..2^4", "1^0..1^5", "2^0..2^64", "2^0...2^2",
     "x", "99999999999999999999", "2^999"],
)  # fmt: skip
def test_what_is_no_list_of_counts_is_refused_in_one_line(text):
    with pytest.raises(UsageError) as error:
        parse_counts(text, "count")
    assert str(error.value).startswith("count")
    assert "\n" not in str(error.value)


def test_a_list_too_long_is_refused():
    with pytest.raises(UsageError, match="at most 1000"):
        parse_counts(",".join(str(number) for number in range(1, 1102)), "count")
