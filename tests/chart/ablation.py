"""What each model of the pipeline is worth: every one is switched off alone (tests/pipeline/ablation.h), and its cost and
its effect on every metric are set side by side. `tests/chart/tables.sh ablation` runs it."""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

import perceptual
from effects import WATCHED, Change, Pair, change_of
from measured import Measured, read_rows, write_rows
from perceptual import Perceptual
from program import Program, RowError

RESULTS = Path(__file__).resolve().parent / "results"
RECORDINGS = Path(__file__).resolve().parents[3] / "shared" / "gaze"

MODELS = (
    "hidden-area",
    "true-tangents",
    "footprint-mips",
    "normal-roughness",
    "hysteresis",
    "eccentricity-weight",
    "bounce-bound",
)
# Of these only the client's history knows.
IN_HISTORY = ("eccentricity-weight",)

SCENES = ("bunny-box", "air-shed", "gloss/4", "moving/4")

Key = tuple[str, str, str]  # scene, scenario, model


def scenarios(recordings: bool) -> tuple[str, ...]:
    """The gaze moves; the head moves slowly; it turns fast; near things uncover far ones."""
    return ("recorded-gaze" if recordings else "pursuit", "slow-pan", "pan", "sway")


def names_of(scene: str, scenario: str, settings: str, models: Sequence[str], seed: int) -> list[str]:
    """Pairs, one after the other: everything on, then one model off."""
    on = f"{scene} {scenario} {settings} seed={seed}"
    return [name for model in models for name in (on, f"{on} without={model}")]


def pairs_of(rows: Sequence[Measured]) -> dict[Key, list[Pair]]:
    """Of rows in the order in which they were measured. Raises ValueError for a row whose other half is missing."""
    pairs: dict[Key, list[Pair]] = {}
    for on, off in zip(rows[::2], rows[1::2], strict=True):
        model = off.text("without")
        if on.text("without") or not model or on.text("seed") != off.text("seed"):
            raise ValueError(f"'{off.text('name')}' is not the other half of '{on.text('name')}'")
        pairs.setdefault((off.text("scene"), off.text("scenario"), model), []).append(Pair(on, off))
    return pairs


def changes_of(pairs: dict[Key, list[Pair]]) -> dict[Key, list[Change]]:
    """Of what each model can change: times of the other program's stages are not its own."""

    def watched_of(model: str):
        column = "server_p50_ms" if model in IN_HISTORY else "accumulate_p50_ms"
        return [watched for watched in WATCHED if watched.figure.column != column]

    return {key: [change_of(watched, each) for watched in watched_of(key[2])] for key, each in pairs.items()}


def scene_table(scene: str, changes: dict[Key, list[Change]]) -> str:
    rows = {key: each for key, each in changes.items() if key[0] == scene}
    columns = [w for w in WATCHED if any(c.watched is w and c.text for each in rows.values() for c in each)]
    lines = [
        "| off | scenario | " + " | ".join(watched.heading for watched in columns) + " |",
        "|---|---|" + "---|" * len(columns),
    ]
    for model in MODELS:
        for (_, scenario, off), each in rows.items():
            if off != model:
                continue
            by_figure = {change.watched: change.text for change in each}
            cells = [by_figure.get(watched, "") for watched in columns]
            lines.append(f"| {model} | {scenario} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def settings_of(scene: str, pairs: dict[Key, list[Pair]]) -> str:
    """What the scene's pairs were measured under; the number of repeats is the least of any row of its table."""
    of_scene = [each for key, each in pairs.items() if key[0] == scene]
    row = of_scene[0][0].on
    return (
        f"`{row.text('method')}`, display {row.text('display')}, codec {row.text('codec')}, {row.text('frames')} frames "
        f"after {row.text('warm')}, {min(map(len, of_scene))} pairs or more of each."
    )


def verdicts(changes: dict[Key, list[Change]]) -> str:
    """For each model, where it moves a figure most, in parts of what is to be ignored; or that it moves nothing."""
    lines = ["| model | figures that move | most |", "|---|---|---|"]
    for model in MODELS:
        found = [(key, change) for key, each in changes.items() if key[2] == model for change in each]
        moved = [(key, change) for key, change in found if change.counts]
        if not found:
            continue
        if not moved:
            lines.append(f"| {model} | **none of {len(found)}** | |")
            continue
        key, most = max(moved, key=lambda each: abs(each[1].mean) / each[1].watched.least)
        where = f"{most.watched.heading}: {most.text.strip('*')} ({key[0]}, {key[1]})"
        lines.append(f"| {model} | {len(moved)} of {len(found)} | {where} |")
    return "\n".join(lines)


REMARKS = """\
Every row of a table is the change when that one model is off: the same row of the chart with it off, less (or in percent
of) the one with everything on that was measured right before it. Each pair is repeated with other seeds, that is other
gazes and directions; ± is the standard error of the mean over them. Bold: beyond the 95 % of Student's t for so many
pairs, and more than is to be ignored, which is 2 % of a time, of bytes or of flicker, 1 % of the rays to first hits, .1 dB,
.002 of SSIM or FLIP, .05 JOD; of so many figures a few are bold by chance. What the models are:
[ablation.h](../../pipeline/ablation.h). A positive time is what the model saves, a negative one what it costs; of models
in the client's history, the server's time is not shown, and of the others not the client's. Without a codec, kilobytes
are those of depth. `SCENE/4` are scenes of the stability suite, with details as fine as the pixels of vive/4."""


def report(rows: Sequence[Measured], notes: Sequence[str]) -> str:
    pairs = pairs_of(rows)
    changes = changes_of(pairs)
    parts = ["# Ablation", REMARKS, *notes, "## What moves, and what does not"]
    parts.append(verdicts(changes))
    for scene in dict.fromkeys(key[0] for key in changes):
        parts += [f"## {scene}", settings_of(scene, pairs), scene_table(scene, changes)]
    return "\n\n".join(parts) + "\n"


def measure(options: argparse.Namespace, metrics: Perceptual, save: Callable[[list[str], list[Measured]], None]):
    """Rows in pairs. Raises RowError."""
    settings = f"{options.method} codec={options.codec} display={options.display} "
    settings += f"frames={options.frames} warm={options.warm}"
    rows: list[Measured] = []
    with tempfile.TemporaryDirectory() as folder, Program(options.program, Path(folder)) as program:
        for scene in options.scenes:
            for scenario in options.scenarios:
                for seed in range(1, options.seeds + 1):
                    for name in names_of(scene, scenario, settings, options.models, seed):
                        rows.append(metrics.judge(program.measure(name), program.clips, jod=options.with_jod))
                        print(f"{name}  {rows[-1].text('psnr_db')} dB", flush=True)
                    save([*program.columns, *perceptual.COLUMNS], rows)
    return rows


def parse_arguments(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tests/chart/tables.sh ablation", description=__doc__)
    parser.add_argument("--program", type=Path, required=True, help="macula-chart")
    parser.add_argument("--display", default="vive/2", help="of the rows (default: %(default)s)")
    parser.add_argument("--method", default="tiles:27/tiles")
    parser.add_argument("--codec", default="none", help="none shows what a codec would veil (default)")
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--warm", type=int, default=24)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--scenarios", nargs="+", default=scenarios(RECORDINGS.is_dir()))
    parser.add_argument("--models", nargs="+", default=MODELS, choices=MODELS)
    parser.add_argument("--with-jod", action="store_true", help="judge by FovVideoVDP too, where it is installed")
    parser.add_argument("--csv", type=Path, help="also write the rows to this file")
    parser.add_argument("--from-csv", type=Path, help="measure nothing: the tables of these rows")
    parser.add_argument("--note", action="append", default=[], help="a sentence for the tables' head")
    parser.add_argument("--out", type=Path, default=RESULTS / "ablation.md")
    return parser.parse_args(arguments)


def main() -> int:
    options = parse_arguments(sys.argv[1:])
    notes: list[str] = options.note

    def save(columns: list[str], rows: list[Measured]) -> None:
        if options.csv:
            write_rows(options.csv, columns, rows)

    if options.from_csv:
        rows = read_rows(options.from_csv)
    else:
        metrics = Perceptual(want_fvvdp=options.with_jod)
        notes += [f"Without {missing}." for missing in metrics.missing]
        try:
            rows = measure(options, metrics, save)
        except RowError as error:
            print(f"tests/chart: {error}", file=sys.stderr)
            return 1
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(report(rows, notes))
    return 0


if __name__ == "__main__":
    sys.exit(main())
