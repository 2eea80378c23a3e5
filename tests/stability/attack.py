"""A search for the boxes at which references err the most, against the bounds that they state.

hypothesis draws options and boxes around what is hard of each scene (an edge, a peak, a kink, a place far away), and
its ``target`` climbs to the worst ratio of error to bound.
"""

import math
from dataclasses import dataclass
from fractions import Fraction

import hypothesis
import numpy as np
from hypothesis import strategies as st
from mpmath import mp, mpf
from truths import TRUTHS

import samplekit

DIGITS = 120
"""Enough for boxes of 1e-18 of a circle: the polygons that truths are made of cancel twice as many."""
TOUCHING = 1e-60
"""What is left of an area that is 0 where a side only touches."""


@dataclass
class Worst:
    """The worst case so far: its ratio of error to bound, and how many boxes were looked at."""

    ratio: float = -1.0
    case: str = ""
    boxes: int = 0
    beyond: int = 0


@dataclass(frozen=True)
class Bound:
    """What a reference states: an absolute bound, or one relative to the mean where that is a normal number."""

    absolute: float = 0.0
    relative: float = 0.0

    def allowed(self, truth):
        return mpf(self.absolute) + mpf(self.relative) * abs(truth) + mpf(2.0**-1074) * 4


def logs(low, high):
    """Powers of ten from 10^low to 10^high, both tails included."""
    return st.floats(low, high).map(lambda exponent: float(10.0**exponent))


def around(place, width):
    """An interval of that width near the place: at its side, around it, or with the place as an end."""
    shifts = st.one_of(st.floats(-1.5, 0.5), st.sampled_from([0.0, -1.0, -0.5]))

    def interval(shift):
        left = place + shift * width
        return left, left + width

    return shifts.map(interval)


@st.composite
def boxes(draw, px, py, smallest=-9.0, largest=0.0):
    width = draw(logs(smallest, largest))
    height = width if draw(st.booleans()) else draw(logs(smallest, largest))
    x0, x1 = draw(around(px, width))
    y0, y1 = draw(around(py, height))
    hypothesis.assume(x0 < x1 and y0 < y1)
    return x0, x1, y0, y1


coordinate = st.floats(0.0, 1.0)


@st.composite
def bilinear(draw):
    return "bilinear", draw(boxes(draw(st.floats(-2, 2)), draw(st.floats(-2, 2)))), Bound(relative=4.5e-16)


@st.composite
def checker(draw):
    cells = draw(st.one_of(st.integers(1, 20), st.integers(1, 2**20)))
    px, py = (draw(st.one_of(coordinate, st.integers(0, cells).map(lambda i: i / cells))) for _ in range(2))
    return f"checker:cells={cells}", draw(boxes(px, py)), Bound(absolute=1e-15)


@st.composite
def spike(draw):
    area = draw(logs(-29.0, 0.0))
    peak, background = draw(logs(-200, 280)), draw(logs(-200, 280))
    cx, cy = draw(coordinate), draw(coordinate)
    half = 0.5 * math.sqrt(area)
    px, py = cx + draw(st.sampled_from([-half, half, 0.0])), cy + draw(st.sampled_from([-half, half, 0.0]))
    hypothesis.assume(cx - half < cx + half and cy - half < cy + half)
    text = f"spike:peak={peak!r},background={background!r},area={area!r},cx={cx!r},cy={cy!r}"
    return text, draw(boxes(px, py, -12.0)), Bound(relative=2e-15)


@st.composite
def power(draw):
    a = draw(st.one_of(st.floats(0.0, 0.99), st.sampled_from([0.49, 0.5, 0.99])))
    place = draw(st.one_of(st.just(0.0), coordinate, logs(-300, 0)))
    return f"power:a={a!r}", draw(boxes(place, 0.5, -12.0)), Bound(relative=4e-15)


@st.composite
def gaussian(draw):
    sigma = draw(logs(-12, 8))
    cx, cy = draw(coordinate), draw(coordinate)
    reach = draw(st.floats(-36.0, 36.0)) * sigma
    px = cx + draw(st.sampled_from([0.0, reach]))
    py = cy + draw(st.sampled_from([0.0, draw(st.floats(-36.0, 36.0)) * sigma]))
    text = f"gaussian:sigma={sigma!r},cx={cx!r},cy={cy!r}"
    return text, draw(boxes(px, py, max(-12.0, min(-2.0, math.log10(sigma) - 3.0)), 1.0)), Bound(relative=5e-15)


@st.composite
def zoneplate(draw):
    k = draw(logs(-3, 12))
    cx, cy = draw(st.sampled_from([0.0, 0.5, draw(coordinate)])), draw(st.sampled_from([0.0, draw(coordinate)]))
    px, py = (draw(st.one_of(coordinate, st.just(c))) for c in (cx, cy))
    return f"zoneplate:k={k!r},cx={cx!r},cy={cy!r}", draw(boxes(px, py)), Bound(absolute=5e-16)


@st.composite
def steps(draw, width):
    any_angle = st.floats(-360, 360).map(lambda angle: angle if abs(angle) > 1e-20 else 0.0)
    angle = draw(st.one_of(any_angle, st.sampled_from([0.0, 45.0, 90.0, 1e-9, 30.0]), logs(-14, 0)))
    plain = samplekit.scene("step", angle=angle)._scene
    px, py = draw(coordinate), draw(coordinate)
    offset = plain.cosine * px + plain.sine * py + draw(st.floats(-50.0, 800.0)) * width
    # Boxes wider than 1e-14 of their distance from the origin.
    where = boxes(px, py, max(-12.0, math.log10(width) - 6.0) if width else -12.0)
    return f"step:angle={angle!r},offset={offset!r},width={width!r}", draw(where)


@st.composite
def sheer_step(draw):
    return *draw(steps(0.0)), Bound(absolute=1e-15)


@st.composite
def smooth_step(draw):
    return *draw(steps(draw(logs(-15, 3)))), Bound(relative=1e-12, absolute=1e-320)


@st.composite
def smooth_step_absolute(draw):
    return *draw(steps(draw(logs(-15, 3)))), Bound(absolute=2e-15)


@st.composite
def disk(draw):
    radius = draw(logs(-9, 9))
    cx, cy = draw(coordinate), draw(coordinate)
    turn = draw(st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 0.25, 0.5, 0.75]))) * 2.0 * math.pi
    px, py = cx + radius * math.cos(turn), cy + radius * math.sin(turn)
    smallest = max(-9.0, math.log10(radius) - 9.0)
    where = boxes(px, py, smallest, max(0.0, smallest + 1.0))
    return f"disk:radius={radius!r},cx={cx!r},cy={cy!r}", draw(where), Bound(relative=1e-14, absolute=TOUCHING)


@st.composite
def ellipse(draw):
    radius, aspect = draw(logs(-4, 2)), draw(st.one_of(logs(-9, 0), st.just(1.0)))
    angle = draw(st.one_of(st.floats(-180, 180), st.sampled_from([0.0, 45.0, 90.0]), logs(-12, 0)))
    cx, cy = draw(coordinate), draw(coordinate)
    turn = draw(st.one_of(st.floats(0.0, 1.0), st.sampled_from([0.0, 0.25, 0.5, 0.75]))) * 2.0 * math.pi
    along, across = radius * math.cos(turn), aspect * radius * math.sin(turn)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    px, py = cx + c * along - s * across, cy + s * along + c * across
    text = f"ellipse:radius={radius!r},aspect={aspect!r},angle={angle!r},cx={cx!r},cy={cy!r}"
    x0, x1, y0, y1 = draw(boxes(px, py, -9.0))
    touching = 1e-28 * max(1.0, radius / min(x1 - x0, y1 - y0))
    return text, (x0, x1, y0, y1), Bound(relative=1e-13, absolute=touching)


@st.composite
def genz(draw, families, bound):
    family = draw(st.sampled_from(families))
    d = draw(st.integers(1, 12))
    difficulty = draw(st.one_of(logs(-9, 12), logs(-1, 2)))
    u = draw(st.one_of(coordinate, st.sampled_from([0.0, 0.5, 1.0])))
    px, py = (draw(st.one_of(coordinate, st.just(u))) for _ in range(2))
    if family == "corner-peak":
        px, py = min(px, 0.9), min(py, 0.9)
    text = f"oscillating:family={family},d={d},difficulty={difficulty!r},u={u!r}"
    x0, x1, y0, y1 = draw(boxes(px, py, -6.0))
    if family == "corner-peak":
        x0, y0 = max(x0, 0.0), max(y0, 0.0)
        hypothesis.assume(x0 < x1 and y0 < y1)
    return text, (x0, x1, y0, y1), bound


def oscillatory():
    return genz(("oscillatory",), Bound(absolute=2e-15))


def peaks():
    return genz(("product-peak", "corner-peak", "gaussian", "continuous", "discontinuous"), Bound(relative=5e-14))


ATTACKS = {
    "bilinear": bilinear(),
    "checker": checker(),
    "spike": spike(),
    "power": power(),
    "gaussian": gaussian(),
    "zoneplate": zoneplate(),
    "sheer step": sheer_step(),
    "smooth step, relative": smooth_step(),
    "smooth step, absolute": smooth_step_absolute(),
    "disk": disk(),
    "ellipse": ellipse(),
    "oscillatory": oscillatory(),
    "peaks of Genz": peaks(),
}


def ratio(text, box, bound):
    """The error of a reference over what its bound allows."""
    configured = samplekit.scene(text)
    scene = configured._scene
    x_edges, y_edges = np.array(box[:2]), np.array(box[2:])
    mean = configured.exact(x_edges, y_edges)[0, 0]
    with mp.workdps(DIGITS):
        truth = TRUTHS[text.partition(":")[0]](scene, *box)
        truth = mpf(truth.numerator) / truth.denominator if isinstance(truth, Fraction) else truth
        if not math.isfinite(mean):
            return math.inf
        return float(abs(mpf(float(mean)) - truth) / bound.allowed(truth))


def attack(name, examples, seed=0, *, stop=True):
    """Search ``examples`` boxes; ``stop``: raise at the first ratio above 1."""
    worst = Worst()

    @hypothesis.seed(seed)
    @hypothesis.settings(
        max_examples=examples,
        database=None,
        deadline=None,
        suppress_health_check=list(hypothesis.HealthCheck),
        phases=[hypothesis.Phase.generate, hypothesis.Phase.target],
    )
    @hypothesis.given(ATTACKS[name])
    def search(case):
        found = ratio(*case)
        worst.boxes += 1
        worst.beyond += found > 1.0
        if found > worst.ratio:
            worst.ratio, worst.case = found, f"{case[0]} over {case[1]}"
        # A ratio has no scale: its logarithm climbs as well near 0 as near 1.
        hypothesis.target(math.log(min(max(found, 1e-30), 1e30)))
        assert not stop or found <= 1.0, (found, case)

    search()
    return worst
