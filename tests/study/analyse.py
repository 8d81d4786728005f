#!/usr/bin/env python3
"""Evaluates the detection experiment: normalised detection rates and which masks differ, as in the paper's figure 8.

usage: analyse.py [--window FIRST LAST] [--alpha A] [--svg FILE] OBSERVER[.SCENE].csv...

Reads tables of macula-client --study and writes Markdown on standard output. README.md says how it judges.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from statistics import fmean, stdev

from detection import Session, Window, judge, observer_of, rates, read_events
from ranking import Ranking, rank_masks


def standard_error(values: list[float]) -> float:
    """Of the mean; not a number for a single value."""
    return stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def with_error(values: list[float]) -> str:
    error = standard_error(values)
    return f"{fmean(values):+.2f}" + ("" if math.isnan(error) else f" ± {error:.2f}")


def rate_table(sessions: list[Session]) -> list[str]:
    by_mask = rates(sessions)
    lines = ["| changed to | changes | noticed | normalised rate ± SEM | observers | reaction, s (median) |"]
    lines.append("|---|---|---|---|---|---|")
    for mask in sorted(by_mask, key=lambda mask: fmean(by_mask[mask].values())):
        changes = [change for session in sessions for change in session.changes if change.after == mask]
        reactions = sorted(change.reaction_s for change in changes if change.reaction_s is not None)
        median = f"{reactions[len(reactions) // 2]:.2f}" if reactions else ""
        values = list(by_mask[mask].values())
        lines.append(
            f"| `{mask}` | {len(changes)} | {len(reactions)} | {with_error(values)} | {len(values)} | {median} |"
        )
    return lines


def from_to_table(sessions: list[Session]) -> list[str]:
    """Noticed of all, by what was there before: the paper counts by the mask that is changed to alone."""
    changes = [change for session in sessions for change in session.changes]
    befores = sorted({change.before for change in changes})
    afters = sorted({change.after for change in changes})
    lines = ["| noticed of all: from \\ to | " + " | ".join(f"`{mask}`" for mask in afters) + " |"]
    lines.append("|---" * (len(afters) + 1) + "|")
    for before in befores:
        cells = []
        for after in afters:
            of = [change for change in changes if change.before == before and change.after == after]
            cells.append(f"{sum(change.reaction_s is not None for change in of)}/{len(of)}" if of else "")
        lines.append(f"| `{before}` | " + " | ".join(cells) + " |")
    return lines


def false_alarm_lines(sessions: list[Session], window: Window) -> list[str]:
    lines = []
    for observer in sorted({session.observer for session in sessions}):
        of = [session for session in sessions if session.observer == observer]
        idle_s = sum(session.idle_s for session in of)
        alarms = sum(session.false_alarms for session in of)
        # Presses at random times as often as these would answer so many changes.
        chance = 1.0 - math.exp(-alarms / idle_s * (window.last_s - window.first_s)) if idle_s > 0.0 else 0.0
        lines.append(
            f"- {observer}: {alarms} false alarms in {idle_s:.0f} s, by which chance would answer {100 * chance:.0f} % "
            f"of changes; {sum(session.repeats for session in of)} repeated presses; "
            f"{sum(session.left_out for session in of)} changes left out at the end"
        )
    return lines


def ranking_lines(ranking: Ranking | None, alpha: float) -> list[str]:
    if ranking is None:
        return ["No ranking: it needs two masks and two observers who saw all of them."]
    lines = [
        "From the fewest detections to the most: " + " < ".join(f"`{mask}`" for mask in ranking.order) + ".",
        "",
        f"{len(ranking.observers)} observers; mean ranks differ at p < {alpha:g} from {ranking.critical_difference:.2f} "
        "on (Nemenyi).",
        "",
        "| left | right | right is worse | observers | difference of mean ranks | p | significant |",
        "|---|---|---|---|---|---|---|",
    ]
    for pair in ranking.pairs:
        lines.append(
            f"| `{pair.left}` | `{pair.right}` | {100 * pair.probability:.0f} % | {pair.worse} of "
            f"{len(ranking.observers)} | {pair.difference:.2f} | {pair.p_value:.3f} | "
            f"{'yes' if pair.significant else 'no'} |"
        )
    return lines


def report(sessions: list[Session], window: Window, alpha: float) -> str:
    lines = ["# Detection of mask changes", ""]
    lines.append(f"A press counts from {window.first_s:g} to {window.last_s:g} s after the new mask was first shown.")
    scenes = sorted({session.scene for session in sessions})
    for scene in scenes:
        lines += ["", f"## {scene}", "", *rate_table([session for session in sessions if session.scene == scene])]
    if len(scenes) > 1:
        lines += ["", "## All scenes", "", *rate_table(sessions)]
    lines += ["", *from_to_table(sessions), "", "## Ranking", "", *ranking_lines(rank_masks(rates(sessions), alpha), alpha)]
    lines += ["", "## Presses", "", *false_alarm_lines(sessions, window)]
    return "\n".join(lines) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("tables", nargs="+", type=Path, metavar="OBSERVER[.SCENE].csv")
    parser.add_argument(
        "--window", nargs=2, type=float, default=(Window.first_s, Window.last_s), metavar=("FIRST", "LAST"),
        help="seconds after a change in which a press answers it (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument("--alpha", type=float, default=0.05, help="level of significance (default: %(default)s)")
    parser.add_argument("--svg", type=Path, help="also draws the rates and the ranking; needs matplotlib")
    options = parser.parse_args()
    window = Window(*options.window)
    try:
        sessions = [judge(read_events(path), observer_of(path), window) for path in options.tables]
    except (OSError, ValueError) as error:
        print(f"analyse.py: {error}", file=sys.stderr)
        return 3
    sessions = [session for session in sessions if session.changes]
    if not sessions:
        print("analyse.py: no table has a change", file=sys.stderr)
        return 3
    print(report(sessions, window, options.alpha), end="")
    if options.svg:
        try:
            from plots import draw
        except ImportError as error:
            print(f"analyse.py: no {options.svg}, for want of matplotlib: {error}", file=sys.stderr)
            return 0
        draw(sessions, rank_masks(rates(sessions), options.alpha), options.svg)
    return 0


if __name__ == "__main__":
    sys.exit(main())
