"""Measures rows, judges them, and writes the table, the summary and the charts. run.sh is the door."""

from __future__ import annotations

import argparse
import os
import platform
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import perceptual
from bounds import Outcome, check, quick_bounds
from charts import draw_all
from measured import Measured, cases_of, read_rows, write_rows
from perceptual import Perceptual
from program import Program, RowError
from rows import Planned, full_rows, quick_rows
from summary import summary

SOURCE = Path(__file__).resolve().parents[2]
RECORDINGS = SOURCE.parent / "shared" / "gaze"


def parse_arguments(arguments: Sequence[str]) -> argparse.Namespace:
    """The options that run.sh explains."""
    parser = argparse.ArgumentParser(prog="tests/chart/run.sh")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--quick", action="store_true")
    what.add_argument("--full", action="store_true")
    what.add_argument("--rows", nargs="+", metavar="NAME")
    what.add_argument("--from-csv", type=Path, metavar="FILE")
    parser.add_argument("--out", type=Path, default=SOURCE / "out" / "chart", metavar="DIR")
    parser.add_argument("--with-fvvdp", action="store_true", help="heeded by run.sh, which installs it")
    parser.add_argument("--program", type=Path, required=True, help="macula-chart")
    return parser.parse_args(arguments)


def planned_rows(options: argparse.Namespace) -> list[Planned]:
    recordings = RECORDINGS.is_dir()
    if options.rows:
        return [Planned(name, jod=True) for name in options.rows]
    return full_rows(recordings) if options.full else quick_rows(recordings)


def measure(options: argparse.Namespace, metrics: Perceptual) -> list[Measured]:
    """Measures and judges row by row, and keeps the table on disk up to date. Raises RowError."""
    plan = planned_rows(options)
    measured: list[Measured] = []
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as folder, Program(options.program, Path(folder)) as program:
        for number, planned in enumerate(plan, start=1):
            row = metrics.judge(program.measure(planned.name), program.clips, planned.jod)
            measured.append(row)
            write_rows(options.out / "rows.csv", [*program.columns, *perceptual.COLUMNS], measured)
            seconds = time.monotonic() - began
            print(f"{number}/{len(plan)} {seconds:.0f} s  {planned.name}  {row.text('psnr_db')} dB", flush=True)
    return measured


def notes_of(options: argparse.Namespace, metrics: Perceptual | None, seconds: float) -> list[str]:
    if metrics is None:
        return [f"Of the table {options.from_csv.name}; nothing was measured."]
    which = "--full" if options.full else f"--rows, {len(options.rows)} of them" if options.rows else "--quick"
    notes = [
        f"`tests/chart/run.sh {which}`: {seconds / 60:.0f} minutes on {os.cpu_count()} cores, {_processor()}. Times "
        "compare methods within this run."
    ]
    notes += [f"Without {missing}." for missing in metrics.missing]
    if not RECORDINGS.is_dir():
        notes.append(f"Without recorded gaze: there is no {RECORDINGS}.")
    return notes


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.machine()
    return next((line.partition(": ")[2] for line in lines if line.startswith("model name")), platform.machine())


def report(outcomes: Sequence[Outcome]) -> bool:
    """Prints what broke; whether all bounds hold."""
    broken = [outcome for outcome in outcomes if not outcome.holds]
    for outcome in broken:
        bound = outcome.bound
        print(f"BROKEN: {bound.name}: {outcome.measured}, must be {bound.limit}. {bound.reason}", file=sys.stderr)
    if outcomes:
        print(f"bounds: {len(outcomes) - len(broken)} of {len(outcomes)} hold")
    return not broken


def main() -> int:
    options = parse_arguments(sys.argv[1:])
    options.out.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    metrics = None if options.from_csv else Perceptual(want_fvvdp=bool(options.full or options.rows))
    try:
        measured = read_rows(options.from_csv) if metrics is None else measure(options, metrics)
    except RowError as error:
        print(f"tests/chart: {error}", file=sys.stderr)
        return 1
    cases = cases_of(measured)
    quick = not (options.full or options.rows or options.from_csv)
    outcomes = check(quick_bounds(RECORDINGS.is_dir()), cases) if quick else []
    drawn = draw_all(cases, options.out)
    notes = notes_of(options, metrics, time.monotonic() - began)
    (options.out / "summary.md").write_text(summary("Speed against accuracy", notes, outcomes, cases, drawn))
    print(f"{options.out}: summary.md and {len(drawn)} charts")
    return 0 if report(outcomes) else 1


if __name__ == "__main__":
    sys.exit(main())
