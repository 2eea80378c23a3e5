"""Thresholds of the seven statistical checks: how often a check is wrong, and what it can see.

Seeds are fixed, so a verdict is the same in every run: a false alarm is a property of a sampler, not of a run. The
probability that a conforming sampler has one is at most ``SAMPLER_RATE``; a run over at most 64 samplers has a
false alarm with probability at most ``FAMILY_RATE``. Within a sampler the rate is shared equally by the checks, and
within a check by its tests (Bonferroni), however these depend on each other.

The table has the smallest fault that each check finds nine times in ten, for points as noisy as random ones. In less
noisy samplers the checks find smaller faults; in slow ones, which are judged on smaller samples, only larger ones.

=================  ===================================================  =====================
check              a run                                                a quick run
=================  ===================================================  =====================
uniformity         density wrong by 2.4 % rms over 31 x 31 cells        9.5 % rms
joint-uniformity   density wrong by 0.3 % in a half of an axis          1.3 %
                   density wrong by 2.4 % in 1/64 of an axis            10 %
unbiasedness       a coordinate's mean wrong by 9.3e-4                  3.7e-3
variance           1.35 times what is promised                          1.45 times
across-pixels      correlation 0.02 of one pixel with another           0.075
across-dimensions  correlation 0.019 of one dimension with another      0.037
                   three dimensions tied in 7 points of 10              the same
relations          any that holds exactly, at eleven places             at three
=================  ===================================================  =====================
"""

from __future__ import annotations

from statistics import NormalDist

FAMILY_RATE = 1e-3
SAMPLERS_IN_A_FAMILY = 64
SAMPLER_RATE = FAMILY_RATE / SAMPLERS_IN_A_FAMILY
STATISTICAL_CHECKS = 7
CHECK_RATE = SAMPLER_RATE / STATISTICAL_CHECKS


def family_rate(samplers: int) -> float:
    """Return the highest false-alarm rate of a run over this many samplers."""
    return min(1.0, samplers * SAMPLER_RATE)


def normal_threshold(tests: int) -> float:
    """Return how many standard deviations each of ``tests`` two-sided tests allows."""
    return -NormalDist().inv_cdf(CHECK_RATE / tests / 2.0)


def student_threshold(tests: int, freedom: int, rate: float = CHECK_RATE) -> float:
    """Return the same as ``normal_threshold`` for a standard deviation estimated with ``freedom`` degrees.

    ``rate`` is the false-alarm rate of all tests together.
    """
    from scipy.special import stdtrit

    return float(-stdtrit(freedom, rate / tests / 2.0))


def chi_square_threshold(tests: int, freedom: int) -> float:
    """Return the value that a chi-square of ``freedom`` degrees exceeds with the rate of one of ``tests`` tests."""
    from scipy.special import chdtri

    return float(chdtri(freedom, CHECK_RATE / tests))


def poisson_threshold(expected: float, tests: int) -> int:
    """Return the least number of coincidences, at least 2, that occurs with at most the rate of one of ``tests`` tests.

    ``expected`` is the mean number of coincidences.
    """
    from scipy.special import pdtrc

    limit = 2
    while pdtrc(limit - 1, expected) > CHECK_RATE / tests:
        limit += 1 + limit // 64
    return limit
