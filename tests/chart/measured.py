"""Measured rows, their file, and what repeats of one case say together."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

SETTINGS = ("scene", "scenario", "taa", "codec", "display", "frames", "warm", "latency", "mbits", "without")


@dataclass(frozen=True)
class Measured:
    """One row of the table; README.md lists the columns and their units."""

    cells: dict[str, str]

    def text(self, column: str) -> str:
        return self.cells.get(column, "")

    def number(self, column: str) -> float:
        """NaN where the cell is empty or the column is not there."""
        cell = self.text(column)
        return float(cell) if cell else math.nan

    @property
    def case(self) -> str:
        """The row's name without its seed."""
        return re.sub(r" seed=\d+(?= |$)", "", self.text("name"))


@dataclass(frozen=True)
class Case:
    """Repeats of one row with different seeds, of which there is at least one."""

    rows: tuple[Measured, ...]

    @property
    def name(self) -> str:
        return self.rows[0].case

    def text(self, column: str) -> str:
        return self.rows[0].text(column)

    def mean(self, column: str) -> float:
        """Over the repeats that have a figure; NaN if none has."""
        figures = self._figures(column)
        return math.fsum(figures) / len(figures) if figures else math.nan

    def standard_error(self, column: str) -> float:
        """Of the mean; NaN with fewer than two figures or with one that is infinite."""
        figures = self._figures(column)
        if len(figures) < 2 or not all(map(math.isfinite, figures)):
            return math.nan
        mean = self.mean(column)
        variance = math.fsum((figure - mean) ** 2 for figure in figures) / (len(figures) - 1)
        return math.sqrt(variance / len(figures))

    def _figures(self, column: str) -> list[float]:
        return [figure for row in self.rows if not math.isnan(figure := row.number(column))]


def cases_of(rows: Iterable[Measured]) -> list[Case]:
    """Rows that differ in nothing but their seed make a case; cases keep the order of their first rows."""
    groups: dict[str, list[Measured]] = {}
    for row in rows:
        groups.setdefault(row.case, []).append(row)
    return [Case(tuple(group)) for group in groups.values()]


def settings_of(case: Case, but: Sequence[str] = ()) -> tuple[str, ...]:
    """What a case was measured under, without its method and the columns `but`."""
    return tuple(case.text(column) for column in SETTINGS if column not in but)


def read_rows(path: Path) -> list[Measured]:
    with path.open(newline="") as file:
        return [Measured(cells) for cells in csv.DictReader(file)]


def write_rows(path: Path, columns: Sequence[str], rows: Iterable[Measured]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(row.cells for row in rows)
