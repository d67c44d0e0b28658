"""Series of numbers in time, one a snapshot: exponential decay, damped oscillation, and how sure their constants are.

    decay         ln y = c - r t, straight line of least squares
    oscillation   y = exp(-delta t) (A cos(omega t) + B sin(omega t)) + C, least squares; A, B, C follow linearly from omega, delta

The uncertainty of a constant is its standard error from the scatter about the curve, which is made greater by
sqrt[(1 + c)/(1 - c)] where neighbouring residuals have the correlation c > 0: slow deviations are not noise that averages out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

SNAPSHOTS_A_PERIOD = 8.0    # fewer do not tell a frequency from its aliases and its decay
GREATEST_RESIDUAL = 0.3     # of the amplitude, root mean square, beyond which a note says that it is no damped oscillation


@dataclass(frozen=True)
class Sample:
    """What a snapshot adds to a series: time s, and the value."""

    time: float
    value: float


def arrays(samples: list[Sample]) -> tuple[np.ndarray, np.ndarray]:
    """Times (n) and values (n) of a series, in order."""
    return np.array([sample.time for sample in samples]), np.array([sample.value for sample in samples])


@dataclass(frozen=True)
class Line:
    """slope, its standard error, and root mean square of the residuals."""

    slope: float
    slope_error: float
    residual: float


def straight_line(time: np.ndarray, value: np.ndarray) -> Line:
    """Least squares through points (n >= 3)."""
    x = time - time.mean()
    slope = float((x * value).sum() / (x**2).sum())
    left = value - value.mean() - slope * x
    error = np.sqrt((left**2).sum() / (len(time) - 2) / (x**2).sum()) * _correlation_factor(left)
    return Line(slope, float(error), float(np.sqrt((left**2).mean())))


@dataclass(frozen=True)
class Oscillation:
    """frequency omega rad/s and decay delta 1/s with standard errors; amplitude at the first time; offset C; residual (rms)."""

    frequency: float
    decay: float
    frequency_error: float
    decay_error: float
    amplitude: float
    offset: float
    residual: float


def too_few(time: np.ndarray, period: float, periods: float = 1.0) -> str:
    """Why snapshots at these times cannot show an oscillation of about `period` (s); empty if they can."""
    if len(time) < 8:
        return f"only {len(time)} snapshots in the window; an oscillation needs 8"
    rate = period * (len(time) - 1) / (time[-1] - time[0])
    if rate < SNAPSHOTS_A_PERIOD:
        return (f"only {rate:.1f} snapshots a period of {period:.4g} s, {SNAPSHOTS_A_PERIOD:g} are needed: "
                "make time.output_interval smaller")
    if time[-1] - time[0] < 0.99 * periods * period:
        return f"the window has {(time[-1] - time[0]) / period:.2f} periods of {period:.4g} s; it needs {periods:g}"
    return ""


def damped_oscillation(time: np.ndarray, value: np.ndarray, expected_frequency: float) -> Oscillation:
    """The oscillation of least squares, sought between a third and three times `expected_frequency` (rad/s)."""
    start, span = time[0], time[-1] - time[0]
    t = (time - start) / span

    def basis(constants):
        fading = np.exp(-constants[1] * t)
        return np.stack([fading * np.cos(constants[0] * t), fading * np.sin(constants[0] * t), np.ones(len(t))], axis=1)

    def residual(constants):
        columns = basis(constants)
        return columns @ np.linalg.lstsq(columns, value, rcond=None)[0] - value

    guess = expected_frequency * span
    frequencies = np.unique(np.concatenate([np.geomspace(guess / 3.0, 3.0 * guess, 60),
                                            np.arange(guess / 3.0, 3.0 * guess, 1.0)]))
    starts = [(omega, delta) for omega in frequencies for delta in (0.0, 1.0, 4.0)]
    best = min(starts, key=lambda constants: float((residual(constants)**2).sum()))
    scale = max(float(np.abs(value - value.mean()).max()), 1e-300)
    found = least_squares(lambda constants: residual(constants) / scale, best, x_scale=(1.0, 1.0), xtol=1e-14, ftol=1e-14)
    omega, delta = found.x
    columns = basis(found.x)
    linear = np.linalg.lstsq(columns, value, rcond=None)[0]
    left = columns @ linear - value
    # all five constants together: columns of derivatives by omega and delta, then the linear ones
    wave, quarter = columns[:, 0], columns[:, 1]
    jacobian = np.column_stack([t * (linear[1] * wave - linear[0] * quarter), -t * (linear[0] * wave + linear[1] * quarter), columns])
    variance = (left**2).sum() / max(len(t) - 5, 1) * _correlation_factor(left)**2
    errors = np.sqrt(np.abs(np.diag(np.linalg.pinv(jacobian.T @ jacobian)))[:2] * variance)
    return Oscillation(abs(omega) / span, delta / span, errors[0] / span, errors[1] / span,
                       float(np.hypot(linear[0], linear[1])), float(linear[2]), float(np.sqrt((left**2).mean())))


def _correlation_factor(residual: np.ndarray) -> float:
    """sqrt[(1 + c)/(1 - c)], c the correlation of neighbouring residuals where it is above 0 (at most 0.99)."""
    power = float((residual**2).sum())
    if power <= 0.0:
        return 1.0
    c = np.clip((residual[1:] * residual[:-1]).sum() / power, 0.0, 0.99)
    return float(np.sqrt((1.0 + c) / (1.0 - c)))
