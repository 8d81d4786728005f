"""Table 1 of Siekawa, Chwesiuk, Mantiuk and Piórkowski, Foveated Ray Tracing for VR Headsets, and what is said of the
time without a mask in the text before it: stereo frames of 1512x1680 pixels an eye on a GeForce GTX 1080."""

from __future__ import annotations

from dataclasses import dataclass

from line_fit import LineFit, fit_line

PERCENTS = (18, 27, 41, 54, 100)


@dataclass(frozen=True)
class Published:
    """One scene. By percent of the samples; 100 is the reference, which needs no reconstruction."""

    scene: str  # as macula-chart knows it
    title: str
    ms: dict[int, float]
    speed_up: dict[int, float]  # of 100 it is 1 by definition

    def swapped(self) -> Published:
        """With the rows of 41 and 54 % exchanged."""
        return Published(self.scene, self.title, _exchanged(self.ms), _exchanged(self.speed_up))

    def fit(self) -> LineFit:
        """Milliseconds over the fraction 0..1 of the samples."""
        return fit_line([percent / 100 for percent in PERCENTS], [self.ms[percent] for percent in PERCENTS])


def _exchanged(rows: dict[int, float]) -> dict[int, float]:
    return rows | {41: rows[54], 54: rows[41]}


TABLE_1 = (
    Published(
        "bunny-box",
        "Bunny Box",
        {18: 15.0, 27: 17.9, 41: 27.6, 54: 24.1, 100: 49.5},
        {18: 3.3, 27: 2.8, 41: 1.8, 54: 2.1, 100: 1.0},
    ),
    Published(
        "air-shed",
        "Air Shed",
        {18: 18.1, 27: 23.7, 41: 37.5, 54: 29.8, 100: 66.0},
        {18: 3.7, 27: 2.8, 41: 1.8, 54: 2.2, 100: 1.0},
    ),
)
