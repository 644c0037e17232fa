# SPDX-License-Identifier: MIT
"""Means, ratios and their 95 % intervals, as text: value [low, high]."""
import functools
import math


def finite(values):
    return [v for v in values if v is not None and math.isfinite(v)]


def _beta_share(a, b, x):
    """Incomplete beta function I_x(a, b), by its continued fraction (Lentz)."""
    if x > (a + 1) / (a + b + 2):
        return 1 - _beta_share(b, a, 1 - x)
    c, d = 1.0, 1 / (1 - (a + b) * x / (a + 1))
    value = d
    for m in range(1, 500):
        for term in (m * (b - m) * x / ((a - 1 + 2 * m) * (a + 2 * m)),
                     -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 1 + 2 * m))):
            d, c = 1 / (1 + term * d), 1 + term / c
            value *= c * d
        if abs(c * d - 1) < 1e-13:
            break
    front = a * math.log(x) + b * math.log(1 - x) + math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)
    return math.exp(front) * value / a


@functools.lru_cache(maxsize=None)
def student(freedom, share=0.95):
    """The t that Student's distribution exceeds in size with the probability 1 - share; the degrees of freedom need
    not be a whole number."""
    if not freedom > 0:
        return math.nan
    low, high = 0.0, 1e6
    for _ in range(100):
        t = (low + high) / 2
        low, high = (t, high) if 1 - _beta_share(freedom / 2, 0.5, freedom / (freedom + t * t)) < share else (low, t)
    return low


def number(value, half=math.nan, digits=2):
    """value [value - half, value + half]: half the interval to two digits, the value to as many places."""
    if not math.isfinite(half) or half == 0:
        return interval(value, math.nan, math.nan, digits)
    return interval(value, value - half, value + half)


def interval(value, low, high, digits=2):
    """value [low, high]: half the interval to two digits, the others to as many places. Without an interval the
    value to digits + 1 places."""
    if not math.isfinite(value):
        return "–"
    half = (high - low) / 2
    if not math.isfinite(half) or half <= 1e-9 * abs(value):
        return f"{value:.{digits + 1}g}".replace("-", "−")
    places = max(1 - math.floor(math.log10(half)), 0)
    value, low, high = (round(v, places) + 0.0 for v in (value, low, high))  # no negative zero
    return f"{value:.{places}f} [{low:.{places}f}, {high:.{places}f}]".replace("-", "−")


class Estimate:
    """Mean over samples with its standard error and Student's interval of 95 %. `freedom` are the degrees of freedom
    of the error."""

    def __init__(self, values):
        values = finite(values)
        self.values, self.n = values, len(values)
        self.mean = sum(values) / self.n if values else math.nan
        variance = sum((v - self.mean) ** 2 for v in values) / (self.n - 1) if self.n > 1 else 0
        self.error = math.sqrt(variance / self.n) if self.n > 1 else math.nan
        self.freedom = self.n - 1

    @property
    def half(self):
        """Half the interval."""
        return student(self.freedom) * self.error

    def text(self, digits=2, factor=1.0):
        return number(factor * self.mean, abs(factor) * self.half, digits)


def _ratio(log_ratio, first, second, first_n, second_n, share=0.95):
    """The interval of a ratio from the variances of its logarithm's two parts, by Welch's degrees of freedom."""
    variance = first + second
    if not variance > 0:
        return math.exp(log_ratio), math.nan, math.nan
    freedom = variance ** 2 / (first ** 2 / (first_n - 1) + second ** 2 / (second_n - 1))
    half = student(freedom, share) * math.sqrt(variance)
    return math.exp(log_ratio), math.exp(log_ratio - half), math.exp(log_ratio + half)


def ratio(above, below, share=0.95):
    """Ratio of the geometric means of two sets of positive numbers, low and high end of its interval: Welch's test
    on the logarithms."""
    a, b = Estimate([math.log(v) for v in above]), Estimate([math.log(v) for v in below])
    if a.n < 2 or b.n < 2:
        return (math.exp(a.mean - b.mean) if a.n and b.n else math.nan), math.nan, math.nan
    return _ratio(a.mean - b.mean, a.error ** 2, b.error ** 2, a.n, b.n, share)


def ratio_of_means(above, below, share=0.95):
    """Ratio of the means, of which single values may be negative: the errors relative to the means propagated."""
    a, b = Estimate(above), Estimate(below)
    if a.n < 2 or b.n < 2 or not a.mean / b.mean > 0:
        return (a.mean / b.mean if a.n and b.n else math.nan), math.nan, math.nan
    return _ratio(math.log(a.mean / b.mean), (a.error / a.mean) ** 2, (b.error / b.mean) ** 2, a.n, b.n, share)
