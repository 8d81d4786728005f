"""Places names beside the points of a chart so that none lies on another or on a point."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Text
from matplotlib.transforms import Bbox

# Where a label may lie, from its point: first near, then farther, on the right before other sides.
_DISTANCES_PT = (7.0, 14.0, 22.0, 32.0, 44.0, 58.0, 74.0, 92.0, 112.0, 134.0, 158.0, 184.0)
_ANGLES_DEG = (0, 30, -30, 180, 150, -150, 60, -60, 90, -90, 120, -120, 45, -45, 135, -135, 15, -15, 165, -165)
_LEADER_FROM_PT = 10.0  # farther labels get a line to their point
_POINT_RADIUS_PT = 4.0
_BAR_RADIUS_PT = 1.0
_BACKGROUND = {"facecolor": "white", "edgecolor": "none", "alpha": 0.7, "pad": 0.3}


@dataclass(frozen=True)
class Label:
    x: float
    y: float
    text: str
    color: str
    x_error: float = 0.0  # half the length of the point's error bars
    y_error: float = 0.0


def place_labels(axes: Axes, labels: Sequence[Label], size_pt: float = 7.5) -> None:
    """Writes the labels, each where it overlaps least with points, their error bars and other labels; the limits
    and the size of the axes must be final."""
    figure = axes.figure
    pixels_per_pt = figure.dpi / 72
    renderer = figure.canvas.get_renderer()
    inside = axes.get_window_extent(renderer)
    at = [axes.transData.transform((label.x, label.y)) for label in labels]
    radius = _POINT_RADIUS_PT * pixels_per_pt
    taken = [Bbox.from_extents(x - radius, y - radius, x + radius, y + radius) for x, y in at]
    taken += [box for label in labels for box in _error_bars(axes, label, pixels_per_pt)]
    # From right to left: labels on the right side of points meet fewest others.
    for index in sorted(range(len(labels)), key=lambda i: (-at[i][0], -at[i][1])):
        label, (x, y) = labels[index], at[index]
        text = axes.annotate(
            label.text, (label.x, label.y), xytext=(0, 0), textcoords="offset points", fontsize=size_pt,
            color=label.color, va="center", ha="left", bbox=_BACKGROUND,
        )  # fmt: skip
        extent = Text.get_window_extent(text, renderer)
        dx, dy, box = _best_place(x, y, extent.width, extent.height, pixels_per_pt, taken, inside)
        taken.append(box)
        text.set_position(((box.x0 - x) / pixels_per_pt, ((box.y0 + box.y1) / 2 - y) / pixels_per_pt))
        if math.hypot(dx, dy) > _LEADER_FROM_PT * pixels_per_pt:
            end = axes.transData.inverted().transform((x + dx, y + dy))
            axes.plot([label.x, end[0]], [label.y, end[1]], color=label.color, linewidth=0.5, zorder=1)


def _best_place(
    x: float, y: float, width: float, height: float, pixels_per_pt: float, taken: list[Bbox], inside: Bbox
) -> tuple[float, float, Bbox]:
    """Offset from the point to the label's nearest edge, and the label's box, in pixels: the nearest place that is
    free, or else the one with the least overlap."""
    best: tuple[float, float, Bbox] | None = None
    least = math.inf
    for distance in _DISTANCES_PT:
        for angle in _ANGLES_DEG:
            dx = distance * pixels_per_pt * math.cos(math.radians(angle))
            dy = distance * pixels_per_pt * math.sin(math.radians(angle))
            side = math.cos(math.radians(angle))
            left = x + dx - (width / 2 if abs(side) < 0.1 else width if side < 0 else 0)
            box = Bbox.from_bounds(left, y + dy - height / 2, width, height)
            outside = width * height - _common_area(box, inside)
            overlap = outside + sum(_common_area(box, other) for other in taken)
            if overlap < least - 1e-6:
                best, least = (dx, dy, box), overlap
    assert best is not None
    return best


def _error_bars(axes: Axes, label: Label, pixels_per_pt: float) -> list[Bbox]:
    boxes = []
    for dx, dy in ((label.x_error, 0.0), (0.0, label.y_error)):
        if dx == dy == 0.0:
            continue
        ends = axes.transData.transform([(label.x - dx, label.y - dy), (label.x + dx, label.y + dy)])
        if np.isfinite(ends).all():
            boxes.append(Bbox([ends.min(axis=0), ends.max(axis=0)]).padded(_BAR_RADIUS_PT * pixels_per_pt))
    return boxes


def _common_area(a: Bbox, b: Bbox) -> float:
    width = min(a.x1, b.x1) - max(a.x0, b.x0)
    height = min(a.y1, b.y1) - max(a.y0, b.y0)
    return width * height if width > 0 and height > 0 else 0.0
