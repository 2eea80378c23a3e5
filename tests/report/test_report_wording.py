import pytest

from samplekit._report.wording import exponent, grouped, number, seconds, short


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "–"),
        (0.0, "0"),
        (1.0, "1.00"),
        (-0.25, "−0.250"),
        (0.00123456, "0.00123"),
        (0.00099999, "0.00100"),
        (9.999e-4, "0.00100"),
        (1.23e-4, "1.23·10⁻⁴"),
        (12345.6, "12300"),
        (99999.0, "1.00·10⁵"),
        (5e-324, "4.94·10⁻³²⁴"),
        (-1.7e308, "−1.70·10³⁰⁸"),
    ],
)
def test_numbers(value, text):
    assert number(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "–"),
        (0.0, "0 s"),
        (2.5, "2.50 s"),
        (0.99999, "1.00 s"),
        (1.5e-3, "1.50 ms"),
        (4.2e-8, "42.0 ns"),
        (3e-11, "0.0300 ns"),
    ],
)
def test_times(value, text):
    assert seconds(value) == text


def test_exponents_and_counts():
    assert exponent(-1.5) == "−1.500"
    assert short(-1.5) == "−1.5"
    assert grouped(1234567) == "1\u202f234\u202f567"
