"""Checks of scenes: the reference against another quadrature, constant pixels against samples, dimensions, purity."""

from __future__ import annotations

import functools
import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from samplekit.testing._checks.purity import changing_nothing
from samplekit.testing._result import CheckFailed, NotApplicable, conformance_check
from samplekit.testing._statistics import SAMPLER_RATE, student_threshold
from samplekit.testing._subject import Array, SceneSubject

_NODES = (16, 32, 64)
_SMOOTH = 1e-12
_SMOOTH_TOLERANCE = 1e-10
_SHIFTS = 32
_LATTICE = 4093
_PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53)
_BLOCK = 1024
_ALMOST_ONE = 1.0 - 2.0**-53


def _windows(subject: SceneSubject) -> list[tuple[Array, Array]]:
    """Return edges of the pixels that are judged: the whole square in 8 x 8, and small pixels of a large image."""
    coarse = np.arange(9) / 8
    windows = [(coarse, coarse)]
    for x, y in ((0, 0), (230, 272), (384, 100), (508, 508)):
        windows.append((np.arange(x, x + 5) / 512, np.arange(y, y + 5) / 512))
    return windows[: 2 if subject.quick else None]


def _box(x_edges: Array, y_edges: Array, j: int, i: int) -> Array:
    """Return left, width, top and height of the pixel in row j and column i."""
    return np.array([x_edges[i], x_edges[i + 1] - x_edges[i], y_edges[j], y_edges[j + 1] - y_edges[j]])


def _name(subject: SceneSubject, box: Array) -> str:
    """Return the name of a pixel; its edges are multiples of a power of 1/2, so that the sums are exact."""
    left, width, top, height = box
    return f"scene {subject.text}, pixel [{left}, {left + width}] x [{top}, {top + height}]"


def _reference(subject: SceneSubject, x_edges: Array, y_edges: Array) -> tuple[Array, float]:
    """Return the reference, and the bound that the scene states for its error."""
    if subject.scene.at_centre:
        raise NotApplicable("its pixels are seen at their centres: there is no mean over a pixel")
    reference = subject.scene.reference(x_edges, y_edges)
    if reference.numerical:
        raise NotApplicable("it has no reference of its own")
    return reference.image, reference.error


@conformance_check("reference", 1, kind="scene")
def check_reference(subject: SceneSubject) -> None:
    """The exact mean of a pixel is what another quadrature gives: Gauss-Legendre, or shifted lattices.

    They agree to 1e-10 where the scene is smooth, and elsewhere by a t-test.
    """
    windows = _windows(subject)
    tests = sum((x.size - 1) * (y.size - 1) for x, y in windows)
    smooth = 0
    for x_edges, y_edges in windows:
        exact, bound = _reference(subject, x_edges, y_edges)
        if not np.isfinite(exact).all():
            raise CheckFailed(f"scene {subject.text}: the reference is not finite")
        for j, i in np.ndindex(exact.shape):
            box = _box(x_edges, y_edges, j, i)
            mean, tolerance = _quadrature(subject, box, tests)
            smooth += tolerance <= _SMOOTH_TOLERANCE * max(1.0, abs(mean))
            if abs(exact[j, i] - mean) > tolerance + bound:
                raise CheckFailed(
                    f"{_name(subject, box)}: the reference is {float(exact[j, i])!r}, another quadrature gives"
                    f" {mean:.12g} within {tolerance:.2g} (the scene states {bound:g} for its own error)"
                )
    subject.note(f"{smooth} of {tests} pixels by Gauss-Legendre to 1e-10, the others by lattices")


def _quadrature(subject: SceneSubject, box: Array, tests: int) -> tuple[float, float]:
    """Return the mean over a pixel, and how far off it may be."""
    if subject.dims == 2:
        previous = math.nan
        for nodes in _NODES[: 2 if subject.quick else None]:
            u, weights = _product_rule(nodes)
            values = subject.values(u, box)
            mean = float(weights @ values) / 4.0
            scale = max(1.0, abs(mean))
            # Two rules that see one value only agree, even if a spike lies between their nodes.
            if abs(mean - previous) <= _SMOOTH * scale and np.ptp(values) > 0.0:
                return mean, _SMOOTH_TOLERANCE * scale
            previous = mean
    means = np.array([subject.mean(u, box) for u in _shifted_lattices(subject.dims)])
    error = float(means.std(ddof=1)) / math.sqrt(_SHIFTS)
    threshold = student_threshold(tests, _SHIFTS - 1, SAMPLER_RATE)
    # If all sets give one value, they may all miss a sliver that is smaller than a cell of a lattice.
    mean = float(means.mean())
    return mean, threshold * error + 2.0 / _LATTICE + _SMOOTH * abs(mean)


@functools.cache
def _product_rule(nodes: int) -> tuple[Array, Array]:
    """Return the nodes float64[2, M] of a Gauss-Legendre rule on the unit square, and weights whose sum is 4."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    return np.stack([axis.ravel() for axis in np.meshgrid((x + 1) / 2, (x + 1) / 2)]), np.outer(w, w).ravel()


# Made once for all pixels: making the rules and the lattices takes longer than using them.
@functools.cache
def _shifted_lattices(dims: int) -> list[Array]:
    """Return Kronecker sets with square roots of primes as steps, shifted at random: unbiased, and none of ours."""
    base = np.arange(_LATTICE)[None, :] * np.sqrt(np.array(_PRIMES[:dims], float))[:, None]
    shifts = np.random.default_rng(5).random((_SHIFTS, dims, 1))
    return [np.minimum((base + shift) % 1.0, _ALMOST_ONE) for shift in shifts]


@conformance_check("refinement", 2, kind="scene")
def check_refinement(subject: SceneSubject) -> None:
    """The exact mean of a pixel is the mean of the exact means of its four quarters.

    They agree to 1e-12, and twice the error that the scene states.
    """
    for x_edges, y_edges in _windows(subject):
        exact, bound = _reference(subject, x_edges, y_edges)
        fine, _ = _reference(subject, _halved(x_edges), _halved(y_edges))
        quarters = (fine[::2, ::2] + fine[1::2, ::2] + fine[::2, 1::2] + fine[1::2, 1::2]) / 4.0
        apart = np.abs(quarters - exact)
        j, i = divmod(int(apart.argmax()), apart.shape[1])
        if apart[j, i] > 2.0 * bound + 1e-12 * max(1.0, float(np.abs(exact).max())):
            raise CheckFailed(
                f"{_name(subject, _box(x_edges, y_edges, j, i))}: the reference is {float(exact[j, i])!r}, its quarters"
                f" have the mean {float(quarters[j, i])!r}"
            )


def _halved(edges: Array) -> Array:
    return np.sort(np.concatenate([edges, (edges[:-1] + edges[1:]) / 2.0]))


@conformance_check("constants", 3, kind="scene")
def check_constants(subject: SceneSubject) -> None:
    """Every sample of a pixel that is called constant has that value, and so has the reference."""
    if subject.scene.at_centre:
        raise NotApplicable("its pixels are seen at their centres")
    rng = np.random.default_rng(7)
    corners = np.stack([a.ravel() for a in np.meshgrid([0.0, 0.5, _ALMOST_ONE], [0.0, 0.5, _ALMOST_ONE])])
    found = 0
    for x_edges, y_edges in [*_windows(subject), (np.arange(33) / 32, np.arange(33) / 32)]:
        constant = subject.scene.constant(x_edges, y_edges)
        for j, i in np.argwhere(~np.isnan(constant)):
            found += 1
            box = _box(x_edges, y_edges, j, i)
            value = float(constant[j, i])
            u = rng.random((subject.dims, 200))
            u[:2, : corners.shape[1]] = corners
            values = subject.values(u, box)
            wrong = np.flatnonzero(values != value)
            if wrong.size:
                raise CheckFailed(
                    f"{_name(subject, box)} is called constant {value!r}, but at {u[:, wrong[0]].tolist()} within it"
                    f" the value is {float(values[wrong[0]])!r}"
                )
            image, bound = _reference(subject, x_edges[i : i + 2], y_edges[j : j + 2])
            exact = float(image[0, 0])
            if abs(exact - value) > bound + 1e-12 * max(1.0, abs(exact)):
                raise CheckFailed(f"{_name(subject, box)} is called constant {value!r}, but its reference is {exact!r}")
    if not found:
        raise NotApplicable("none of the pixels examined is declared constant")
    subject.note(f"{found} constant pixels")


@conformance_check("dimensions-used", 4, kind="scene")
def check_dimensions_used(subject: SceneSubject) -> None:
    """Every dimension that the scene asks for changes its value somewhere."""
    declared = [purpose for purpose, _ in subject.spec.purposes]
    unknown = [purpose for purpose in subject.scene.needs if purpose not in declared]
    if unknown:
        raise CheckFailed(f"scene {subject.text} needs {', '.join(unknown)}, which its declaration does not name")
    rng = np.random.default_rng(11)
    box = np.array([0.0, 1.0, 0.0, 1.0])
    u = rng.random((subject.dims, 1 << 14))
    before = subject.values(u, box)
    names = [f"{purpose} {i}" for purpose, number in subject.scene.needs.items() for i in range(number)]
    unused = []
    for dimension, name in enumerate(names):
        moved = u.copy()
        moved[dimension] = rng.random(u.shape[1])
        # A constant scene uses nothing, and an image needs its two pixel dimensions all the same.
        if (subject.values(moved, box) == before).all() and not name.startswith("pixel "):
            unused.append(name)
    if unused:
        raise CheckFailed(f"scene {subject.text} asks for dimensions that change nothing: {', '.join(unused)}")


@conformance_check("value-range", 7, kind="scene")
def check_value_range(subject: SceneSubject) -> None:
    """No value over the unit square lies outside of the range that the scene declares."""
    bounds = subject.scene.value_range
    if bounds is None:
        raise NotApplicable("it declares no range of its values")
    u = np.random.default_rng(14).random((subject.dims, 1 << 14))
    values = subject.values(u, np.array([0.0, 1.0, 0.0, 1.0]))
    outside = np.flatnonzero((values < bounds[0]) | (values > bounds[1]))
    if outside.size:
        value = float(values[outside[0]])
        raise CheckFailed(f"scene {subject.text}: the value {value!r} is outside of value_range={bounds}")


@conformance_check("purity", 5, kind="scene")
def check_scene_purity(subject: SceneSubject) -> None:
    """The sum of a pixel is the same again, alone and in another thread; nothing else changes, nothing is printed."""
    rng = np.random.default_rng(13)
    pixels = 40
    boxes = np.stack([rng.integers(0, 64, pixels) / 64, np.full(pixels, 1 / 64)] * 2)
    for count in (1, 7, _BLOCK):
        tile = rng.random((pixels, subject.dims, count))
        with changing_nothing():
            whole = subject.sums(tile, boxes)
        with ThreadPoolExecutor(1) as thread:
            again = thread.submit(subject.sums, tile, boxes).result()
        alone = np.concatenate([subject.sums(tile[p : p + 1], boxes[:, p : p + 1]) for p in range(pixels)])
        for other, when in ((again, "in another thread"), (alone, "when it is asked for alone")):
            different = np.flatnonzero(whole.view(np.uint64) != other.view(np.uint64))
            if different.size:
                p = int(different[0])
                raise CheckFailed(
                    f"scene {subject.text}: the sum of {count} samples of pixel {boxes[:, p].tolist()} is"
                    f" {float(whole[p])!r}, but {float(other[p])!r} {when}"
                )
