"""Metrics that other programs compute: FLIP and FovVideoVDP, over the clip of the row that was measured last.

Either may be absent; a run goes on without it and says so. Settings: the HTC Vive's geometry, divided as the row's
display is. Both judge the whole buffer of the left eye; what the lens hides is black in clip and reference.
"""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from measured import Measured

COLUMNS = ("flip", "jod", "jod_transient")

VIVE_WIDTH_PX = 1512
VIVE_PIXELS_PER_DEGREE = 9.967  # at the centre
VIVE_FOV_HORIZONTAL_DEG = 105.87
VIVE_DISTANCE_M = 3.0
VIVE_PEAK_CD_M2 = 133.3
VIVE_CONTRAST = 1333
REFRESH_HZ = 90
# FovVideoVDP's temporal filters are 250 ms long; of a shorter clip it is given the last frame as a still picture.
LEAST_VIDEO_FRAMES = 23
THREADS = 2


@dataclass(frozen=True)
class Clip:
    """Pictures of the left eye, [frame][row][column][channel], sRGB-coded bytes, and the true gaze."""

    test: np.ndarray
    reference: np.ndarray  # one frame where nothing moves but the gaze
    gaze_px: np.ndarray  # [frame][x, y]; a pixel's centre lies at +.5

    @staticmethod
    def load(folder: Path) -> Clip:
        with (folder / "gaze.csv").open(newline="") as file:
            gaze = [(float(row["x_px"]), float(row["y_px"])) for row in csv.DictReader(file)]
        return Clip(np.load(folder / "test.npy"), np.load(folder / "reference.npy"), np.array(gaze))


Metric = Callable[[Clip], dict[str, float]]


def load_flip() -> Metric:
    """FLIP (Andersson et al. 2020) of the last frame at the display's pixels per degree, 0..1, 0 is equal. Raises
    ImportError without the package flip-evaluator."""
    import flip_evaluator

    def flip(clip: Clip) -> dict[str, float]:
        parameters = {"ppd": VIVE_PIXELS_PER_DEGREE * clip.test.shape[2] / VIVE_WIDTH_PX}
        reference, test = (pictures[-1].astype(np.float32) / 255 for pictures in (clip.reference, clip.test))
        _, mean, _ = flip_evaluator.evaluate(
            reference, test, "LDR", inputsRGB=True, applyMagma=False, parameters=parameters
        )
        return {"flip": float(mean)}

    return flip


def load_fvvdp() -> Metric:
    """FovVideoVDP (Mantiuk et al. 2021) with the true gaze: just-objectionable differences, 10 is equal, and the mean
    of its transient channel, 0 is equal. Raises ImportError without the package pyfvvdp, which is CC BY-NC: a tool from
    outside, no part of Macula."""
    import pyfvvdp
    import torch

    torch.set_num_threads(THREADS)

    def fvvdp(clip: Clip) -> dict[str, float]:
        frames, height, width, _ = clip.test.shape
        metric = pyfvvdp.fvvdp(
            display_geometry=pyfvvdp.fvvdp_display_geometry(
                (width, height), fov_horizontal=VIVE_FOV_HORIZONTAL_DEG, distance_m=VIVE_DISTANCE_M
            ),
            display_photometry=pyfvvdp.fvvdp_display_photo_eotf(
                Y_peak=VIVE_PEAK_CD_M2, contrast=VIVE_CONTRAST, EOTF="sRGB"
            ),
            foveated=True,
            quiet=True,
        )
        gaze = torch.tensor(clip.gaze_px - 0.5, dtype=torch.float32)  # there a pixel's centre has no half
        if frames < LEAST_VIDEO_FRAMES:
            jod, _ = metric.predict(clip.test[-1], clip.reference[-1], dim_order="HWC", fixation_point=gaze[-1])
            return {"jod": float(jod)}
        reference = np.broadcast_to(clip.reference, clip.test.shape)
        jod, statistics = metric.predict(
            np.ascontiguousarray(clip.test.transpose(1, 2, 3, 0)),
            np.ascontiguousarray(reference.transpose(1, 2, 3, 0)),
            dim_order="HWCF",
            frames_per_second=REFRESH_HZ,
            fixation_point=gaze,
        )
        return {"jod": float(jod), "jod_transient": float(statistics["Q_per_ch"][:, 1].mean())}

    return fvvdp


class Perceptual:
    """The metrics that can be imported, and what is missing."""

    def __init__(self, want_fvvdp: bool) -> None:
        self.missing: list[str] = []
        self._flip = self._load(load_flip, "FLIP: no package flip-evaluator")
        self._fvvdp = None
        if want_fvvdp:
            self._fvvdp = self._load(load_fvvdp, "FovVideoVDP (JOD): no package pyfvvdp; --with-fvvdp installs it")
        else:
            self.missing.append("FovVideoVDP (JOD): these rows are too small and short for it")

    def _load(self, load: Callable[[], Metric], otherwise: str) -> Metric | None:
        try:
            return load()
        except ImportError as error:
            self.missing.append(f"{otherwise} ({error})")
            return None

    def judge(self, row: Measured, clips: Path, jod: bool) -> Measured:
        """The row with its columns flip, jod and jod_transient, as far as they can be had."""
        metrics = [self._flip, self._fvvdp if jod else None]
        if not row.text("display").startswith("vive"):  # nothing is known of other displays' pixels per degree
            metrics = []
        clip = Clip.load(clips) if any(metrics) else None
        figures: dict[str, float] = {}
        for metric in metrics:
            if metric is not None and clip is not None:
                figures |= metric(clip)
        cells = {column: f"{figures[column]:.6g}" if column in figures else "" for column in COLUMNS}
        return Measured(row.cells | cells)
