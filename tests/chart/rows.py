"""Which rows a run has. What a row's name says: tests/pipeline/row.h.

Rows of one scene, display and scenario follow each other, because macula-chart keeps the scene and the last reference.
"""

from __future__ import annotations

from dataclasses import dataclass

SCENES = ("bunny-box", "air-shed")
FRACTIONS = ("54", "41", "27", "18")

TILES = tuple(f"tiles:{fraction}/tiles" for fraction in FRACTIONS)
MESHES = tuple(f"mesh:{fraction}/table" for fraction in FRACTIONS)
PAPER_54 = "mesh:paper-54/raster"
PAPER_18 = "mesh:paper-18/raster"
# Table and raster give nearly the same picture; drawing takes longer.
PAPER_TABLES = tuple(f"mesh:paper-{fraction}/table" for fraction in FRACTIONS)
RIVALS = ("layers:27/bilinear", "uniform:27/bilinear", "log-polar:27/bilinear")
OTHER_FILLS = ("tiles:27/push-pull", "tiles:27/cells", "tiles:27/nearest", "mesh-16:27/table")
FULL = "tiles:full/tiles"

# Neither accumulation nor coding: what sampling and reconstruction do by themselves.
BARE = "taa=off codec=none"
# The saccade lands in the middle of all frames, so it is judged if fewer come before than are judged.
SACCADE = "warm=12"


@dataclass(frozen=True)
class Planned:
    """A row to measure, and whether FovVideoVDP judges it, which takes longer than all else."""

    name: str
    jod: bool = False


def _rows(
    scene: str,
    scenario: str,
    methods: tuple[str, ...],
    settings: str,
    seeds: int = 1,
    jod_seeds: int = 0,
) -> list[Planned]:
    """Each method with seeds 1..seeds; the first jod_seeds of them are judged by FovVideoVDP."""
    return [
        Planned(
            " ".join((scene, scenario, method, settings)) + (f" seed={seed}" if seed > 1 else ""),
            jod=seed <= jod_seeds,
        )
        for method in methods
        for seed in range(1, seeds + 1)
    ]


def _in_use(
    scene: str, scenario: str, ours: tuple[str, ...], papers: tuple[str, ...], settings: str, **seeds: int
) -> list[Planned]:
    """Rows with accumulation: methods with Macula's, and methods with the paper's."""
    return _rows(scene, scenario, ours, settings, **seeds) + _rows(
        scene, scenario, papers, f"taa=paper {settings}", **seeds
    )


def quick_rows(recordings: bool) -> list[Planned]:
    """Rows of an eighth of the display's edges; with `recordings`, those too that need shared/gaze."""
    small = "display=vive/8"
    bare = f"{BARE} {small}"
    every = (*TILES, FULL, *MESHES, PAPER_54, PAPER_18, *RIVALS, *OTHER_FILLS)
    rows = _rows("bunny-box", "still", every, f"{bare} frames=4 warm=1", seeds=3)
    # Where pixels are fewer, tiles are wider, and their coarser steps flicker more: a quarter, not an eighth.
    rows += _rows("bunny-box", "pursuit", (*TILES, *MESHES), f"{BARE} display=vive/4 warm=2", seeds=2)
    # At an eighth of the edges the encoder has 3 kB a frame, and its noise flickers more than what is sampled.
    uncoded = f"codec=none {small}"
    if recordings:
        ours = (TILES[0], TILES[2], TILES[3], FULL)
        rows += _in_use("bunny-box", "recorded-gaze", ours, (PAPER_54, PAPER_18), uncoded, seeds=3)
        rows += _in_use("bunny-box", "recorded-gaze", (TILES[3],), (PAPER_54,), small)
    rows += _in_use("bunny-box", "saccade", (TILES[3], FULL), (PAPER_54,), f"{uncoded} {SACCADE}", seeds=2)
    rows += _in_use("bunny-box", "pan", (TILES[3], FULL), (PAPER_54,), f"{uncoded} frames=8")
    few = tuple(method for method in (*TILES, *MESHES) if "41" not in method)
    rows += _rows("air-shed", "still", (*few, FULL), f"{bare} frames=4 warm=1", seeds=2)
    rows += _rows("air-shed", "pursuit", (TILES[2], TILES[3], MESHES[2], MESHES[3]), f"{bare} warm=2")
    return rows


def full_rows(recordings: bool) -> list[Planned]:
    """Accuracy of every method at the display's true size, clips at half its edges, both scenes; clips for FovVideoVDP,
    which takes minutes for larger ones, at a quarter."""
    half = "display=vive/2"
    quarter = "display=vive/4"
    rows: list[Planned] = []
    for scene in SCENES:
        whole = f"{BARE} display=vive frames=3 warm=1"
        rows += _rows(scene, "still", (*TILES, FULL, *MESHES), whole, seeds=2, jod_seeds=2)
        rows += _rows(scene, "still", PAPER_TABLES, whole, seeds=2, jod_seeds=2)
        rows += _rows(scene, "still", (*RIVALS, *OTHER_FILLS), whole, jod_seeds=1)
        rows += _rows(scene, "pursuit", (TILES[3], MESHES[3]), f"{BARE} {quarter} warm=2", jod_seeds=1)
        # Air Shed takes five times as long: of it, what the questions of the chart need.
        first = scene == SCENES[0]
        moved = (*TILES, *MESHES) if first else (TILES[0], TILES[3], MESHES[0], MESHES[3])
        rows += _rows(scene, "pursuit", moved, f"{BARE} {half} warm=2", seeds=2 if first else 1)
        if recordings:
            rows += _in_use(scene, "recorded-gaze", TILES[3:], (PAPER_54,), quarter, jod_seeds=1)
            rows += _in_use(scene, "recorded-gaze", TILES[3:], (PAPER_54,), half, seeds=3 if first else 1)
        if not first:
            continue
        if recordings:
            rows += _in_use(scene, "recorded-gaze", (TILES[0], TILES[2], FULL), (PAPER_18,), half)
            for seed in ("", " seed=2"):  # the head moves: a set of references for each seed
                rows += _in_use(scene, "recorded", (TILES[3], FULL), (PAPER_54,), f"{half} frames=12{seed}")
        for scenario in ("saccade", "pan", "sway"):
            rows += _in_use(scene, scenario, (TILES[3], FULL), (PAPER_54,), f"{half} frames=12 warm=6")
    return rows
