"""Uniformity: the density of points on 31 x 31 cells, and whether means are those of the uniform distribution."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import chi_square_threshold, student_threshold
from samplekit.testing._subject import Array, SamplerSubject

SIDE = 31
_PER_CELL = 546
_COUNT = 16
_BATCH = 1 << 11
_BIAS_REALIZATIONS, _QUICK_BIAS_REALIZATIONS = 1 << 14, 1 << 10
_BIAS_COUNT = 256
_BIAS_BATCH = 1 << 9
_ROUNDING = 1e-12
"""The mean of an estimate that is all but exact differs from the integral by rounding alone."""


def one_point_a_set(subject: SamplerSubject, realizations: int, count: int, dims: int) -> Array:
    """Return one point of each set at a random index, float64[D, R].

    Points of one set depend on each other, those of different sets do not: this sample is independent, and the index
    makes it uniform if the sampler is unbiased. A test of all points would have to know how they depend.
    """
    rng = np.random.default_rng(31)
    chosen = [
        sets[np.arange(len(sets)), :, rng.integers(count, size=len(sets))]
        for sets in subject.independent_sets(realizations, count, dims, _BATCH)
    ]
    return np.concatenate(chosen).T


def cell_counts(points: Array, axes: tuple[int, ...]) -> NDArray[np.int64]:
    """Count the points float64[D, N] in each of 31 x 31 cells of two axes, or in each of 961 intervals of one."""
    side = SIDE if len(axes) == 2 else SIDE**2
    column, *rows = (np.clip((points[axis] * side).astype(np.int64), 0, side - 1) for axis in axes)
    return np.bincount(column + sum(rows) * side, minlength=SIDE**2)


@conformance_check("uniformity", 10)
def check_uniformity(subject: SamplerSubject) -> None:
    """Points fill 31 x 31 cells evenly, about 546 a cell, by a chi-square test with 960 degrees of freedom."""
    spec = subject.spec
    # A grid of many points fills the cells of two dimensions; in more dimensions it is too coarse.
    dims = subject.dims(4 if spec.randomized or not spec.counts.depends_on_dims else 2)
    pairs = [(0,)] if dims == 1 else [(axis, axis + 1) for axis in range(0, dims - 1, 2)]
    wanted = _PER_CELL * SIDE**2
    if spec.randomized:
        count = subject.counts(_COUNT, dims=dims)[0]
        realizations = subject.affordable(wanted // (16 if subject.quick else 1), count, dims)
        points = one_point_a_set(subject, realizations, count, dims)
    else:
        # Nothing is random: the set must be as uniform as random points are.
        count = subject.counts(wanted, dims=dims)[0]
        points = subject.sets(count, dims, 1)[0]
    total = points.shape[1]
    expected = total / SIDE**2
    limit = chi_square_threshold(len(pairs), SIDE**2 - 1)
    for axes in pairs:
        held = cell_counts(points, axes)
        if spec.randomized and not spec.unbiased:
            # It does not claim to be uniform, but it must visit all of the domain.
            empty = int(np.count_nonzero(held < expected / 4)) if expected >= 40 else 0
            if empty:
                raise CheckFailed(
                    f"{empty} of {SIDE**2} cells of dimensions {axes} hold less than a quarter of their share"
                    f" ({total} points)",
                    subject.request(count, dims, axes=axes),
                )
            continue
        statistic = float(((held - expected) ** 2).sum() / expected)
        if statistic > limit:
            worst = int(np.abs(held - expected).argmax())
            where = (worst,) if len(axes) == 1 else (worst % SIDE, worst // SIDE)
            raise CheckFailed(
                f"chi-square {statistic:.4g} on {SIDE**2} cells of dimensions {', '.join(map(str, axes))}: at most"
                f" {limit:.4g} expected; cell {where} holds {held[worst]} of {total} points, {expected:.3g} expected;"
                f" {int(np.count_nonzero(held == 0))} cells are empty",
                subject.request(count, dims, axes=axes, points=points.T[:4096].copy()),
            )


class Integrand(NamedTuple):
    """A function of float64[R, D, N] that gives float64[R, N].

    Attributes
    ----------
    integral
        Over the unit cube.
    variance
        At one random point, where a check needs it.
    """

    name: str
    function: Callable[[Array], Array]
    integral: float
    variance: float = math.nan


def integrands(dims: int) -> list[Integrand]:
    """Return moments, Fourier coefficients, steps and a quarter disk."""
    found = [each for d in range(dims) for each in _of_one_dimension(d)]
    found += [_product(d) for d in range(dims - 1)]
    if dims >= 2:
        found += [
            Integrand("[x0^2 + x1^2 < 1]", lambda x: (x[:, 0] ** 2 + x[:, 1] ** 2 < 1.0).astype(float), math.pi / 4),
            Integrand("[x0 + x1 < 1]", lambda x: (x[:, 0] + x[:, 1] < 1.0).astype(float), 1 / 2),
        ]
    return found


def _of_one_dimension(d: int) -> list[Integrand]:
    return [
        Integrand(f"x{d}", lambda x: x[:, d], 1 / 2),
        Integrand(f"x{d}^2", lambda x: x[:, d] ** 2, 1 / 3),
        Integrand(f"[x{d} < 1/3]", lambda x: (x[:, d] < 1 / 3).astype(float), 1 / 3),
        Integrand(f"cos 2 pi x{d}", lambda x: np.cos(2 * math.pi * x[:, d]), 0.0),
        Integrand(f"sin 2 pi x{d}", lambda x: np.sin(2 * math.pi * x[:, d]), 0.0),
    ]


def _product(d: int) -> Integrand:
    return Integrand(f"x{d} x{d + 1}", lambda x: x[:, d] * x[:, d + 1], 1 / 4)


@conformance_check("unbiasedness", 11)
def check_unbiasedness(subject: SamplerSubject) -> None:
    """The mean over realisations of estimates of known integrals is the integral, by a t-test."""
    if not subject.spec.unbiased:
        raise NotApplicable("it is not declared unbiased")
    dims = subject.dims(4)
    count = subject.counts(_BIAS_COUNT, dims=dims)[0]
    wanted = _QUICK_BIAS_REALIZATIONS if subject.quick else _BIAS_REALIZATIONS
    realizations = subject.affordable(wanted, count, dims)
    tests = integrands(dims)
    batches = subject.independent_sets(realizations, count, dims, _BIAS_BATCH)
    estimates = np.concatenate([[test.function(sets).mean(axis=1) for test in tests] for sets in batches], axis=1)
    threshold = student_threshold(len(tests), realizations - 1)
    errors = estimates.std(axis=1, ddof=1) / math.sqrt(realizations)
    subject.note(
        f"sees a bias of {(threshold + 1.28) * errors[0]:.2g} in the mean of x0 (from {realizations} sets of {count})"
    )
    for (name, _, integral, _), mean, error in zip(tests, estimates.mean(axis=1), errors, strict=True):
        if abs(mean - integral) <= max(threshold * error, _ROUNDING):
            continue
        how = f"{abs(mean - integral) / error:.1f} standard errors" if error > _ROUNDING else "the same in every set"
        advice = "" if subject.spec.randomized else ": a set that is not random is biased, declare unbiased=False"
        raise CheckFailed(
            f"the mean of {name} is {mean:.8g} over {realizations} sets of {count} points, the integral is"
            f" {integral:.8g}: a bias of {mean - integral:.3g}, {how}{advice}",
            subject.request(count, dims),
        )
