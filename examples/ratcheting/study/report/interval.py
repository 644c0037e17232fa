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


def ratio(above, below, share=0.95):
    """Ratio of the geometric means of two sets of positive numbers, low and high end of its interval: Welch's test
    on the logarithms."""
    a, b = Estimate([math.log(v) for v in above]), Estimate([math.log(v) for v in below])
    if a.n < 2 or b.n < 2:
        return (math.exp(a.mean - b.mean) if a.n and b.n else math.nan), math.nan, math.nan
    centre, first, second = a.mean - b.mean, a.error ** 2, b.error ** 2
    if not first + second > 0:
        return math.exp(centre), math.nan, math.nan
    freedom = (first + second) ** 2 / (first ** 2 / a.freedom + second ** 2 / b.freedom)
    half = student(freedom, share) * math.sqrt(first + second)
    return math.exp(centre), math.exp(centre - half), math.exp(centre + half)


def _welch(difference, parts):
    """The probability of a difference of this size or more by chance, by Welch's test. `parts`: the variances of its terms and their
    degrees of freedom."""
    variance = sum(v for v, _ in parts)
    if difference == 0 or not variance > 0:
        return float(difference == 0)
    freedom = variance ** 2 / sum(v * v / n for v, n in parts)
    x = freedom / (freedom + difference ** 2 / variance)
    return _beta_share(freedom / 2, 0.5, x) if x < 1 else 1.0


def means_differ(above, below, share=0.95):
    """Whether the means of two sets differ by Welch's test."""
    a, b = Estimate(above), Estimate(below)
    return _welch(a.mean - b.mean, [(e.error ** 2, e.freedom) for e in (a, b)]) < 1 - share


def ratio_of_means(above, below, share=0.95):
    """Ratio of the means of two sets, of which that above may be near zero: ratio_of_sums() of one set each."""
    return ratio_of_sums([above], [below], share)


def ratio_of_sums(above, below, share=0.95):
    """Ratio of the sums of the means of several sets each, low and high end of Fieller's interval: from the smallest to the largest R for
    which Welch's test of the difference (sum above - R sum below) does not reject. It needs no logarithm, so a mean above may be near zero.
    Without an interval, if the sum below is not distinguished from zero."""
    a, b = [Estimate(v) for v in above], [Estimate(v) for v in below]
    if min(e.n for e in a + b) < 2:
        return (a[0].mean / b[0].mean if len(a) == 1 and a[0].n and b[0].n else math.nan), math.nan, math.nan
    top, base = (sum(e.mean for e in side) for side in (a, b))

    def rejects(r):
        return _welch(top - r * base, [(e.error ** 2, e.freedom) for e in a] + [(r * r * e.error ** 2, e.freedom) for e in b if r]) < 1 - share
    if not _welch(base, [(e.error ** 2, e.freedom) for e in b]) < 1 - share:
        return (top / base if base else math.nan), math.nan, math.nan
    scale = (max(abs(top), math.sqrt(sum(e.error ** 2 for e in a))) or 1.0) / abs(base)
    centre = math.atan(top / base / scale)

    def end(limit, steps=60):
        """The last R towards ±∞, which is the angle `limit`, that is not rejected."""
        angles = [centre + (limit - centre) * k / steps for k in range(steps)]
        last = max(k for k, u in enumerate(angles) if k == 0 or not rejects(scale * math.tan(u)))
        low, high = angles[last], (angles + [limit * (1 - 1e-9)])[last + 1]
        for _ in range(40):
            middle = (low + high) / 2
            low, high = (low, middle) if rejects(scale * math.tan(middle)) else (middle, high)
        return scale * math.tan(low)
    return top / base, end(-math.pi / 2), end(math.pi / 2)


def ratio_of_pairs(pairs, share=0.95):
    """Ratio of the means of the first and of the second numbers of pairs, low and high end of Fieller's interval: the R for which Student's
    test of the mean of first - R second does not reject. Without an interval, if the second mean is not distinguished from zero."""
    a, b = (Estimate([pair[k] for pair in pairs]) for k in (0, 1))
    if a.n < 2:
        return (a.mean / b.mean if a.n and b.mean else math.nan), math.nan, math.nan
    t = student(a.freedom, share)
    common = sum((x - a.mean) * (y - b.mean) for x, y in pairs) / (a.n - 1) / a.n
    square, half, constant = b.mean ** 2 - (t * b.error) ** 2, a.mean * b.mean - t * t * common, a.mean ** 2 - (t * a.error) ** 2
    if not square > 0:
        return (a.mean / b.mean if b.mean else math.nan), math.nan, math.nan
    root = math.sqrt(max(half * half - square * constant, 0))
    return a.mean / b.mean, (half - root) / square, (half + root) / square
