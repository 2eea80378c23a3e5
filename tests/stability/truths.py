"""True means over a box in many digits: rational numbers where they do, mpmath elsewhere. None of it is samplekit's."""

import itertools
import math
from fractions import Fraction

import mpmath
from mpmath import mp, mpf


def part_between(left, right, start, end):
    """The part of [left, right] that lies in [start, end], a fraction."""
    return max(Fraction(0), min(right, end) - max(left, start)) / (right - left)


def bilinear(scene, x0, x1, y0, y1):
    x0, x1, y0, y1 = map(Fraction, (x0, x1, y0, y1))
    return (x0 + x1) * (y0 + y1) / 4


def checker(scene, x0, x1, y0, y1):
    cells = Fraction(scene.cells)

    def wave(left, right):
        """The mean of the square wave, from its antiderivative: a triangle."""

        def antiderivative(x):
            phase = x * cells
            whole = phase.numerator // phase.denominator
            rest = phase - whole
            return (rest if whole % 2 == 0 else 1 - rest) / cells

        return (antiderivative(right) - antiderivative(left)) / (right - left)

    return Fraction(1, 2) + wave(Fraction(x0), Fraction(x1)) * wave(Fraction(y0), Fraction(y1)) / 2


def spike(scene, x0, x1, y0, y1):
    square = [Fraction(float(side)) for side in scene.square]
    covered = part_between(Fraction(x0), Fraction(x1), *square[:2]) * part_between(
        Fraction(y0), Fraction(y1), *square[2:]
    )
    return Fraction(scene.peak) * covered + Fraction(scene.background) * (1 - covered)


def power(scene, x0, x1, y0, y1):
    b = 1 - mpf(scene.a)

    def antiderivative(x):
        return mp.sign(x) * abs(x) ** b / b

    return (antiderivative(mpf(x1)) - antiderivative(mpf(x0))) / (mpf(x1) - mpf(x0))


def gaussian(scene, x0, x1, y0, y1):
    def along(left, right, centre):
        scale = 1 / (mpf(scene.sigma) * mp.sqrt(2))
        a, b = (mpf(left) - mpf(centre)) * scale, (mpf(right) - mpf(centre)) * scale
        if a > 0:
            return mp.sqrt(mp.pi) / 2 * (mp.erfc(a) - mp.erfc(b)) / (b - a)
        if b < 0:
            return mp.sqrt(mp.pi) / 2 * (mp.erfc(-b) - mp.erfc(-a)) / (b - a)
        return mp.sqrt(mp.pi) / 2 * (mp.erf(b) - mp.erf(a)) / (b - a)

    return along(x0, x1, scene.cx) * along(y0, y1, scene.cy)


def zoneplate(scene, x0, x1, y0, y1):
    k = mpf(scene.k)

    def along(left, right, centre):
        a, b = mpf(left) - mpf(centre), mpf(right) - mpf(centre)
        if k == 0:
            return mpf(1), mpf(0)
        factor, scale = mp.sqrt(mp.pi / (2 * k)) / (b - a), mp.sqrt(2 * k / mp.pi)
        return (
            factor * (mp.fresnelc(b * scale) - mp.fresnelc(a * scale)),
            factor * (mp.fresnels(b * scale) - mp.fresnels(a * scale)),
        )

    (xc, xs), (yc, ys) = along(x0, x1, scene.cx), along(y0, y1, scene.cy)
    return mpf(1) / 2 + (xc * yc - xs * ys) / 2


def sheer_step(scene, x0, x1, y0, y1):
    """Clip the rectangle (Sutherland, Hodgman 1974), then Gauss's area."""
    x0, x1, y0, y1, cosine, sine, offset = map(Fraction, (x0, x1, y0, y1, scene.cosine, scene.sine, scene.offset))
    rectangle = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    inside = []
    for start, end in zip(rectangle, rectangle[1:] + rectangle[:1], strict=True):
        here, there = (offset - cosine * x - sine * y for x, y in (start, end))
        if here >= 0:
            inside.append(start)
        if here * there < 0:
            t = here / (here - there)
            inside.append((start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])))
    twice = sum(a[0] * b[1] - b[0] * a[1] for a, b in itertools.pairwise([*inside, *inside[:1]]))
    return Fraction(twice) / (2 * (x1 - x0) * (y1 - y0))


def step(scene, x0, x1, y0, y1):
    if scene.width == 0.0:
        return sheer_step(scene, x0, x1, y0, y1)
    extents = abs(scene.cosine) * (x1 - x0), abs(scene.sine) * (y1 - y0)
    lost = sum(max(0.0, math.log10(scene.width) - math.log10(extent)) for extent in extents if extent)
    with mpmath.workdps(mp.dps + 2 * int(lost)):
        return smooth_step(scene, *map(mpf, (x0, x1, y0, y1)))


def smooth_step(scene, x0, x1, y0, y1):
    """The second antiderivative of the sigmoid at the four corners."""
    width, cosine, sine = mpf(scene.width), mpf(scene.cosine), mpf(scene.sine)

    def depth(x, y):
        return (mpf(scene.offset) - cosine * x - sine * y) / width

    if cosine == 0 or sine == 0:
        ends = (depth(x0, y0), depth(x1, y1))
        return (softplus(ends[0]) - softplus(ends[1])) / (ends[0] - ends[1])
    corners = second(depth(x0, y0)) - second(depth(x1, y0)) - second(depth(x0, y1)) + second(depth(x1, y1))
    return corners * width**2 / (cosine * (x1 - x0) * sine * (y1 - y0))


def softplus(z):
    """The antiderivative of the sigmoid 1 / (1 + exp(-z))."""
    return z + mp.log1p(mp.exp(-z)) if z > 0 else mp.log1p(mp.exp(z))


def second(z):
    """The antiderivative of ``softplus``: -Li2(-exp z)."""
    if z > 0:
        return mp.pi**2 / 6 + z * z / 2 - second(-z)
    if z > -3:
        return -mp.polylog(2, -mp.exp(z))
    total, term, k = mpf(0), mp.exp(z), 1
    power_of_e = term
    while abs(term) > abs(total) * mp.eps or k < 3:
        total += term
        k += 1
        power_of_e *= -mp.exp(z)
        term = power_of_e / k**2
    return total


def disk(scene, x0, x1, y0, y1):
    return within_unit_circle(
        [
            ((mpf(x) - mpf(scene.cx)) / mpf(scene.radius), (mpf(y) - mpf(scene.cy)) / mpf(scene.radius))
            for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
        ]
    )


def ellipse(scene, x0, x1, y0, y1):
    """Squeezed into a circle, the box becomes a parallelogram."""
    c, s, a, b = map(mpf, (scene.cosine, scene.sine, scene.major, scene.minor))
    corners = []
    for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)):
        dx, dy = mpf(x) - mpf(scene.cx), mpf(y) - mpf(scene.cy)
        corners.append(((c * dx + s * dy) / a, (c * dy - s * dx) / b))
    return within_unit_circle(corners)


def within_unit_circle(corners):
    """The part of a convex polygon that the unit circle covers: each side's triangle with the centre, and sectors."""
    area, whole = mpf(0), mpf(0)
    for (px, py), (qx, qy) in zip(corners, corners[1:] + corners[:1], strict=True):
        whole += (px * qy - py * qx) / 2
        dx, dy = qx - px, qy - py
        length2 = dx * dx + dy * dy
        along = -(px * dx + py * dy) / length2
        gap2 = 1 - (px * dy - py * dx) ** 2 / length2
        if gap2 > 0:
            half = mp.sqrt(gap2 / length2)
            first, last = max(mpf(0), along - half), min(mpf(1), along + half)
        if gap2 <= 0 or first >= last:
            area += angle(px, py, qx, qy) / 2
            continue
        ax, ay, bx, by = px + first * dx, py + first * dy, px + last * dx, py + last * dy
        area += (ax * by - ay * bx) / 2
        if first > 0:
            area += angle(px, py, ax, ay) / 2
        if last < 1:
            area += angle(bx, by, qx, qy) / 2
    return area / whole


def angle(px, py, qx, qy):
    return mp.atan2(px * qy - py * qx, px * qx + py * qy)


def oscillating(scene, x0, x1, y0, y1):
    a, u = [mpf(float(each)) for each in scene.coefficients], mpf(scene.u)
    sides = [(mpf(x0), mpf(x1)), (mpf(y0), mpf(y1))][: len(a)] + [(mpf(0), mpf(1))] * (len(a) - 2)
    if scene.family == "oscillatory":
        total = mp.expjpi(2 * u)
        for each, (left, right) in zip(a, sides, strict=True):
            total *= (mp.expjpi(2 * each * right) - mp.expjpi(2 * each * left)) / (2j * mp.pi * each * (right - left))
        return total.real
    if scene.family == "corner-peak":
        return corner_peak(a, sides)
    product = mpf(1)
    for k, (each, (left, right)) in enumerate(zip(a, sides, strict=True)):
        place = u if k < 2 or scene.family != "discontinuous" else mpf(1)
        product *= factor(scene.family, each, place, left, right)
    return product


def factor(family, a, u, left, right):
    if family == "product-peak":
        return (mp.atan(a * (right - u)) - mp.atan(a * (left - u))) / (a * (right - left))
    if family == "gaussian":
        ends = [a * (left - u), a * (right - u)]
        if ends[0] > 0 or ends[1] < 0:
            near, far = sorted(map(abs, ends))
            return mp.sqrt(mp.pi) / 2 * (mp.erfc(near) - mp.erfc(far)) / (a * (right - left))
        return mp.sqrt(mp.pi) / 2 * (mp.erf(ends[1]) - mp.erf(ends[0])) / (a * (right - left))
    if family == "continuous":

        def antiderivative(x):
            return mp.sign(x - u) * -mp.expm1(-a * abs(x - u)) / a

        if left >= u or right <= u:
            near, far = sorted((abs(left - u), abs(right - u)))
            return mp.exp(-a * near) * -mp.expm1(-a * (far - near)) / (a * (right - left))
        return (antiderivative(right) - antiderivative(left)) / (right - left)
    end = min(right, u)
    if end <= left:
        return mpf(0)
    return mp.exp(a * (end - u)) * -mp.expm1(-a * (end - left)) / (a * (right - left))


def corner_peak(a, sides):
    """The textbook's alternating sum over the corners, with as many digits as it loses, and more."""
    d = len(a)
    lower = 1 + sum(each * left for each, (left, _) in zip(a, sides, strict=True))
    steps = [each * (right - left) for each, (left, right) in zip(a, sides, strict=True)]
    lost = sum(max(0, int(mp.log10(lower / step)) + 1) for step in steps)
    with mpmath.workdps(60 + 2 * lost + d):
        corners = [(lower, 1)]
        for step in steps:
            corners += [(t + step, -sign) for t, sign in corners]
        total = mp.fsum(sign / t for t, sign in corners)
        return total / (mp.factorial(d) * mp.fprod(steps))


TRUTHS = {
    function.__name__: function
    for function in (bilinear, checker, spike, power, gaussian, zoneplate, step, disk, ellipse, oscillating)
}
