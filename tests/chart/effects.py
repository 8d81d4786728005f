"""What switching a model off did: pairs of rows that differ in nothing else."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from columns import FLICKER, FLIP, FOVEA, JOD, KILOBYTES, PSNR, SSIM, TRACED, TRANSIENT, WORST_FLICKER, Figure
from measured import Measured


@dataclass(frozen=True)
class Watched:
    """A figure of which the change is watched. Changes below `least` are none that anybody would keep a model for."""

    figure: Figure
    heading: str
    relative: bool  # change in percent; otherwise in the figure's own unit
    least: float
    digits: int

    def change(self, on: Measured, off: Measured) -> float:
        """NaN where either is missing, or infinite."""
        before, after = on.number(self.figure.column), off.number(self.figure.column)
        if not (math.isfinite(before) and math.isfinite(after)):
            return math.nan
        if not self.relative:
            return after - before
        return 100 * (after / before - 1) if before > 0 else math.nan


def _time(column: str, heading: str) -> Watched:
    return Watched(Figure(column, heading, heading, 1, False), f"{heading}, %", True, 2.0, 1)


# Costs first. Of times, what is below 2 % is below what repeats differ by, and rays tell more exactly; a tenth of a decibel
# and 2 % of flicker are far below what is seen; blurring the foveal degree costs .03 JOD.
WATCHED = (
    _time("server_p50_ms", "server"),
    _time("accumulate_p50_ms", "accumulate"),
    Watched(TRACED, "rays, %", True, 1.0, 1),
    Watched(KILOBYTES, "kB, %", True, 2.0, 1),
    Watched(PSNR, "PSNR, dB", False, 0.1, 2),
    Watched(FOVEA, "fovea, dB", False, 0.1, 2),
    Watched(SSIM, "SSIM", False, 0.002, 4),
    Watched(FLIP, "FLIP", False, 0.002, 4),
    Watched(JOD, "JOD", False, 0.05, 2),
    Watched(TRANSIENT, "transient", False, 0.05, 2),
    Watched(FLICKER, "flicker, %", True, 2.0, 1),
    Watched(WORST_FLICKER, "worst step, %", True, 2.0, 1),
)


@dataclass(frozen=True)
class Pair:
    """The same row with everything on, measured right before, and with one model off."""

    on: Measured
    off: Measured


# Student's t at 95 %, both sides, by pairs; the last for as many or more.
_T_95 = {2: 12.71, 3: 4.30, 4: 3.18, 5: 2.78, 6: 2.57, 8: 2.36, 12: 2.20, 20: 2.09}


def _t_95(pairs: int) -> float:
    """Infinite for a single pair, which tells no error."""
    return _T_95[max(count for count in _T_95 if count <= pairs)] if pairs > 1 else math.inf


@dataclass(frozen=True)
class Change:
    """Mean over pairs and its standard error, NaN of a single pair."""

    watched: Watched
    mean: float
    error: float
    pairs: int

    @property
    def counts(self) -> bool:
        """Larger than what is to be ignored, and than what chance makes of it in 19 of 20 cases."""
        return abs(self.mean) >= self.watched.least and abs(self.mean) > _t_95(self.pairs) * self.error

    @property
    def text(self) -> str:
        if math.isnan(self.mean):
            return ""
        digits = self.watched.digits
        text = f"{self.mean:+.{digits}f}"
        if not math.isnan(self.error):
            text += f" ± {self.error:.{digits}f}"
        return f"**{text}**" if self.counts else text


def change_of(watched: Watched, pairs: Sequence[Pair]) -> Change:
    changes = [change for pair in pairs if not math.isnan(change := watched.change(pair.on, pair.off))]
    if not changes:
        return Change(watched, math.nan, math.nan, 0)
    mean = math.fsum(changes) / len(changes)
    if len(changes) < 2:
        return Change(watched, mean, math.nan, 1)
    squares = math.fsum((change - mean) ** 2 for change in changes)
    return Change(watched, mean, math.sqrt(squares / (len(changes) - 1) / len(changes)), len(changes))
