from __future__ import annotations

import math

import numpy as np
import pytest

from planformer.bench.statistics import (
    bootstrap_interval,
    percentile_90,
    ratio_of_medians,
    share_interval,
)


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    [  # Newcombe, Statistics in Medicine 17, 1998, table I, method 3
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ],
)
def test_wilson_interval_is_that_of_the_literature(successes, trials, low, high):
    interval = share_interval(successes, trials)
    assert interval.value == successes / trials
    assert interval.low == pytest.approx(low, abs=5e-5)
    assert interval.high == pytest.approx(high, abs=5e-5)
    mirrored = share_interval(trials - successes, trials)
    assert (mirrored.low, mirrored.high) == pytest.approx((1 - interval.high, 1 - interval.low))


def test_bootstrap_interval_covers_the_median_of_the_distribution():
    covered = 0
    for seed in range(300):
        values = np.random.default_rng(seed).lognormal(size=60)
        interval = bootstrap_interval(np.median, values)
        assert interval.low <= interval.value <= interval.high
        covered += interval.low <= 1.0 <= interval.high
    # 95 % of 300 within four standard deviations of the binomial distribution.
    assert 270 <= covered <= 300


def test_bootstrap_interval_shrinks_with_the_root_of_the_sample():
    values = np.random.default_rng(0).normal(size=6400)
    few, many = (bootstrap_interval(np.mean, values[:count]) for count in (400, 6400))
    assert (few.high - few.low) / (many.high - many.low) == pytest.approx(4.0, rel=0.15)
    assert many.high - many.low == pytest.approx(2 * 1.96 / 80, rel=0.15)


def test_columns_are_drawn_together():
    values = np.random.default_rng(0).lognormal(size=31)
    interval = bootstrap_interval(ratio_of_medians, 3.0 * values, values)
    assert (interval.low, interval.value, interval.high) == pytest.approx((3.0, 3.0, 3.0))


def test_infinite_values_stay_in_the_statistics():
    values = np.array([1.0, 2.0, 3.0, 4.0, math.inf])
    assert bootstrap_interval(np.median, values).value == 3.0
    assert bootstrap_interval(np.median, values).high == math.inf
    assert bootstrap_interval(percentile_90, values).value == math.inf
    assert bootstrap_interval(np.median, np.full(4, math.inf)).low == math.inf
