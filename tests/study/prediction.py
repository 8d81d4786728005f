"""What metrics predict of the detection experiment, from the visibility of masks and of changes."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import fmean

# The paper's figure 8: above and below the threshold of half of the changes.
NOTICED = ("18", "27")
UNNOTICED = ("41", "54")

KINDS = {
    "change": "difference between the masks before and after",
    "worse": "how much worse the new mask is than the old one, 0 if it is better",
    "state": "the new mask alone, against the reference",
}

Figures = dict[str, float]  # by metric


@dataclass(frozen=True)
class Scores:
    """Of all places of one scene: states[place][mask], changes[place][before, after]."""

    states: list[dict[str, Figures]]
    changes: list[dict[tuple[str, str], Figures]]

    def of(self, kind: str, metric: str, place: int, before: str, after: str) -> float:
        if kind == "change":
            return self.changes[place][before, after][metric]
        state = self.states[place]
        if kind == "state":
            return state[after][metric]
        return max(0.0, state[after][metric] - state[before][metric])


def place_of(index: int, places: int) -> int:
    """Which place of the recording the change of this index in its schedule is seen at: they take turns."""
    return index % places


def mean_visibility(
    scores: Scores, schedules: list[list[tuple[float, str, str]]], kind: str, metric: str
) -> dict[str, float]:
    """[mask that is changed to], over all changes of all schedules; masks are named by their percentage."""
    of: dict[str, list[float]] = {}
    for schedule in schedules:
        for index, (_, before, after) in enumerate(schedule):
            value = scores.of(kind, metric, place_of(index, len(scores.states)), before, after)
            of.setdefault(after, []).append(value)
    return {mask: fmean(values) for mask, values in of.items()}


def order(visibility: dict[str, float]) -> list[str]:
    """From the least visible on."""
    return sorted(visibility, key=visibility.__getitem__)


def agrees(visibility: dict[str, float]) -> bool:
    """Whether those that observers noticed are all more visible than those that they did not."""
    return min(visibility[mask] for mask in NOTICED) > max(visibility[mask] for mask in UNNOTICED)
