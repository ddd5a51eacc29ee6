"""A power law fitted to shares: binomial counts of pairs at several scales."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ._arguments import Array

Interval = tuple[float, float]

_HALF_OF_CHI_SQUARED = 1.920729410347062  # 95 % of chi squared with one degree of freedom, halved
_NORMAL = 1.959963984540054  # 97.5 % of the normal distribution
_RARE = 2.3263478740408408  # 99 % of it
_STEEPEST = 50.0  # an exponent beyond is unbounded by the pairs


def _root(falling: Callable[[float], float], low: float, high: float) -> float:
    """Where a falling function is 0, or the end beyond which it would be."""
    for _ in range(50):
        middle = 0.5 * (low + high)
        if falling(middle) > 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _log_likelihood(x: Array, pairs: Array, different: Array, slope: float) -> tuple[float, float, float]:
    """Of share = exp(intercept + slope x): largest over the intercept, its derivative by the slope, that intercept.

    It is concave in both, and an intercept is at most what gives a share of 1."""
    top = -np.max(slope * x)

    def by_share(intercept: float) -> Array:
        share = np.exp(np.minimum(intercept + slope * x, -1e-12))
        return (different - pairs * share) / (1.0 - share)

    intercept = _root(lambda value: by_share(value).sum(), top - 50.0, top)
    logarithm = np.minimum(intercept + slope * x, -1e-12)
    likelihood = float((different * logarithm + (pairs - different) * np.log(-np.expm1(logarithm))).sum())
    return likelihood, float((by_share(intercept) * x).sum()), intercept


def fitted(scale: Array, pairs: npt.NDArray[np.int64], different: npt.NDArray[np.int64]) -> tuple[float, Interval, float, float]:
    """Exponent, its interval, coefficient and deviance: the most likely power of independent binomial counts.

    Shares that scatter more than such counts make the interval wider (McCullagh and Nelder, Generalized Linear Models, 1989,
    section 4.5)."""
    nan = float("nan")
    if not different.any():
        return nan, (nan, nan), nan, nan
    middle = float(np.log(scale).mean())
    x, n, k = np.log(scale) - middle, pairs.astype(float), different.astype(float)
    slope = _root(lambda value: _log_likelihood(x, n, k, value)[1], -_STEEPEST, _STEEPEST)
    best, _, intercept = _log_likelihood(x, n, k, slope)

    share = np.divide(k, n, out=np.zeros_like(k), where=n > 0)
    logarithms = [np.log(values, out=np.zeros_like(k), where=values > 0.0) for values in (share, 1.0 - share)]
    deviance = 2.0 * (float((k * logarithms[0] + (n - k) * logarithms[1]).sum()) - best)
    fall = _HALF_OF_CHI_SQUARED * max(1.0, deviance / max(1, n.size - 2))

    def beyond(value: float) -> float:
        return fall - (best - _log_likelihood(x, n, k, value)[0])

    high = _root(beyond, slope, _STEEPEST)
    low = -_root(lambda value: beyond(-value), -slope, _STEEPEST)
    bounded = tuple(end if abs(end) < 0.999 * _STEEPEST else float(np.copysign(np.inf, end)) for end in (low, high))
    return slope, (bounded[0], bounded[1]), float(np.exp(intercept - slope * middle)), deviance


def neighbouring(scale: Array, pairs: npt.NDArray[np.int64], different: npt.NDArray[np.int64]) -> tuple[Array, Array, Array]:
    """Exponents from each scale to the next: of the ratio of two shares, whose logarithm has the variance of Katz et al."""
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(different > 0, different / pairs, np.nan)
        variance = (1.0 - share) / different
    step = np.diff(np.log(scale))
    local = np.diff(np.log(share)) / step
    half = _NORMAL * np.sqrt(variance[1:] + variance[:-1]) / step
    return local, local - half, local + half


def one_power(deviance: float, scales: int) -> bool:
    """Whether a deviance is below the quantile of 99 % of chi squared, by Wilson and Hilferty; also if there is none."""
    spare = scales - 2
    if spare == 0 or np.isnan(deviance):
        return True
    third = 2.0 / (9.0 * spare)
    return deviance < spare * (1.0 - third + _RARE * np.sqrt(third)) ** 3
