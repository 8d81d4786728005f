"""Which changes of the mask an observer has noticed: reads what macula-client --study has written."""

from __future__ import annotations

import csv
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Window:
    """When a press counts as an answer to a change, in seconds after the new mask was first shown.

    Nobody answers a picture within .2 s: simple visual reactions take .2 to .25 s at best (Luce, Response Times, 1986).
    Intervals are 3 s at least unless told otherwise, so 2.5 s leaves room for a search in the periphery and still ends
    before the next change. Where a change comes sooner, the window ends when a press could answer that one.
    """

    first_s: float = 0.2
    last_s: float = 2.5


@dataclass(frozen=True)
class Event:
    time_s: float
    event: str  # shown, key or end
    before: str
    after: str
    scene: str


@dataclass(frozen=True)
class Change:
    time_s: float
    before: str
    after: str
    reaction_s: float | None  # None: not noticed


@dataclass
class Session:
    """One observer in one scene."""

    observer: str
    scene: str
    changes: list[Change] = field(default_factory=list)
    false_alarms: int = 0  # presses outside of all windows
    repeats: int = 0  # further presses in the window of a change that was answered already
    left_out: int = 0  # changes whose window the end of the session cuts off
    idle_s: float = 0.0  # time outside of windows, in which false alarms could come


def read_events(path: Path) -> list[Event]:
    """The rows of a table, by time. Raises ValueError for a file that is not one."""
    with path.open(newline="") as file:
        table = csv.DictReader(file)
        if table.fieldnames != ["time_s", "event", "from", "to", "scene"]:
            raise ValueError(f"{path}: not a table of macula-client --study")
        events = [Event(float(row["time_s"]), row["event"], row["from"], row["to"], row["scene"]) for row in table]
    return sorted(events, key=lambda event: event.time_s)


def judge(events: list[Event], observer: str, window: Window = Window()) -> Session:
    """Attributes presses to changes. The first mask shown replaces nothing, and is no change. A session that broke off
    without an end ends with its last row."""
    shown = [event for event in events if event.event == "shown" and event.before]
    keys = [event.time_s for event in events if event.event == "key"]
    end_s = max((event.time_s for event in events), default=0.0)
    session = Session(observer, events[0].scene if events else "")
    windows_s = 0.0
    answered = 0  # presses in windows
    for index, event in enumerate(shown):
        first = event.time_s + window.first_s
        last = event.time_s + window.last_s
        if index + 1 < len(shown):
            last = min(last, shown[index + 1].time_s + window.first_s)
        presses = [key for key in keys if first <= key < last]
        answered += len(presses)
        windows_s += max(0.0, min(last, end_s) - first)
        if last > end_s:
            session.left_out += 1
            continue
        session.repeats += max(0, len(presses) - 1)
        session.changes.append(
            Change(event.time_s, event.before, event.after, presses[0] - event.time_s if presses else None)
        )
    session.false_alarms = len(keys) - answered
    session.idle_s = max(0.0, end_s - windows_s)
    return session


def observer_of(path: Path) -> str:
    """The file's name up to the first dot: anna.bunny-box.csv and anna.air-shed.csv are of one observer."""
    return path.name.split(".")[0]


def rate(changes: list[Change]) -> float:
    """The paper's normalised detection rate: 1 when all changes were noticed, 0 when half of them, -1 when none; the
    straight line through these three is 2 d / n - 1."""
    noticed = sum(change.reaction_s is not None for change in changes)
    return 2.0 * noticed / len(changes) - 1.0


def rates(sessions: list[Session]) -> dict[str, dict[str, float]]:
    """[mask that is changed to][observer], over all sessions of the observer; without those that had no such change."""
    of: dict[str, dict[str, list[Change]]] = {}
    for session in sessions:
        for change in session.changes:
            of.setdefault(change.after, {}).setdefault(session.observer, []).append(change)
    return {mask: {observer: rate(changes) for observer, changes in by.items()} for mask, by in of.items()}
