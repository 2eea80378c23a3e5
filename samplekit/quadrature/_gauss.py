"""Gauss and Legendre's rule of 24 nodes: exact for polynomials of degree 47 (NIST DLMF 3.5.v).

Nodes and weights from mpmath at 60 digits, rounded: those that NumPy computes are up to 1e-13 away.
"""

from __future__ import annotations

import numpy as np

NODES = np.array(
    [
        0.9951872199970213,
        0.9747285559713095,
        0.9382745520027328,
        0.8864155270044011,
        0.820001985973903,
        0.7401241915785544,
        0.6480936519369755,
        0.5454214713888396,
        0.4337935076260451,
        0.3150426796961634,
        0.1911188674736163,
        0.06405689286260563,
    ]
)
"""The positive nodes on [-1, 1], from the end inwards: float64[12]. The others are their mirror images."""

WEIGHTS = np.array(
    [
        0.0123412297999872,
        0.028531388628933663,
        0.04427743881741981,
        0.05929858491543678,
        0.0733464814110803,
        0.08619016153195327,
        0.09761865210411388,
        0.10744427011596563,
        0.1155056680537256,
        0.12167047292780339,
        0.1258374563468283,
        0.12793819534675216,
    ]
)
"""The weight of each node and its mirror image in the mean over [-1, 1]: float64[12].

Added in this order, the smallest first, they give exactly 1, so that the mean of a constant is that constant.
"""
