"""The figures of a row that tables and charts show: what they are called, and which way is better."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Figure:
    column: str
    heading: str  # of a table
    title: str  # of a chart's axis, with the unit
    digits: int
    higher_is_better: bool
    scale: float = 1.0  # from the column to what is shown


TIME = Figure("server_p50_ms", "server, ms", "plan, trace and reconstruct a stereo frame, p50, ms", 1, False)
TRACED = Figure("traced_share", "traced, %", "pixels traced, % of both eyes' buffers", 1, False, 100.0)
PSNR = Figure("psnr_db", "PSNR, dB", "PSNR, dB", 2, True)
FOVEA = Figure("foveal_psnr_db", "fovea, dB", "PSNR within 2.5° of the gaze, dB", 2, True)
SSIM = Figure("ssim", "SSIM", "SSIM", 4, True)
FLIP = Figure("flip", "FLIP", "FLIP (less is better)", 4, False)
JOD = Figure("jod", "JOD", "FovVideoVDP, JOD", 2, True)
TRANSIENT = Figure("jod_transient", "transient", "FovVideoVDP's transient channel (less is better)", 2, False)
FLICKER = Figure("flicker", "flicker, ‰", "flicker, rms, ‰ (less is better)", 2, False, 1000.0)
WORST_FLICKER = Figure("worst_flicker", "worst step, ‰", "flicker of the worst step, rms, ‰", 2, False, 1000.0)
KILOBYTES = Figure("kilobytes", "kB", "kilobytes of a stereo frame", 0, False)
ALL_TIME = Figure("all_p50_ms", "all stages, ms", "all stages of a stereo frame, p50, ms", 1, False)

RINGS = {
    "flicker_5": "0–5°",
    "flicker_15": "5–15°",
    "flicker_25": "15–25°",
    "flicker_40": "25–40°",
    "flicker_90": "40–90°",
}
STAGES = ("plan", "trace", "reconstruct", "encode", "decode", "accumulate", "show")

IN_SUMMARY = (
    TRACED, TIME, ALL_TIME, KILOBYTES, PSNR, FOVEA, SSIM, FLIP, JOD, TRANSIENT, FLICKER, WORST_FLICKER
)  # fmt: skip


def method_label(method: str, taa: str = "") -> str:
    """A method as charts name it: its reconstruction only where the sampler has others, `taa` where charts mix it."""
    sampling, _, fill = method.partition("/")
    usual = {"tiles": "tiles", "mesh": "table", "layers": "bilinear", "uniform": "bilinear", "log-polar": "bilinear"}
    sampler, _, preset = sampling.partition(":")
    label = f"{sampler} {preset}"
    if fill != usual.get(sampler.split("-")[0] if sampler.startswith("mesh") else sampler):
        label += f" {fill}"
    return f"{label}, TAA {taa}" if taa else label
