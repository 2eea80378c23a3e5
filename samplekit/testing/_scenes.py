"""Checks of scenes: the reference against another quadrature, constant pixels against samples, dimensions, purity."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING

import numpy as np

from samplekit.testing._imports import judge_light_import
from samplekit.testing._purity import printing_nothing, untouched_globals
from samplekit.testing._result import CheckFailed, NotApplicable, check
from samplekit.testing._statistics import SAMPLER_RATE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from samplekit.testing._scene_subject import SceneSubject

_NODES = (16, 32, 64)
_SMOOTH = 1e-12
_SMOOTH_TOLERANCE = 1e-10
_SHIFTS = 32
_LATTICE = 4093
_BLOCK = 1024
_ALMOST_ONE = 1.0 - 2.0**-53


def _windows(subject: SceneSubject) -> list[tuple[NDArray[np.float64], NDArray[np.float64]]]:
    """Edges of the pixels that are judged: the whole square in 8 x 8, and small pixels of a large image."""
    coarse = np.arange(9) / 8
    windows = [(coarse, coarse)]
    for x, y in ((0, 0), (230, 272), (384, 100), (508, 508)):
        windows.append((np.arange(x, x + 5) / 512, np.arange(y, y + 5) / 512))
    return windows[: 2 if subject.quick else None]


def _reference(
    subject: SceneSubject, x_edges: NDArray[np.float64], y_edges: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float]:
    """The reference, and the bound that the scene states for its error."""
    if subject.scene.at_centre:
        raise NotApplicable("its pixels are seen at their centres: there is no mean over a pixel")
    reference = subject.scene.reference(x_edges, y_edges)
    if reference.numerical:
        raise NotApplicable("it has no reference of its own")
    return reference.image, reference.error


@check("reference", 1, kind="scene", tolerance="1e-10 where smooth; else t-test, family-wise 1e-3")
def check_reference(subject: SceneSubject) -> None:
    """The exact mean of a pixel is what another quadrature gives: Gauss-Legendre, or shifted lattices."""
    windows = _windows(subject)
    tests = sum((x.size - 1) * (y.size - 1) for x, y in windows)
    smooth = 0
    for x_edges, y_edges in windows:
        exact, bound = _reference(subject, x_edges, y_edges)
        if not np.isfinite(exact).all():
            raise CheckFailed(f"scene {subject.text}: the reference is not finite")
        for j, i in np.ndindex(exact.shape):
            box = np.array([x_edges[i], x_edges[i + 1] - x_edges[i], y_edges[j], y_edges[j + 1] - y_edges[j]])
            mean, tolerance = _quadrature(subject, box, tests)
            smooth += tolerance <= _SMOOTH_TOLERANCE * max(1.0, abs(mean))
            if abs(exact[j, i] - mean) > tolerance + bound:
                raise CheckFailed(
                    f"scene {subject.text}, pixel [{x_edges[i]}, {x_edges[i + 1]}] x [{y_edges[j]}, {y_edges[j + 1]}]:"
                    f" the reference is {exact[j, i]!r}, another quadrature gives {mean:.12g} within {tolerance:.2g}"
                    f" (the scene states {bound:g} for its own error)"
                )
    subject.note(f"{smooth} of {tests} pixels by Gauss-Legendre to 1e-10, the others by lattices")


def _quadrature(subject: SceneSubject, box: NDArray[np.float64], tests: int) -> tuple[float, float]:
    """The mean over a pixel, and how far off it may be."""
    if subject.dims == 2:
        previous = math.nan
        for nodes in _NODES[: 2 if subject.quick else None]:
            x, w = np.polynomial.legendre.leggauss(nodes)
            u = np.stack([axis.ravel() for axis in np.meshgrid((x + 1) / 2, (x + 1) / 2)])
            values = subject.values(u, box)
            mean = float(np.outer(w, w).ravel() @ values) / 4.0
            scale = max(1.0, abs(mean))
            # Rules that see one value agree whatever passes between their nodes: a needle, a spike.
            if abs(mean - previous) <= _SMOOTH * scale and np.ptp(values) > 0.0:
                return mean, _SMOOTH_TOLERANCE * scale
            previous = mean
    from scipy.special import stdtrit

    means = np.array([subject.mean(u, box) for u in _shifted_lattices(subject.dims)])
    error = float(means.std(ddof=1)) / math.sqrt(_SHIFTS)
    threshold = -float(stdtrit(_SHIFTS - 1, SAMPLER_RATE / tests / 2))
    # Sets that all give one value may all miss the same sliver: it is smaller than the cells of a lattice.
    mean = float(means.mean())
    return mean, threshold * error + 2.0 / _LATTICE + _SMOOTH * abs(mean)


def _shifted_lattices(dims: int) -> list[NDArray[np.float64]]:
    """Kronecker sets with square roots of primes as steps, each with a random shift: unbiased, and nobody's sampler."""
    steps = np.sqrt(np.array([2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53][:dims], float))
    base = np.arange(_LATTICE)[None, :] * steps[:, None]
    shifts = np.random.default_rng(5).random((_SHIFTS, dims, 1))
    return [np.minimum((base + shift) % 1.0, _ALMOST_ONE) for shift in shifts]


@check("refinement", 2, kind="scene", tolerance="1e-12, and twice the error that the scene states")
def check_refinement(subject: SceneSubject) -> None:
    """The exact mean of a pixel is the mean of the exact means of its four quarters."""
    for x_edges, y_edges in _windows(subject):
        exact, bound = _reference(subject, x_edges, y_edges)
        fine, _ = _reference(subject, _halved(x_edges), _halved(y_edges))
        quarters = (fine[::2, ::2] + fine[1::2, ::2] + fine[::2, 1::2] + fine[1::2, 1::2]) / 4.0
        apart = np.abs(quarters - exact)
        j, i = np.unravel_index(int(apart.argmax()), apart.shape)
        if apart[j, i] > 2.0 * bound + 1e-12 * max(1.0, float(np.abs(exact).max())):
            raise CheckFailed(
                f"scene {subject.text}, pixel [{x_edges[i]}, {x_edges[i + 1]}] x [{y_edges[j]}, {y_edges[j + 1]}]:"
                f" the reference is {exact[j, i]!r}, its quarters have the mean {quarters[j, i]!r}"
            )


def _halved(edges: NDArray[np.float64]) -> NDArray[np.float64]:
    middles = (edges[:-1] + edges[1:]) / 2.0
    return np.sort(np.concatenate([edges, middles]))


@check("constants", 3, kind="scene", tolerance="bit for bit")
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
            box = np.array([x_edges[i], x_edges[i + 1] - x_edges[i], y_edges[j], y_edges[j + 1] - y_edges[j]])
            u = rng.random((subject.dims, 200))
            u[:2, : corners.shape[1]] = corners
            values = subject.values(u, box)
            wrong = np.flatnonzero(values != constant[j, i])
            if wrong.size:
                raise CheckFailed(
                    f"scene {subject.text}, pixel [{x_edges[i]}, {x_edges[i + 1]}] x [{y_edges[j]}, {y_edges[j + 1]}]"
                    f" is called constant {constant[j, i]!r}, but at {u[:, wrong[0]].tolist()} within it the value is"
                    f" {float(values[wrong[0]])!r}"
                )
            image, bound = _reference(subject, x_edges[i : i + 2], y_edges[j : j + 2])
            exact = float(image[0, 0])
            if abs(exact - constant[j, i]) > bound + 1e-12 * max(1.0, abs(exact)):
                raise CheckFailed(
                    f"scene {subject.text}, pixel ({i}, {j}): called constant {constant[j, i]!r}, reference {exact!r}"
                )
    if not found:
        raise NotApplicable("it calls no pixel of those looked at constant")
    subject.note(f"{found} constant pixels")


@check("dimensions-used", 4, kind="scene")
def check_dimensions_used(subject: SceneSubject) -> None:
    """Every dimension that it asks for changes its value somewhere: others are drawn for nothing."""
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
        if (subject.values(moved, box) == before).all():
            unused.append(name)
    # A constant scene uses nothing, and an image needs its two pixel dimensions all the same.
    unused = [name for name in unused if not name.startswith("pixel ")]
    if unused:
        raise CheckFailed(f"scene {subject.text} asks for dimensions that change nothing: {', '.join(unused)}")


@check("purity", 5, kind="scene", tolerance="bit for bit")
def check_scene_purity(subject: SceneSubject) -> None:
    """A pixel's sum is the same again, alone, from another thread; nothing else is changed, nothing printed."""
    rng = np.random.default_rng(13)
    pixels = 40
    boxes = np.ascontiguousarray(
        np.stack([rng.integers(0, 64, pixels) / 64, np.full(pixels, 1 / 64)] * 2), dtype=np.float64
    )
    for count in (1, 7, _BLOCK):
        tile = rng.random((pixels, subject.dims, count))
        whole = np.full(pixels, np.nan)
        with untouched_globals(), printing_nothing():
            subject.scene.sums(tile.copy(), boxes, whole)
        again = np.full(pixels, np.nan)
        thread = threading.Thread(target=subject.scene.sums, args=(tile.copy(), boxes, again))
        thread.start()
        thread.join()
        alone = np.full(pixels, np.nan)
        for p in range(pixels):
            one = np.full(1, np.nan)
            subject.scene.sums(tile[p : p + 1].copy(), boxes[:, p : p + 1].copy(), one)
            alone[p] = one[0]
        subject.drawn += 3 * pixels * count
        for other, when in ((again, "in another thread"), (alone, "when it is asked for alone")):
            different = np.flatnonzero(whole.view(np.uint64) != other.view(np.uint64))
            if different.size:
                p = int(different[0])
                raise CheckFailed(
                    f"scene {subject.text}: the sum of {count} samples of pixel {boxes[:, p].tolist()} is"
                    f" {float(whole[p])!r}, but {float(other[p])!r} {when}"
                )


@check("light-import", 6, kind="scene")
def check_scene_import(subject: SceneSubject) -> None:
    """Naming, listing and completing it imports neither NumPy nor the implementation."""
    judge_light_import(subject.scene.plugin.name, installed=isinstance(subject.recipe, str))


CHECKS = (
    check_reference,
    check_refinement,
    check_constants,
    check_dimensions_used,
    check_scene_purity,
    check_scene_import,
)
