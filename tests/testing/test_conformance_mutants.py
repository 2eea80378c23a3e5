"""The suite is tested with broken samplers: each is caught by the check that should catch it."""

import pytest
from mutants import MUTANTS
from mutation import caught, run_mutant, table

from samplekit.testing._suite import SUITES

pytestmark = pytest.mark.slow

SLOW_CHECKS_NEEDED = {
    *(
        "NaiveJitter",
        "NaiveDraw",
        "DiesOfConstantBits",
        "DependsOnTheProcess",
        "CannotBePickled",
        "SmallBias",
        "BlindSpot",
    ),
    *("LatinUpTo500000", "NetOf17Digits", "SlicesFrom5000"),
    *("LowerHalfOfTheLast", "OneOctave", "OneCell", "OneCount", "LargeSets"),
    *("SeedModuloAMillion", "KeyOf32Bits", "PrefixOf777", "UpperHalfOfTheSeventh", "CentresFrom2000"),
    "DependsOnTheThreads",
}
"""Caught with forced random bits, in another process, or by large samples alone; a quick run catches the others."""


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda mutant: mutant.__name__)
def test_a_mutant_is_caught(mutant):
    quick = mutant.__name__ not in SLOW_CHECKS_NEEDED
    outcomes = run_mutant(mutant.__name__, quick=quick, only=[mutant.caught_by])
    assert caught(mutant, outcomes), outcomes[0]
    if outcomes[0].status == "failed":
        assert outcomes[0].message
        assert not outcomes[0].message.startswith("raised"), outcomes[0].message


def test_there_are_enough_and_nearly_every_check_has_one():
    assert len(MUTANTS) >= 80
    # What only an installed plugin can do wrong is in test_conformance_command.
    assert {check.name for check in SUITES["sampler"]} - {mutant.caught_by for mutant in MUTANTS} == {"light-import"}


def test_the_table_has_a_row_a_mutant():
    mutant = next(each for each in MUTANTS if each.__name__ == "EmptyCell")
    outcomes = run_mutant("EmptyCell", quick=True)
    lines = table([(mutant, outcomes)])
    assert lines[-1].startswith("EmptyCell")
    assert lines[-1].count("X") == 1
