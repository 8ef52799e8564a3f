# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""Intervals that keep a verdict from resting on one event: exact Poisson limits of a count, exact binomial limits of a share,
and the bootstrap over paths or over blocks of frames. Seeded, so that the same data give the same interval."""

import math
from statistics import NormalDist

import numpy as np

LEVEL = 0.95
LEAST_EVENTS = 10  # fewer have no rate (src/lmdbench/metrics/errors.h)
RESAMPLES = 1000


def poisson_tail(count, mean):
    """P(X >= count) of a Poisson variable with this mean."""
    if count <= 0:
        return 1.0
    if mean <= 0.0:
        return 0.0
    terms = [math.exp(k * math.log(mean) - mean - math.lgamma(k + 1)) for k in range(int(count))]
    return max(0.0, 1.0 - math.fsum(terms))


def bisect(function, low, high, wanted):
    """Where an increasing function has the wanted value."""
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < wanted else (low, middle)
    return 0.5 * (low + high)


MANY = 1000  # from this count on an approximation to 1e-6 is faster


def poisson_interval(count, level=LEVEL):
    """(low, high) of the mean behind a count (Garwood 1936; Wilson and Hilferty's approximation for many)."""
    if not math.isfinite(count):
        return math.nan, math.nan
    tail = 0.5 * (1.0 - level)
    if count > MANY:
        z = NormalDist().inv_cdf(1.0 - tail)
        return tuple(n * (1.0 - 1.0 / (9.0 * n) + sign * z / (3.0 * math.sqrt(n))) ** 3 for n, sign in ((count, -1.0), (count + 1.0, 1.0)))
    highest = count + 10.0 * math.sqrt(count + 1.0) + 20.0
    low = 0.0 if count <= 0 else bisect(lambda mean: poisson_tail(count, mean), 0.0, highest, tail)
    high = bisect(lambda mean: poisson_tail(count + 1, mean), 0.0, highest, 1.0 - tail)
    return low, high


def binomial_tail(count, total, chance):
    """P(X >= count) among `total` trials of this chance, in (0, 1)."""
    logarithms = [math.lgamma(total + 1) - math.lgamma(k + 1) - math.lgamma(total - k + 1) + k * math.log(chance)
                  + (total - k) * math.log1p(-chance) for k in range(count, total + 1)]
    return math.fsum(math.exp(value) for value in logarithms)


def share_interval(count, total, level=LEVEL):
    """(low, high) of the chance behind `count` of `total` (Clopper and Pearson 1934)."""
    tail = 0.5 * (1.0 - level)
    low = 0.0 if count == 0 else bisect(lambda chance: binomial_tail(count, total, chance), 0.0, 1.0, tail)
    high = 1.0 if count == total else bisect(lambda chance: binomial_tail(count + 1, total, chance), 0.0, 1.0, 1.0 - tail)
    return low, high


def bootstrap(samples, statistic, level=LEVEL, seed=1):
    """(low, high) of statistic(list of samples) over resampled lists."""
    samples = list(samples)
    if len(samples) < 2:
        return math.nan, math.nan
    random = np.random.default_rng(seed)
    values = [statistic([samples[i] for i in random.integers(0, len(samples), len(samples))]) for _ in range(RESAMPLES)]
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return math.nan, math.nan
    return tuple(float(value) for value in np.quantile(values, (0.5 * (1.0 - level), 0.5 * (1.0 + level))))


class Rate:
    """Events per second, from counts and times of one or more paths. Events of one path come in bursts, so where there
    are paths enough the wider of the Poisson interval and the bootstrap over paths counts. `value` is NaN below LEAST_EVENTS:
    then the count and the interval are all that is known."""

    def __init__(self, counts, seconds):
        self.count = float(np.sum(counts))
        self.seconds = float(np.sum(seconds))
        self.value = self.count / self.seconds if self.seconds > 0 and self.count >= LEAST_EVENTS else math.nan
        low, high = (limit / self.seconds for limit in poisson_interval(self.count)) if self.seconds > 0 else (math.nan, math.nan)
        if len(counts) >= 5:
            def of_all(rows):
                time = sum(s for _, s in rows)
                return sum(c for c, _ in rows) / time if time > 0 else math.nan

            spread = bootstrap(list(zip(counts, seconds)), of_all)
            low, high = min(low, spread[0]), max(high, spread[1])
        self.low, self.high = low, high

    def __str__(self):
        """"212 [200, 225]" a second, or "2 in 0.598 s [0.405, 12.1]", and "-" for what was not counted."""
        if not (math.isfinite(self.count) and self.seconds > 0):
            return "-"
        shown = f"{self.value:.3g}" if math.isfinite(self.value) else f"{self.count:.0f} in {self.seconds:.3g} s"
        return f"{shown} [{self.low:.3g}, {self.high:.3g}]"
