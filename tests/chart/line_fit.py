"""Straight lines through measured points."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class LineFit:
    """y = fixed + slope x, by least squares."""

    fixed: float
    slope: float
    rms: float  # of what the line leaves, over all points

    @property
    def fixed_share(self) -> float:
        """Of the value at x = 1."""
        return self.fixed / (self.fixed + self.slope)


def fit_line(x: Sequence[float], y: Sequence[float]) -> LineFit:
    """Raises ValueError for less than two different x."""
    count = len(x)
    if count != len(y) or len(set(x)) < 2:
        raise ValueError("a line needs two different x, and a y for each")
    mean_x = math.fsum(x) / count
    mean_y = math.fsum(y) / count
    across = math.fsum((a - mean_x) ** 2 for a in x)
    slope = math.fsum((a - mean_x) * (b - mean_y) for a, b in zip(x, y, strict=True)) / across
    fixed = mean_y - slope * mean_x
    left = math.fsum((b - fixed - slope * a) ** 2 for a, b in zip(x, y, strict=True))
    return LineFit(fixed, slope, math.sqrt(left / count))
