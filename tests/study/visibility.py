"""How visible masks, and changes from one to the other, are to metrics. All figures grow with what is visible."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from perceptual import Clip

# Name of a metric -> what it says of a clip against another one: jod and jod_transient, or flip.
Judge = Callable[["Clip"], dict[str, float]]

METRICS = {
    "jod": "10 - JOD",
    "jod_transient": "JOD's transient channel",
    "flip": "FLIP",
    "rms": "rms difference, ‰",
    "flicker": "flicker, ‰",
}


def rms(a: np.ndarray, b: np.ndarray, counts: np.ndarray) -> float:
    """Of sRGB-coded values in 1/1000 of the range, over the pixels that count, all frames and channels."""
    difference = (a.astype(np.float32) - b.astype(np.float32))[:, counts]
    return 1000.0 / 255.0 * math.sqrt(float(np.mean(np.square(difference, dtype=np.float64))))


def flicker(test: np.ndarray, counts: np.ndarray) -> float:
    """rms of what changes from frame to frame, as above; for clips in which nothing moves but the gaze."""
    return rms(test[1:], test[:-1], counts)


def judged(judges: list[Judge], clip: Clip) -> dict[str, float]:
    """What the perceptual metrics that can be had say of a clip, as visibility."""
    figures: dict[str, float] = {}
    for judge in judges:
        figures |= judge(clip)
    if "jod" in figures:
        figures["jod"] = 10.0 - figures["jod"]
    return figures


@dataclass
class Place:
    """What is seen at one moment of a recording, once by each mask: clips of the same gaze, which is the eye's."""

    clips: dict[str, Clip]
    judges: list[Judge]

    def _counts(self, mask: str) -> np.ndarray:
        """Pixels that the lens shows, which are never quite black all the time."""
        clip = self.clips[mask]
        return clip.reference.max(axis=(0, 3)) > 0

    def state(self, mask: str) -> dict[str, float]:
        """Of the mask against what should be seen."""
        clip = self.clips[mask]
        counts = self._counts(mask)
        figures = {"rms": rms(clip.test, clip.reference, counts), "flicker": flicker(clip.test, counts)}
        return figures | judged(self.judges, clip)

    def change(self, before: str, after: str) -> dict[str, float]:
        """Of the mask `after` taking the place of `before` in the middle of the clip, against no change at all."""
        stays, comes = self.clips[before], self.clips[after]
        middle = len(stays.test) // 2
        counts = self._counts(before)
        replaced = np.concatenate([stays.test[:middle], comes.test[middle:]])
        figures = {
            "rms": rms(comes.test[middle:], stays.test[middle:], counts),
            "flicker": abs(flicker(comes.test, counts) - flicker(stays.test, counts)),
        }
        return figures | judged(self.judges, type(stays)(replaced, stays.test, stays.gaze_px))
