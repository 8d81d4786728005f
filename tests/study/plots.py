"""Draws rates and ranking as the paper's figure 8 does."""

from __future__ import annotations

from pathlib import Path
from statistics import fmean, stdev

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from detection import Session, rates
from ranking import Ranking


def draw_rates(axes: plt.Axes, sessions: list[Session]) -> None:
    scenes = sorted({session.scene for session in sessions})
    of_all = rates(sessions)
    masks = sorted(of_all, key=lambda mask: fmean(of_all[mask].values()))
    width = 0.8 / len(scenes)
    for i, scene in enumerate(scenes):
        of_scene = rates([session for session in sessions if session.scene == scene])
        shown = [mask for mask in masks if mask in of_scene]
        values = [list(of_scene[mask].values()) for mask in shown]
        errors = [stdev(v) / len(v) ** 0.5 if len(v) > 1 else 0.0 for v in values]
        places = [masks.index(mask) + (i - (len(scenes) - 1) / 2) * width for mask in shown]
        axes.bar(places, [fmean(v) for v in values], width, yerr=errors, capsize=4, label=scene)
    axes.axhline(0.0, color="black", linewidth=0.8)
    axes.set_xticks(range(len(masks)), masks, rotation=20, ha="right", fontsize=8)
    axes.set_ylim(-1.1, 1.1)
    axes.set_ylabel("normalised detection rate")
    axes.legend()


def draw_ranking(axes: plt.Axes, ranking: Ranking) -> None:
    """Masks on a line, an arc for each pair: blue where they differ, red and dashed where that cannot be said."""
    place = {mask: i for i, mask in enumerate(ranking.order)}
    for mask, x in place.items():
        axes.plot(x, 0.0, "o", color="black")
        axes.annotate(mask, (x, -0.12), ha="right", va="top", rotation=20, fontsize=8)
    for pair in ranking.pairs:
        left, right = place[pair.left], place[pair.right]
        steps = [i / 40 for i in range(41)]
        height = 0.4 * (right - left) ** 1.3
        axes.plot(
            [left + (right - left) * t for t in steps],
            [4.0 * height * t * (1.0 - t) for t in steps],
            color="tab:blue" if pair.significant else "tab:red",
            linestyle="-" if pair.significant else "--",
        )
        axes.annotate(f"{100 * pair.probability:.0f} %", (0.5 * (left + right), height), ha="center", va="bottom")
    axes.set_xlim(-0.5, len(place) - 0.5)
    axes.set_ylim(-0.8, 0.4 * (len(place) - 1) ** 1.3 + 0.3)
    axes.axis("off")
    axes.set_title("probability that the right one is noticed more", fontsize=9)


def draw(sessions: list[Session], ranking: Ranking | None, path: Path) -> None:
    plt.rcParams["svg.hashsalt"] = "macula"  # the same data give the same file
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    draw_rates(left, sessions)
    if ranking is None:
        right.axis("off")
    else:
        draw_ranking(right, ranking)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
