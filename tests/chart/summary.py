"""The summary of a run: Markdown."""

from __future__ import annotations

import math
from collections.abc import Sequence

from bounds import Outcome
from columns import IN_SUMMARY, Figure, method_label
from measured import Case, settings_of


def summary(
    heading: str, notes: Sequence[str], outcomes: Sequence[Outcome], cases: Sequence[Case], charts: Sequence[str]
) -> str:
    """`notes`: what the run was, and what it went without. `outcomes`: of bounds that were checked."""
    parts = [f"# {heading}", "\n".join(f"- {note}" for note in notes)]
    if outcomes:
        parts += ["## Bounds", _bounds_table(outcomes)]
    if charts:
        parts += ["## Charts", "\n\n".join(f"![{chart.removesuffix('.svg')}]({chart})" for chart in charts)]
    parts += [
        "## Rows",
        "Each is the mean of its repeats, ± the standard error of the mean. `tests/chart/run.sh --rows 'NAME'` makes a "
        "row again; ` seed=2` after the name makes its second repeat. Columns: `tests/chart/README.md`.",
    ]
    groups: dict[tuple[str, ...], list[Case]] = {}
    for case in cases:
        groups.setdefault(settings_of(case, but=("taa",)), []).append(case)
    for group in groups.values():
        parts += [f"### {_settings_heading(group[0])}", _table(group)]
    return "\n\n".join(parts) + "\n"


def _settings_heading(case: Case) -> str:
    settings = ["scene", "scenario", "display"]
    heading = ", ".join(case.text(column) for column in settings)
    heading += f", {_codec(case)}, {case.text('frames')} frames after {case.text('warm')}"
    if case.text("latency") not in ("", "0"):
        heading += f", latency {case.text('latency')} frames"
    if case.text("without"):
        heading += f", without {case.text('without')}"
    return heading


def _codec(case: Case) -> str:
    codec = case.text("codec")
    return "not coded" if codec == "none" else f"{codec} at {case.text('mbits')} Mbit/s"


def _table(group: Sequence[Case]) -> str:
    figures = [figure for figure in IN_SUMMARY if any(not math.isnan(case.mean(figure.column)) for case in group)]
    lines = [
        "| method | TAA | " + " | ".join(figure.heading for figure in figures) + " | name |",
        "|---|---|" + "---|" * len(figures) + "---|",
    ]
    for case in group:
        cells = [method_label(case.text("method")), case.text("taa")]
        cells += [_cell(case, figure) for figure in figures]
        lines.append("| " + " | ".join(cells) + f" | `{case.name}` |")
    return "\n".join(lines)


def _cell(case: Case, figure: Figure) -> str:
    mean = case.mean(figure.column)
    if math.isnan(mean):
        return ""
    if math.isinf(mean):
        return "∞"
    text = f"{mean * figure.scale:.{figure.digits}f}"
    error = case.standard_error(figure.column)
    return text if math.isnan(error) else f"{text} ± {error * figure.scale:.{figure.digits}f}"


def _bounds_table(outcomes: Sequence[Outcome]) -> str:
    lines = ["| bound | measured | must be | holds | reason |", "|---|---|---|---|---|"]
    for outcome in outcomes:
        holds = "yes" if outcome.holds else "**no**"
        lines.append(
            f"| {outcome.bound.name} | {outcome.measured} | {outcome.bound.limit} | {holds} | {outcome.bound.reason} |"
        )
    return "\n".join(lines)
