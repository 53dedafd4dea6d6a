"""Intervals of what is measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_CONFIDENCE = 0.95
_NORMAL_QUANTILE = 1.959963984540054
"""Of the standard normal distribution at 97.5 %."""
_RESAMPLES = 1000


@dataclass(frozen=True)
class Interval:
    """A statistic with its 95 % confidence interval.

    Attributes:
        value: The statistic of the sample.
        low: Lower end of the interval.
        high: Upper end.
    """

    value: float
    low: float
    high: float


def share_interval(successes: int, trials: int) -> Interval:
    """A share with its Wilson score interval.

    Wilson, Probable Inference, the Law of Succession, and Statistical Inference, Journal of the
    American Statistical Association 22, 1927. Unlike a bootstrap it has a width where all or none
    of the trials succeeded.

    Args:
        successes: Number of successes, 0 to `trials`.
        trials: Number of trials, >= 1.
    """
    z2 = _NORMAL_QUANTILE**2
    share = successes / trials
    centre = (share + z2 / (2 * trials)) / (1 + z2 / trials)
    spread = math.sqrt(share * (1 - share) / trials + z2 / (4 * trials**2))
    half = _NORMAL_QUANTILE / (1 + z2 / trials) * spread
    # At the ends of the scale the formula is exact but for rounding.
    low = 0.0 if successes == 0 else centre - half
    high = 1.0 if successes == trials else centre + half
    return Interval(share, low, high)


def bootstrap_interval(statistic: Callable[..., Any], *columns: ArrayLike) -> Interval:
    """A statistic with its percentile bootstrap interval.

    Efron, Bootstrap Methods: Another Look at the Jackknife, Annals of Statistics 7, 1979.
    Infinite values are allowed where the statistic copes with them, as the median does.

    Args:
        statistic: Function of one array a column that reduces `axis`, such as `np.median`.
        columns: (N,) values, N >= 1; columns of one length are drawn together.
    """
    arrays = [np.asarray(column, dtype=np.float64) for column in columns]
    count = len(arrays[0])
    # A fixed seed: the same measurements always give the same interval.
    drawn = np.random.default_rng(0).integers(count, size=(_RESAMPLES, count))
    resampled = np.asarray(statistic(*(array[drawn] for array in arrays), axis=1))
    tail = (1 - _CONFIDENCE) / 2
    low, high = np.sort(resampled)[_ranks(tail)]
    return Interval(float(statistic(*arrays, axis=0)), float(low), float(high))


def _ranks(tail: float) -> list[int]:
    """The resamples at which the interval ends; interpolating between infinities gives NaN."""
    return [round(tail * (_RESAMPLES - 1)), round((1 - tail) * (_RESAMPLES - 1))]


def ratio_of_medians(
    numerator: NDArray[np.float64], denominator: NDArray[np.float64], axis: int
) -> Any:
    """Median over median, a statistic for `bootstrap_interval`; infinite over a median of zero."""
    with np.errstate(divide="ignore"):
        return np.median(numerator, axis=axis) / np.median(denominator, axis=axis)


def percentile_90(values: NDArray[np.float64], axis: int) -> Any:
    """90th percentile that is one of the values, so that infinite ones do no harm."""
    return np.quantile(values, 0.9, axis=axis, method="inverted_cdf")


def percent_of(holds: Sequence[bool] | NDArray[np.bool_]) -> dict[str, float | None]:
    """A share in percent with its interval, as JSON has it.

    Args:
        holds: For each trial whether it counts; at least one.
    """
    interval = share_interval(int(np.sum(holds)), len(holds))
    percent = {name: 100.0 * value for name, value in asdict(interval).items()}
    return _json(Interval(**percent))


def median_of(values: NDArray[np.float64]) -> dict[str, float | None]:
    """The median with its interval, as JSON has it."""
    return interval_of(np.median, values)


def interval_of(
    statistic: Callable[..., Any], *columns: NDArray[np.float64]
) -> dict[str, float | None]:
    """A statistic with its bootstrap interval, as JSON has it: what is not finite is null.

    Args:
        statistic: As in `bootstrap_interval`.
        columns: As there, but may be empty: then all is null.
    """
    if len(columns[0]) == 0:
        return _json(Interval(math.nan, math.nan, math.nan))
    return _json(bootstrap_interval(statistic, *columns))


def _json(interval: Interval) -> dict[str, float | None]:
    values = asdict(interval).items()
    return {name: value if math.isfinite(value) else None for name, value in values}
