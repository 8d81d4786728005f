"""Asks macula-chart to measure rows, one at a time."""

from __future__ import annotations

import csv
import subprocess
from pathlib import Path
from types import TracebackType

from measured import Measured


class RowError(Exception):
    """macula-chart could not measure a row, or ended."""


class Program:
    """A running macula-chart. After measure() the row's clip lies in the clips folder until the next call."""

    def __init__(self, executable: Path, clips: Path) -> None:
        self.clips = clips
        self._process = subprocess.Popen(
            [executable, "--clips", clips], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )
        self.columns = self._line().split(",")

    def __enter__(self) -> Program:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()

    def measure(self, name: str) -> Measured:
        """Measures the row of that name. Raises RowError with the program's message."""
        assert self._process.stdin is not None
        self._process.stdin.write(name + "\n")
        self._process.stdin.flush()
        line = self._line()
        if line.startswith("error: "):
            raise RowError(f"{name}: {line.removeprefix('error: ')}")
        return Measured(dict(zip(self.columns, next(csv.reader([line])), strict=True)))

    def _line(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise RowError(f"macula-chart ended with code {self._process.wait()}")
        return line.rstrip("\n")
