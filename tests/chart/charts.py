"""Charts of cases, as SVG files that are the same bytes for the same rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as Drawing
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

import columns
from columns import Figure, method_label
from labels import Label, place_labels
from measured import Case, settings_of
from pareto import pareto_front

# Which cases a chart compares: the scenario, and whether frames are accumulated.
Selection = tuple[str, bool]
STILL: Selection = ("still", False)
PURSUIT: Selection = ("pursuit", False)
IN_USE: Selection = ("recorded-gaze", True)

ACCURACY_CHARTS: tuple[tuple[Selection, tuple[Figure, ...]], ...] = (
    (STILL, (columns.PSNR, columns.FOVEA, columns.SSIM, columns.FLIP, columns.JOD)),
    (PURSUIT, (columns.FLICKER, columns.TRANSIENT)),
    (IN_USE, (columns.PSNR, columns.FLICKER, columns.JOD, columns.TRANSIENT)),
)

_FAMILIES = {"tiles": "#1565a8", "mesh": "#c4550c", "uniform": "#6a6a6a", "layers": "#2e7d32", "log-polar": "#7b3f9d"}
_STAGE_COLORS = ("#8c9fb5", "#1565a8", "#4fa3d9", "#c4550c", "#eb9a5f", "#2e7d32", "#8cc28f")
_RING_MARKERS = "osD^vPX*hd<>p8"
_PANEL_IN = (6.0, 4.8)

plt.rcParams.update(
    {
        "svg.hashsalt": "macula",
        "svg.fonttype": "none",  # text stays text: a quarter of the bytes
        "font.family": "sans-serif",
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.color": "#e4e4e4",
        "grid.linewidth": 0.6,
        "axes.axisbelow": True,
    }
)


def draw_all(cases: Sequence[Case], folder: Path) -> list[str]:
    """Draws every chart that the cases have figures for; names of the files, in order."""
    drawn: list[str] = []
    folder.mkdir(parents=True, exist_ok=True)
    for selection, figures in ACCURACY_CHARTS:
        for figure in figures:
            name = f"time-{figure.column.replace('_', '-')}-{selection[0]}.svg"
            drawn += _draw(folder / name, _selected(cases, selection, figure.column), _accuracy(figure))
    drawn += _draw(folder / "share-psnr-still.svg", _selected(cases, STILL, "psnr_db"), _share)
    for selection in (PURSUIT, IN_USE):
        name = f"rings-{selection[0]}.svg"
        drawn += _draw(folder / name, _selected(cases, selection, "flicker_40"), _rings)
    for selection in (STILL, IN_USE):
        name = f"stages-{selection[0]}.svg"
        drawn += _draw(folder / name, _selected(cases, selection, "server_p50_ms"), _stages)
    return drawn


def _selected(cases: Sequence[Case], selection: Selection, column: str) -> dict[str, list[Case]]:
    """By scene, the cases of a selection that have a figure; of each scene those under the same settings, of which
    there are most."""
    scenario, accumulated = selection
    scenes: dict[str, dict[tuple[str, ...], list[Case]]] = {}
    for case in cases:
        if case.text("scenario") != scenario or (case.text("taa") != "off") != accumulated:
            continue
        if math.isfinite(case.mean(column)):
            groups = scenes.setdefault(case.text("scene"), {})
            groups.setdefault(settings_of(case, but=("taa",)), []).append(case)
    largest = {scene: max(groups.values(), key=len) for scene, groups in scenes.items()}
    return {scene: group for scene, group in largest.items() if len(group) > 1}


def _draw(path: Path, scenes: dict[str, list[Case]], panel: Callable[[Axes, list[Case]], list[Label]]) -> list[str]:
    """One panel for each scene, which tells the labels to be placed once all panels have their size."""
    if not scenes:
        return []
    drawing = Drawing(figsize=(_PANEL_IN[0] * len(scenes), _PANEL_IN[1]), layout="constrained")
    FigureCanvasAgg(drawing)  # what measures text
    all_axes = drawing.subplots(1, len(scenes), squeeze=False)[0]
    labels = []
    for axes, (scene, cases) in zip(all_axes, scenes.items(), strict=True):
        first = cases[0]
        accumulated = "" if first.text("taa") == "off" else ", accumulated"
        coded = "" if first.text("codec") == "none" else ", coded"
        axes.set_title(f"{scene}, {first.text('scenario')}{accumulated}{coded}, {first.text('display')}", fontsize=9)
        labels.append(panel(axes, cases))
    drawing.draw_without_rendering()
    drawing.set_layout_engine("none")
    for axes, labels_here in zip(all_axes, labels, strict=True):
        axes.set(xlim=axes.get_xlim(), ylim=axes.get_ylim())
        place_labels(axes, labels_here)
    drawing.savefig(path, format="svg", metadata={"Date": None, "Creator": None})
    return [path.name]


def _family(case: Case) -> str:
    sampler = case.text("method").partition(":")[0]
    return "mesh" if sampler.startswith("mesh-") else sampler


def _label(case: Case) -> str:
    taa = case.text("taa")
    return method_label(case.text("method"), taa if taa == "paper" else "")


def _points(axes: Axes, cases: list[Case], x: Figure, y: Figure) -> list[Label]:
    """Draws means with standard errors; their labels."""
    labels = []
    for case in cases:
        (x_mean, x_error), (y_mean, y_error) = _mean_and_error(case, x), _mean_and_error(case, y)
        color = _FAMILIES[_family(case)]
        axes.errorbar(
            x_mean, y_mean, xerr=x_error, yerr=y_error, fmt="o", color=color, markersize=4.5, elinewidth=0.8,
            capsize=1.5,
        )  # fmt: skip
        labels.append(Label(x_mean, y_mean, _label(case), color, x_error, y_error))
    axes.set_xlabel(x.title)
    axes.set_ylabel(y.title)
    axes.margins(x=0.16, y=0.14)
    return labels


def _mean_and_error(case: Case, figure: Figure) -> tuple[float, float]:
    """As they are shown; an error that is not known is 0."""
    error = case.standard_error(figure.column)
    return case.mean(figure.column) * figure.scale, 0.0 if math.isnan(error) else error * figure.scale


def _logarithmic(axis: Axis) -> None:
    axis.axes.set(**{f"{axis.axis_name}scale": "log"})
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=30))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def _accuracy(figure: Figure) -> Callable[[Axes, list[Case]], list[Label]]:
    """Time against one figure, with the Pareto front as steps."""

    def panel(axes: Axes, cases: list[Case]) -> list[Label]:
        _logarithmic(axes.xaxis)
        if figure is columns.FLICKER:
            _logarithmic(axes.yaxis)
            none = [_label(case) for case in cases if case.mean(figure.column) == 0]
            cases = [case for case in cases if case.mean(figure.column) > 0]
            if none:
                axes.text(0.02, 0.02, f"none: {', '.join(none)}", transform=axes.transAxes, fontsize=7.5)
        times = [case.mean(columns.TIME.column) for case in cases]
        values = [case.mean(figure.column) * figure.scale for case in cases]
        front = pareto_front(times, values, figure.higher_is_better)
        axes.step(
            [times[i] for i in front], [values[i] for i in front], where="post", color="#999999", linewidth=1.1,
            zorder=1,
        )  # fmt: skip
        return _points(axes, cases, columns.TIME, figure)

    return panel


def _share(axes: Axes, cases: list[Case]) -> list[Label]:
    """Accuracy at equal samples; methods that differ in their share alone are joined."""
    groups: dict[tuple[str, str], list[Case]] = {}
    for case in cases:
        sampling, _, fill = case.text("method").partition("/")
        sampler, _, preset = sampling.partition(":")
        groups.setdefault((f"{sampler}:paper" if preset.startswith("paper") else sampler, fill), []).append(case)
    for group in groups.values():
        line = sorted((case.mean("traced_share") * 100, case.mean("psnr_db")) for case in group)
        axes.plot(*zip(*line, strict=True), color=_FAMILIES[_family(group[0])], linewidth=0.7, alpha=0.6, zorder=1)
    return _points(axes, cases, columns.TRACED, columns.PSNR)


def _rings(axes: Axes, cases: list[Case]) -> list[Label]:
    """Flicker by angle from the gaze. On a logarithmic axis there is no room for 0, nor for errors near
    their mean."""
    for index, case in enumerate(cases):
        values = [case.mean(column) * columns.FLICKER.scale for column in columns.RINGS]
        errors = [case.standard_error(column) * columns.FLICKER.scale for column in columns.RINGS]
        shown = [ring for ring, value in enumerate(values) if value > 0]
        axes.errorbar(
            shown, [values[ring] for ring in shown],
            yerr=[errors[ring] if errors[ring] < 0.5 * values[ring] else 0.0 for ring in shown],
            label=_label(case) + ("" if shown else ": none"), color=_shade(cases, case),
            marker=_RING_MARKERS[index % len(_RING_MARKERS)], markersize=4.5, linewidth=1.1, elinewidth=0.8,
            capsize=1.5,
        )  # fmt: skip
    _logarithmic(axes.yaxis)
    axes.set_xlim(-0.3, len(columns.RINGS) - 0.7)
    axes.set_xticks(range(len(columns.RINGS)), columns.RINGS.values())
    axes.set_xlabel("angle from the gaze")
    axes.set_ylabel(columns.FLICKER.title)
    axes.legend(fontsize=7.5, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=3)
    return []


def _shade(cases: list[Case], case: Case) -> tuple[float, float, float]:
    """The family's colour, paler for each further case of the family."""
    family = [other for other in cases if _family(other) == _family(case)]
    pale = 0.65 * family.index(case) / max(len(family) - 1, 1)
    red, green, blue = matplotlib.colors.to_rgb(_FAMILIES[_family(case)])
    return (red + (1 - red) * pale, green + (1 - green) * pale, blue + (1 - blue) * pale)


def _stages(axes: Axes, cases: list[Case]) -> list[Label]:
    """Where the time of a stereo frame goes: p50 of each stage, mean of the repeats; of cases that have times."""
    cases = [case for case in cases if not math.isnan(case.mean("trace_p50_ms"))]
    left = [0.0] * len(cases)
    for stage, color in zip(columns.STAGES, _STAGE_COLORS, strict=True):
        widths = [case.mean(f"{stage}_p50_ms") for case in cases]
        if max(widths) == 0:
            continue
        axes.barh(range(len(cases)), widths, left=left, color=color, label=stage, height=0.72)
        left = [start + width for start, width in zip(left, widths, strict=True)]
    axes.set_yticks(range(len(cases)), [_label(case) for case in cases], fontsize=7.5)
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.set_xlabel("stereo frame, p50 of each stage, ms")
    axes.legend(fontsize=7.5, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4)
    return []
