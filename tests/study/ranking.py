"""Which masks differ: the multiple comparison of figure 8, right."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import NormalDist, fmean, stdev

NORMAL = NormalDist()
STEPS = 200  # of the integral, which converges like all of smooth functions that vanish at both ends
REACH = 8.0


def range_probability(q: float, count: int) -> float:
    """Probability that the range of `count` standard normal numbers is at most q, the studentised range with infinitely
    many degrees of freedom: count * integral of phi(z) (Phi(z) - Phi(z - q))^(count - 1) dz (Tukey 1953)."""
    step = 2.0 * REACH / STEPS
    total = 0.0
    for i in range(STEPS + 1):
        z = -REACH + i * step
        weight = 1 if i in (0, STEPS) else 4 if i % 2 else 2
        total += weight * NORMAL.pdf(z) * (NORMAL.cdf(z) - NORMAL.cdf(z - q)) ** (count - 1)
    return count * total * step / 3.0


def range_quantile(probability: float, count: int) -> float:
    """The q for which range_probability() is this."""
    low, high = 0.0, 2.0 * REACH
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if range_probability(middle, count) < probability else (low, middle)
    return 0.5 * (low + high)


def ranks(values: list[float]) -> list[float]:
    """From 1 for the smallest; equal values share the mean of their ranks."""
    ordered = sorted(values)
    return [ordered.index(value) + 0.5 * (ordered.count(value) + 1) for value in values]


@dataclass(frozen=True)
class Pair:
    left: str  # fewer detections
    right: str
    probability: float  # that an average observer finds the right one worse
    worse: int  # observers who noticed the right one more often
    difference: float  # of mean ranks
    p_value: float
    significant: bool


@dataclass(frozen=True)
class Ranking:
    order: list[str]  # from the fewest detections to the most
    observers: list[str]  # those with a rate for every mask
    critical_difference: float  # of mean ranks
    pairs: list[Pair]


def probability_worse(differences: list[float]) -> float:
    """That an observer's difference is above 0, for normally distributed differences: Phi(mean / standard deviation), as
    in Thurstone's law of comparative judgment (1927). Equal differences leave no doubt, or, if they are 0, all of it."""
    mean = fmean(differences)
    spread = stdev(differences) if len(differences) > 1 else 0.0
    if spread > 1e-12:
        return NORMAL.cdf(mean / spread)
    return 0.5 if abs(mean) < 1e-12 else 1.0 if mean > 0.0 else 0.0


def rank_masks(rates: dict[str, dict[str, float]], alpha: float = 0.05) -> Ranking | None:
    """Compares all masks pairwise over the observers who have a rate for each; None for fewer than two of either.

    Observers' rates become ranks; two masks differ when their mean ranks lie at least q_alpha sqrt(k (k + 1) / (6 n))
    apart, k masks and n observers, q_alpha being the studentised range over sqrt 2: Nemenyi's test (1963; Demsar,
    Statistical comparisons of classifiers over multiple data sets, JMLR 7, 2006, equation for CD), which holds the
    probability of any false difference at alpha. It is the score-difference test for rankings.
    """
    observers = sorted(set.intersection(*(set(by) for by in rates.values()))) if rates else []
    masks = sorted(rates, key=lambda mask: fmean(rates[mask].values()))
    if len(masks) < 2 or len(observers) < 2:
        return None
    masks.sort(key=lambda mask: fmean(rates[mask][observer] for observer in observers))
    by_observer = [ranks([rates[mask][observer] for mask in masks]) for observer in observers]
    mean_rank = {mask: fmean(row[i] for row in by_observer) for i, mask in enumerate(masks)}
    unit = math.sqrt(len(masks) * (len(masks) + 1) / (6.0 * len(observers)))  # standard deviation of a difference
    critical = range_quantile(1.0 - alpha, len(masks)) / math.sqrt(2.0) * unit
    pairs = []
    for i, left in enumerate(masks):
        for right in masks[i + 1 :]:
            differences = [rates[right][observer] - rates[left][observer] for observer in observers]
            apart = mean_rank[right] - mean_rank[left]
            pairs.append(
                Pair(
                    left,
                    right,
                    probability_worse(differences),
                    sum(difference > 0.0 for difference in differences),
                    apart,
                    1.0 - range_probability(abs(apart) / unit * math.sqrt(2.0), len(masks)),
                    abs(apart) >= critical,
                )
            )
    return Ranking(masks, observers, critical, pairs)
