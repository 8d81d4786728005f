"""Which methods no other beats in both time and quality."""

from __future__ import annotations

import math
from collections.abc import Sequence


def pareto_front(times: Sequence[float], figures: Sequence[float], higher_is_better: bool) -> list[int]:
    """Indices, by rising time, of the points that no other beats: none takes at most their time and is better, or
    takes less time and is as good. Points with NaN take no part."""
    sign = 1.0 if higher_is_better else -1.0
    points = [
        (time, -sign * figure, index)
        for index, (time, figure) in enumerate(zip(times, figures, strict=True))
        if not (math.isnan(time) or math.isnan(figure))
    ]
    front: list[int] = []
    best = math.inf
    for _, loss, index in sorted(points):
        if loss < best:
            front.append(index)
            best = loss
    return front
