"""Ambient occlusion: the part of the sky that a floor and a sphere above it see, each past the other.

Langer and Bülthoff 2000, "Depth discrimination from shading under diffuse lighting": light from everywhere, weighted by
the cosine with the normal. Directions are uniform in the disk under the hemisphere (Malley's method; Pharr, Jakob,
Humphreys, "Physically Based Rendering", A.5.3), so that the mean is the share of rays that escape. Dimension 0 of a
direction is its azimuth, dimension 1 the squared sine of its angle with the normal: where the unit square wraps around,
so does the azimuth, as suits point sets that are made on the torus. The share of rays that escape has closed forms:

- from the floor, at a distance D from the centre of a sphere of radius R at the height h: 1 - R^2 h / D^3, the form
  factor of a sphere wholly above the horizon (Howell, "A catalog of radiation heat transfer configuration factors");
- from the sphere, where its normal has the vertical component n: (1 + n) / 2.

The camera is orthographic and looks down at the slope 3 : 4, so that the sphere's outline is a circle. The mean over a
pixel is an adaptive integral of the closed forms, which follows that circle.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from samplekit import Scene, UsageError
from samplekit.kernels import BLOCK, cosine_of_turns, fma, kernel, lane_sum

Array = NDArray[np.float64]

_VIEW = 5.0  # width and height of the picture, in units of the floor
_SINE, _COSINE = 0.6, 0.8  # of the camera's elevation
_AIM = 0.4  # the point at the height 1/2 above the floor's origin is in the middle


@kernel("void(float64[:,:,::1], float64[:,::1], float64[::1], float64, float64, float64, float64)")
def _sums(tile: Array, boxes: Array, out: Array, radius: float, height: float, cx: float, cy: float) -> None:
    pixels, _, count = tile.shape
    values = np.empty(BLOCK)
    sphere_v = cy * _SINE + height * _COSINE - _AIM
    per_radius = 1.0 / radius
    for pixel in range(pixels):
        left, width, top, breadth = boxes[0, pixel], boxes[1, pixel], boxes[2, pixel], boxes[3, pixel]
        for i in range(count):
            u = (fma(tile[pixel, 0, i], width, left) - 0.5) * _VIEW - cx
            v = (0.5 - fma(tile[pixel, 1, i], breadth, top)) * _VIEW
            # The direction about the normal, and its component along it.
            sine = math.sqrt(tile[pixel, 3, i])
            across = sine * cosine_of_turns(tile[pixel, 2, i])
            along = sine * cosine_of_turns(tile[pixel, 2, i] - 0.25)
            up = math.sqrt(1.0 - tile[pixel, 3, i])
            # On the floor: the sphere's centre from there, the ray's closest approach to it, and whether that is near.
            y = (v + _AIM) / _SINE - cy
            towards = up * height - across * u - along * y
            outside = max(0.0, fma(u, u, y * y) + (height - radius) * (height + radius))
            escapes_sphere = (towards <= 0.0) | (towards * towards <= outside)
            # On the sphere: the normal's vertical component, and the direction's.
            right, above = u * per_radius, (v - sphere_v) * per_radius
            squared = fma(right, right, above * above)
            normal = above * _COSINE + math.sqrt(max(0.0, 1.0 - squared)) * _SINE
            rises = along * math.sqrt(max(0.0, 1.0 - normal * normal)) + up * normal >= 0.0
            escapes = rises if squared < 1.0 else escapes_sphere
            values[i] = 1.0 if escapes else 0.0
        out[pixel] = lane_sum(values, count)


class AmbientOcclusion(Scene):
    """The share of rays, weighted by the cosine, that escape from a floor and a sphere.

    Parameters
    ----------
    radius
        Radius of the sphere. 0: there is no sphere, and the image is 1.
    height
        Height of the sphere's centre, at least the radius. Equal: the sphere touches the floor.
    cx, cy
        The place on the floor below the centre; the picture shows -2.5 to 2.5 across.

    Raises
    ------
    UsageError
        The sphere would go through the floor.
    """

    reference_error = 1e-8
    value_range = (0.0, 1.0)

    def __init__(self, radius: float = 0.9, height: float = 1.0, cx: float = 0.0, cy: float = 0.0) -> None:
        if height < radius:
            raise UsageError(f"radius={radius:g}, height={height:g}: the sphere would go through the floor")
        self.radius, self.height, self.cx, self.cy = float(radius), float(height), float(cx), float(cy)

    def dimensions(self) -> dict[str, int]:
        """Return the dimensions of pixel and direction; without a sphere those of the pixel alone."""
        return {"pixel": 2, "direction": 2} if self.radius > 0.0 else {"pixel": 2}

    def sums(self, tile: Array, boxes: Array, out: Array) -> None:
        """Count the rays that escape: see :meth:`Scene.sums`."""
        if self.radius == 0.0:
            out[:] = tile.shape[2]
        else:
            _sums(tile, boxes, out, self.radius, self.height, self.cx, self.cy)

    def constant(self, x_edges: Array, y_edges: Array) -> Array:
        """Return 1 without a sphere, else NaN, as no pixel is constant: float64[h, w]."""
        return np.full((y_edges.size - 1, x_edges.size - 1), np.nan if self.radius > 0.0 else 1.0)

    def exact(self, x_edges: Array, y_edges: Array) -> Array:
        """Return the mean over each pixel: float64[h, w], within ``reference_error``."""
        from samplekit.quadrature import Curves, kept_means

        outline = [0.5 + self.cx / _VIEW, 0.5 - self._centre_v() / _VIEW, self.radius / _VIEW]
        return kept_means(
            f"{self.radius!r} {self.height!r} {self.cx!r} {self.cy!r}",
            (__file__,),
            lambda points: self._escaping(points[0], points[1]),
            x_edges,
            y_edges,
            known=self.constant(x_edges, y_edges),
            curves=Curves(np.array([outline])),
            largest=1.0 / 32.0,
            tolerance=1e-9,
        )

    def exact_at(self, x: Array, y: Array) -> Array:
        """Return the closed form at the points x float64[w] by y float64[h]: float64[h, w]."""
        return self._escaping(*np.broadcast_arrays(x[None], y[:, None]))

    def _centre_v(self) -> float:
        """Return how far above the middle of the picture the sphere's centre is seen."""
        return self.cy * _SINE + self.height * _COSINE - _AIM

    def _escaping(self, x: Array, y: Array) -> Array:
        """Return the share of rays that escape from the points (x, y) of the picture."""
        if self.radius == 0.0:
            return np.ones(x.shape)
        u, v = (x - 0.5) * _VIEW - self.cx, (0.5 - y) * _VIEW
        floor_y = (v + _AIM) / _SINE - self.cy
        squared = u * u + floor_y * floor_y + self.height**2
        floor = 1.0 - self.radius**2 * self.height / (squared * np.sqrt(squared))
        right = u / self.radius
        above = (v - self._centre_v()) / self.radius
        inside = right * right + above * above
        normal = above * _COSINE + np.sqrt(np.maximum(0.0, 1.0 - inside)) * _SINE
        return np.where(inside < 1.0, 0.5 + 0.5 * normal, floor)
