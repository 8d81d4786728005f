"""Frame time and speed-up beside the paper's Table 1, with what each spends whatever it traces and what it spends on
rays. `tests/chart/tables.sh paper` runs it."""

from __future__ import annotations

import argparse
import math
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from line_fit import LineFit, fit_line
from measured import Case, Measured, cases_of, read_rows, write_rows
from program import Program, RowError
from published import PERCENTS, TABLE_1, Published

RESULTS = Path(__file__).resolve().parent / "results"


@dataclass(frozen=True)
class Family:
    """Methods that differ in their share of the samples, and the settings under which they are measured."""

    title: str
    pattern: str  # of the method, with {} for the percent
    settings: str = ""

    def method(self, percent: int) -> str:
        return "tiles:full/tiles" if percent == 100 else self.pattern.format(percent)


# The paper traces the whole buffer; what a lens hides was not left out. Of all its pixels, tiles trace what it does.
WHOLE = "without=hidden-area"
FAMILIES = (
    Family("paper's masks, table", "mesh:paper-{}/table", WHOLE),
    Family("paper's masks, rasterised", "mesh:paper-{}/raster", WHOLE),
    Family("tiles", "tiles:{}/tiles"),
)


def names_of(scene: str, display: str, rounds: int) -> list[str]:
    """Rows of a scene, round by round, so that all methods meet the same load of the machine."""
    common = f"taa=off codec=none display={display} frames=3 warm=1"
    names: list[str] = []
    for seed in range(1, rounds + 1):
        names += dict.fromkeys(
            f"{scene} still {family.method(percent)} {common} {family.settings} seed={seed}"
            for family in FAMILIES
            for percent in PERCENTS
        )
    return names


@dataclass(frozen=True)
class Cost:
    """What a family was found to cost in one scene: rounds by percent."""

    family: Family
    by_percent: dict[int, Case]

    def ms(self, percent: int) -> float:
        return self.by_percent[percent].mean("server_p50_ms")

    def share(self, percent: int) -> float:
        return self.by_percent[percent].mean("traced_share")

    def speed_up(self, percent: int) -> tuple[float, float]:
        """Mean over the rounds of full's time over this one's, and its standard error."""
        return mean_and_error(
            [
                full.number("server_p50_ms") / row.number("server_p50_ms")
                for full, row in zip(self.by_percent[100].rows, self.by_percent[percent].rows, strict=True)
            ]
        )

    def fits(self) -> list[LineFit]:
        """One for each round: milliseconds over the share of the buffer that was traced."""
        rounds = zip(*(self.by_percent[percent].rows for percent in PERCENTS), strict=True)
        return [
            fit_line([row.number("traced_share") for row in rows], [row.number("server_p50_ms") for row in rows])
            for rows in rounds
        ]


def cost_of(family: Family, scene: str, cases: Sequence[Case]) -> Cost:
    without = family.settings.partition("=")[2]

    def case(percent: int) -> Case:
        method = family.method(percent)
        return next(
            case
            for case in cases
            if (case.text("scene"), case.text("method"), case.text("without")) == (scene, method, without)
        )

    return Cost(family, {percent: case(percent) for percent in PERCENTS})


def mean_and_error(values: Sequence[float]) -> tuple[float, float]:
    """Mean and its standard error, NaN of a single value."""
    mean = math.fsum(values) / len(values)
    if len(values) < 2:
        return mean, math.nan
    return mean, math.sqrt(math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1) / len(values))


def with_error(mean: float, error: float, digits: int) -> str:
    return f"{mean:.{digits}f}" if math.isnan(error) else f"{mean:.{digits}f} ± {error:.{digits}f}"


def times_table(paper: Published, costs: Sequence[Cost]) -> str:
    swapped = paper.swapped()

    def cells(percent: int) -> list[str]:
        ours = [f"{cost.ms(percent):.1f} ({100 * cost.share(percent):.1f} %)" for cost in costs]
        return [f"{percent}", f"{paper.ms[percent]:.1f}", f"{swapped.ms[percent]:.1f}", *ours]

    heads = ["samples, %", "paper, as printed, ms", "rows swapped, ms"]
    return _table([*heads, *(f"{cost.family.title}, ms (traced)" for cost in costs)], cells)


def speed_ups_table(paper: Published, costs: Sequence[Cost]) -> str:
    swapped = paper.swapped()

    def cells(percent: int) -> list[str]:
        ours = [with_error(*cost.speed_up(percent), 2) for cost in costs]
        printed = [f"{table.speed_up[percent]:.1f}" for table in (paper, swapped)]
        return [f"{percent}", f"{100 / percent:.2f}", *printed, *ours]

    heads = ["samples, %", "1/f", "paper, as printed", "rows swapped"]
    return _table([*heads, *(cost.family.title for cost in costs)], cells)


def _table(heads: Sequence[str], cells: Callable[[int], list[str]]) -> str:
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    lines += ["| " + " | ".join(cells(percent)) + " |" for percent in PERCENTS]
    return "\n".join(lines)


def fits_table(paper: Published, costs: Sequence[Cost]) -> str:
    lines = [
        "| whose | a, fixed, ms | b, for all pixels, ms | rms off the line, ms | in parts of t(1) | "
        "fixed part of t(1), % |",
        "|---|---|---|---|---|---|",
    ]
    for name, table in (("paper, as printed", paper), ("paper, rows swapped", paper.swapped())):
        lines.append(_fit_row(name, [table.fit()]))
    lines += [_fit_row(cost.family.title, cost.fits()) for cost in costs]
    return "\n".join(lines)


def _fit_row(name: str, fits: Sequence[LineFit]) -> str:
    def cell(values: Sequence[float], digits: int) -> str:
        return with_error(*mean_and_error(values), digits)

    cells = [
        cell([fit.fixed for fit in fits], 1),
        cell([fit.slope for fit in fits], 1),
        cell([fit.rms for fit in fits], 2),
        cell([fit.rms / (fit.fixed + fit.slope) for fit in fits], 3),
        cell([100 * fit.fixed_share for fit in fits], 1),
    ]
    return f"| {name} | " + " | ".join(cells) + " |"


REMARKS = """\
Times are those of the server's stages of a stereo frame: plan, trace, reconstruct. The paper's are of a whole frame on a
GeForce GTX 1080; ours of a CPU. Absolute times do not compare; speed-ups and the parts of the line do. The paper's masks
are traced as the paper traced them, over the whole buffer, and reconstructed in C++, by a table of barycentric
coordinates or by drawing the triangles, which the paper did on its GPU; 100 % is one ray a pixel and no reconstruction.
Tiles are what Macula does otherwise: what the lens hides is not traced, at 100 % neither, so that less is traced than is
asked for. Lines are fitted to the share of the buffer that was traced, the paper's to the share that it states. Speed-ups
are ratios within a round; ± is the standard error over rounds."""


def report(rows: Sequence[Measured], notes: Sequence[str] = ()) -> str:
    cases = cases_of(rows)
    made = f"`tests/chart/tables.sh paper --display {rows[0].text('display')} --rounds {len(cases[0].rows)}` makes it."
    parts = ["# The paper's Table 1", " ".join((made, *notes)), REMARKS]
    for paper in TABLE_1:
        if not any(case.text("scene") == paper.scene for case in cases):
            continue
        costs = [cost_of(family, paper.scene, cases) for family in FAMILIES]
        parts += [f"## {paper.title}", "Time of a stereo frame:", times_table(paper, costs)]
        parts += ["Speed-up, of at most 1/f:", speed_ups_table(paper, costs)]
        parts += ["Lines t = a + b f:", fits_table(paper, costs)]
    return "\n\n".join(parts) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(prog="tests/chart/tables.sh paper", description=__doc__)
    parser.add_argument("--program", type=Path, required=True, help="macula-chart")
    parser.add_argument("--display", default="vive", help="of the rows (default: %(default)s)")
    parser.add_argument("--rounds", type=int, default=4)
    parser.add_argument("--scenes", nargs="+", default=[table.scene for table in TABLE_1])
    parser.add_argument("--csv", type=Path, help="also write the rows to this file")
    parser.add_argument("--from-csv", type=Path, help="measure nothing: the table of these rows")
    parser.add_argument("--note", action="append", default=[], help="a sentence for the table's head")
    parser.add_argument("--out", type=Path, default=RESULTS / "paper-table.md")
    options = parser.parse_args()
    if options.from_csv:
        rows = read_rows(options.from_csv)
    else:
        rows = []
        try:
            with tempfile.TemporaryDirectory() as folder, Program(options.program, Path(folder)) as program:
                for scene in options.scenes:
                    for name in names_of(scene, options.display, options.rounds):
                        rows.append(program.measure(name))
                        print(f"{name}  {rows[-1].text('server_p50_ms')} ms", flush=True)
                        if options.csv:
                            write_rows(options.csv, program.columns, rows)
        except RowError as error:
            print(f"tests/chart: {error}", file=sys.stderr)
            return 1
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(report(rows, options.note))
    return 0


if __name__ == "__main__":
    sys.exit(main())
