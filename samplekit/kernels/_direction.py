"""The direction of an angle in degrees."""

import math


def direction(degrees: float) -> tuple[float, float]:
    """Return cosine and sine, within 2e-16; multiples of 90 give exact zeros and ones, of 45 equal magnitudes.

    The reduction to [-45, 45] is exact, however large the angle (remainder: IEEE 754-2019, 5.3.1).
    """
    turned = math.remainder(degrees, 360.0)
    quarters = round(turned / 90.0)
    rest = turned - 90.0 * quarters
    cosine, sine = math.cos(math.radians(rest)), math.sin(math.radians(rest))
    if abs(rest) == 45.0:
        cosine, sine = math.sqrt(0.5), math.copysign(math.sqrt(0.5), rest)
    x, y = ((cosine, sine), (-sine, cosine), (-cosine, -sine), (sine, -cosine))[quarters % 4]
    return x + 0.0, y + 0.0  # No negative zeros.
