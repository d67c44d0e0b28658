"""A function of time from its Laplace transform: Fourier series with Euler summation (Abate and Whitt 1995, ORSA J. Comput. 7, 36).

    f(t) = exp(A/2)/t {Re F(A/2t)/2 + sum_k (-1)^k Re F[(A + 2 k pi i)/2t]},   discretisation error exp(-A) of the greatest f
"""

from __future__ import annotations

from collections.abc import Callable
from math import comb

import numpy as np

ACCURACY = 18.4     # A: exp(-18.4) = 1e-8
EULER_TERMS = 12


def inverted(transform: Callable[[np.ndarray], np.ndarray], time: float, fastest: float) -> float:
    """The function at `time` (s, above 0) whose transform takes complex s (n), 1/s; `fastest` (rad/s): its highest frequency."""
    count = int(30 + 2.0 * fastest * time / np.pi)
    steps = np.arange(count + EULER_TERMS + 1)
    terms = transform((ACCURACY + 2j * np.pi * steps) / (2.0 * time)).real * np.where(steps % 2, -1.0, 1.0)
    terms[0] *= 0.5
    sums = np.cumsum(terms)[count:]
    weights = np.array([comb(EULER_TERMS, j) for j in range(EULER_TERMS + 1)]) / 2.0**EULER_TERMS
    return float(np.exp(ACCURACY / 2.0) / time * (weights @ sums))
