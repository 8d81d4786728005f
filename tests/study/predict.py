#!/usr/bin/env python3
"""Predicts the detection experiment without people: scores the changes of its schedule by metrics.

usage: predict.py --chart MACULA_CHART [options]

Renders recorded gaze by the reference and four masks through the whole pipeline (macula-chart), and asks metrics how
visible each change of the schedule is. Writes Markdown on standard output: the order that each metric predicts beside
the paper's figure 8. README.md says what is scored and what came out.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

from prediction import KINDS, NOTICED, UNNOTICED, Scores, agrees, mean_visibility, order, place_of
from schedule import make_schedule

ROOT = Path(__file__).resolve().parents[2]
MASKS = ("54", "41", "27", "18")
REFERENCE = "full"
# What is compared: names of methods for a mask, and the temporal anti-aliasing that goes with them.
BLOCKS = {
    "the paper's masks, with its TAA": ("mesh:paper-{}/raster", "paper"),
    "tiles, with Macula's TAA": ("tiles:{}/tiles", "macula"),
    "the paper's masks, without TAA": ("mesh:paper-{}/raster", "off"),
}


def row_name(scene: str, mask: str, block: str, seed: int, display: str, frames: int) -> str:
    pattern, taa = BLOCKS[block]
    method = "tiles:full/tiles" if mask == REFERENCE else pattern.format(mask)
    return f"{scene} recorded-gaze {method} taa={taa} display={display} frames={frames} seed={seed}"


def score(options: argparse.Namespace, scene: str, block: str, schedules: list, judges: list) -> Scores:
    """Renders all masks at all places and scores what the schedules need."""
    from perceptual import Clip
    from program import Program
    from visibility import Place

    scores = Scores([], [])
    with tempfile.TemporaryDirectory() as folder, Program(options.chart, Path(folder)) as program:
        for place in range(options.places):
            clips = {}
            for mask in (REFERENCE, *MASKS):
                program.measure(row_name(scene, mask, block, 1 + place, options.display, options.frames))
                clips[mask] = Clip.load(Path(folder))
            seen = Place(clips, judges)
            pairs = {
                (before, after)
                for schedule in schedules
                for index, (_, before, after) in enumerate(schedule)
                if place_of(index, options.places) == place
            }
            scores.states.append({mask: seen.state(mask) for mask in (REFERENCE, *MASKS)})
            scores.changes.append({pair: seen.change(*pair) for pair in sorted(pairs)})
            print(f"{scene}, {block}: place {place + 1} of {options.places}", file=sys.stderr)
    return scores


def table(scores: Scores, schedules: list, metrics: dict[str, str]) -> list[str]:
    lines = ["| metric | of | 54 | 41 | 27 | 18 | order, least visible first | as figure 8 |"]
    lines.append("|---|---|---|---|---|---|---|---|")
    for metric, title in metrics.items():
        for kind in KINDS:
            visibility = mean_visibility(scores, schedules, kind, metric)
            values = " | ".join(f"{visibility[mask]:.3g}" for mask in MASKS)
            lines.append(
                f"| {title} | {kind} | {values} | {' < '.join(order(visibility))} | "
                f"{'yes' if agrees(visibility) else 'no'} |"
            )
    return lines


def missing_recordings() -> bool:
    return not any((ROOT.parent / "shared" / "gaze").glob("salient360_*.csv"))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--chart", type=Path, required=True, help="the program macula-chart")
    parser.add_argument("--scene", action="append", help="may be repeated (default: bunny-box and air-shed)")
    parser.add_argument("--block", action="append", choices=BLOCKS, help="may be repeated (default: the first two)")
    parser.add_argument("--display", default="vive/2", help="(default: %(default)s)")
    parser.add_argument("--frames", type=int, default=48, help="of a clip, 46 at least (default: %(default)s)")
    parser.add_argument("--places", type=int, default=3, help="moments of the recordings (default: %(default)s)")
    parser.add_argument("--observers", type=int, default=6, help="schedules, seeds from 1 on (default: %(default)s)")
    parser.add_argument("--without-jod", action="store_true", help="leaves out FovVideoVDP, which takes most of the time")
    options = parser.parse_args()
    if missing_recordings():
        print("predict.py: skipped, since the gaze recordings are not there (shared/gaze beside the repository)")
        return 77
    sys.path.insert(0, str(ROOT / "tests" / "chart"))
    try:
        import numpy  # noqa: F401
    except ImportError as error:
        print(f"predict.py: skipped, since NumPy is not there: {error}")
        return 77
    from perceptual import load_flip, load_fvvdp
    from visibility import METRICS

    judges = []
    metrics = dict(METRICS)
    for load, names, wanted in (
        (load_fvvdp, ("jod", "jod_transient"), not options.without_jod),
        (load_flip, ("flip",), True),
    ):
        try:
            if wanted:
                judges.append(load())
                continue
            problem = "not asked for"
        except ImportError as error:
            problem = str(error)
        print(f"predict.py: without {', '.join(names)}: {problem}", file=sys.stderr)
        for name in names:
            del metrics[name]
    schedules = [make_schedule(list(MASKS), REFERENCE, seed=1 + observer) for observer in range(options.observers)]
    print("# What metrics predict of the detection experiment\n")
    print(f"{sum(map(len, schedules))} changes of {len(schedules)} schedules; gaze of {options.places} moments of the")
    print(f"recordings; display `{options.display}`, {options.frames} frames a clip. Figure 8: observers noticed")
    print(f"{' and '.join(NOTICED)} %, and did not notice {' and '.join(UNNOTICED)} %.\n")
    for kind, meaning in KINDS.items():
        print(f"- *{kind}*: {meaning}")
    for block in options.block or list(BLOCKS)[:2]:
        for scene in options.scene or ("bunny-box", "air-shed"):
            print(f"\n## {scene}, {block}\n")
            print("\n".join(table(score(options, scene, block, schedules, judges), schedules, metrics)), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
