"""The arithmetic of the chart: repeats, the Pareto front, tables, bounds; and that charts are the same bytes."""

from __future__ import annotations

import math
import tempfile
import unittest
from pathlib import Path

import rows
from bounds import Bound, check, quick_bounds
from charts import draw_all
from columns import method_label
from measured import Case, Measured, cases_of, read_rows, settings_of, write_rows
from pareto import pareto_front
from summary import summary


def measured(name: str, **cells: float | str) -> Measured:
    scene, scenario, method, *settings = name.split(" ")
    usual = {"taa": "macula", "codec": "h264", "display": "vive/2", "frames": "24", "warm": "24", "seed": "1"}
    given = dict(setting.split("=") for setting in settings)
    fixed = {"name": name, "scene": scene, "scenario": scenario, "method": method, "latency": "0", "without": ""}
    return Measured({**fixed, **usual, **given, **{column: str(cell) for column, cell in cells.items()}})


class Repeats(unittest.TestCase):
    def test_rows_that_differ_in_seed_alone_are_one_case(self) -> None:
        names = ("a still m", "a still m seed=2", "a still m seed=12 latency=1", "a still m latency=1", "b still m")
        cases = cases_of([measured(name) for name in names])
        self.assertEqual([case.name for case in cases], ["a still m", "a still m latency=1", "b still m"])
        self.assertEqual([len(case.rows) for case in cases], [2, 2, 1])

    def test_mean_and_standard_error(self) -> None:
        case = Case(tuple(measured("a still m", psnr_db=value) for value in (2, 4, 9)))
        self.assertAlmostEqual(case.mean("psnr_db"), 5.0)
        # Deviations -3, -1, 4: variance 13, of the mean 13 / 3.
        self.assertAlmostEqual(case.standard_error("psnr_db"), math.sqrt(13 / 3))

    def test_one_repeat_has_no_standard_error(self) -> None:
        case = Case((measured("a still m", psnr_db=2),))
        self.assertEqual(case.mean("psnr_db"), 2.0)
        self.assertTrue(math.isnan(case.standard_error("psnr_db")))

    def test_empty_cells_and_missing_columns_do_not_count(self) -> None:
        case = Case((measured("a still m", jod=""), measured("a still m", jod=7.5)))
        self.assertEqual(case.mean("jod"), 7.5)
        self.assertTrue(math.isnan(case.standard_error("jod")))
        self.assertTrue(math.isnan(case.mean("flip")))

    def test_infinite_figures_have_no_standard_error(self) -> None:
        case = Case((measured("a still m", psnr_db="inf"), measured("a still m", psnr_db=30)))
        self.assertEqual(case.mean("psnr_db"), math.inf)
        self.assertTrue(math.isnan(case.standard_error("psnr_db")))


class ParetoFront(unittest.TestCase):
    def test_leaves_out_what_is_slower_and_no_better(self) -> None:
        times = [3.0, 1.0, 2.0, 4.0, 2.5]
        quality = [30.0, 20.0, 28.0, 29.0, 27.0]
        self.assertEqual(pareto_front(times, quality, higher_is_better=True), [1, 2, 0])

    def test_knows_which_way_is_better(self) -> None:
        times = [3.0, 1.0, 2.0, 4.0, 2.5]
        flicker = [3.0, 2.0, 2.8, 0.9, 2.7]
        self.assertEqual(pareto_front(times, flicker, higher_is_better=False), [1, 3])

    def test_of_equal_times_the_better_and_of_equal_points_one(self) -> None:
        self.assertEqual(pareto_front([1.0, 1.0, 1.0], [5.0, 7.0, 7.0], higher_is_better=True), [1])

    def test_nan_takes_no_part(self) -> None:
        self.assertEqual(pareto_front([1.0, 2.0], [math.nan, 3.0], higher_is_better=True), [1])
        self.assertEqual(pareto_front([], [], higher_is_better=True), [])

    def test_is_what_comparing_each_with_each_gives(self) -> None:
        times = [float(i * 37 % 50) for i in range(50)]
        quality = [float(i * i * 13 % 41) for i in range(50)]

        def beaten(i: int) -> bool:
            return any(
                times[j] <= times[i] and quality[j] >= quality[i] and (times[j], quality[j]) != (times[i], quality[i])
                for j in range(50)
            )

        front = pareto_front(times, quality, higher_is_better=True)
        self.assertEqual(sorted(front), [i for i in range(50) if not beaten(i)])


class Tables(unittest.TestCase):
    def test_rows_survive_their_file(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "rows.csv"
            written = [measured("a still m", psnr_db=30.25), measured("a still m seed=2")]
            write_rows(path, ["name", "method", "psnr_db"], [Measured(self.only(row)) for row in written])
            self.assertEqual(path.read_text(), "name,method,psnr_db\na still m,m,30.25\na still m seed=2,m,\n")
            read = read_rows(path)
            self.assertEqual(read[0].number("psnr_db"), 30.25)
            self.assertTrue(math.isnan(read[1].number("psnr_db")))
            self.assertEqual(read[1].case, "a still m")

    @staticmethod
    def only(row: Measured) -> dict[str, str]:
        return {column: row.text(column) for column in ("name", "method", "psnr_db") if row.text(column)}

    def test_settings_leave_method_and_seed_out(self) -> None:
        one, other = cases_of([measured("a still m seed=3"), measured("a still n taa=off")])
        self.assertNotEqual(settings_of(one), settings_of(other))
        self.assertEqual(settings_of(one, but=("taa",)), settings_of(other, but=("taa",)))

    def test_methods_are_named_by_what_tells_them_apart(self) -> None:
        self.assertEqual(method_label("tiles:27/tiles"), "tiles 27")
        self.assertEqual(method_label("tiles:27/push-pull"), "tiles 27 push-pull")
        self.assertEqual(method_label("mesh-16:27/table"), "mesh-16 27")
        self.assertEqual(method_label("mesh:paper-54/raster", "paper"), "mesh paper-54 raster, TAA paper")
        self.assertEqual(method_label("log-polar:27/bilinear"), "log-polar 27")


class Bounds(unittest.TestCase):
    def setUp(self) -> None:
        self.cases = cases_of([measured("a still m", psnr_db=30), measured("a still n", psnr_db=20)])

    def outcome(self, name: str, least: float) -> bool:
        bound = Bound("PSNR", "a reason", lambda cases: cases[name].mean("psnr_db"), "dB", least=least)
        return check([bound], self.cases)[0].holds

    def test_hold_at_their_limit_and_break_beyond(self) -> None:
        self.assertTrue(self.outcome("a still m", 30.0))
        self.assertFalse(self.outcome("a still n", 20.1))

    def test_a_row_that_is_not_there_breaks_its_bound(self) -> None:
        self.assertFalse(self.outcome("a still o", -math.inf))

    def test_a_figure_that_is_not_there_breaks_its_bound(self) -> None:
        bound = Bound("JOD", "a reason", lambda cases: cases["a still m"].mean("jod"), "", least=-math.inf)
        self.assertFalse(check([bound], self.cases)[0].holds)


class Plans(unittest.TestCase):
    def test_no_row_is_planned_twice(self) -> None:
        for plan in (rows.quick_rows(True), rows.full_rows(True)):
            names = [planned.name for planned in plan]
            self.assertEqual(len(names), len(set(names)))

    def test_without_recordings_nothing_else_changes(self) -> None:
        for plan in (rows.quick_rows, rows.full_rows):
            kept = [planned for planned in plan(True) if " recorded" not in planned.name]
            self.assertEqual(kept, plan(False))

    def test_bounds_ask_for_rows_of_the_quick_run_alone(self) -> None:
        figures = {column: 1.0 for column in ("psnr_db", "foveal_psnr_db", "flicker", "worst_flicker")}
        for recordings in (True, False):
            planned = [measured(row.name, **figures) for row in rows.quick_rows(recordings)]
            for outcome in check(quick_bounds(recordings), cases_of(planned)):
                self.assertFalse(math.isnan(outcome.figure), outcome.bound.name)


class Charts(unittest.TestCase):
    def setUp(self) -> None:
        def row(method: str, seed: int, time_ms: float, psnr_db: float) -> Measured:
            name = f"bunny-box still {method} taa=off codec=none display=vive/8 seed={seed}"
            stages = {"plan_p50_ms": 1, "trace_p50_ms": time_ms - 2, "reconstruct_p50_ms": 1, "encode_p50_ms": 0}
            rest = {"decode_p50_ms": 0, "accumulate_p50_ms": 2, "show_p50_ms": 1, "traced_share": 0.01 * time_ms}
            return measured(name, server_p50_ms=time_ms, psnr_db=psnr_db, **stages, **rest)

        methods = [f"{sampler}:{share}/{sampler}" for sampler in ("tiles", "mesh") for share in (54, 41, 27, 18)]
        self.rows = [
            row(method, seed, 10.0 + 3.0 * index, 25.0 + 0.7 * index + 0.1 * seed)
            for index, method in enumerate(m.replace("/mesh", "/table") for m in methods)
            for seed in (1, 2)
        ]

    def test_are_the_same_bytes_for_the_same_rows(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            drawn = [draw_all(cases_of(self.rows), Path(folder) / run) for run in ("a", "b")]
            self.assertIn("time-psnr-db-still.svg", drawn[0])
            self.assertEqual(drawn[0], drawn[1])
            for name in drawn[0]:
                first, second = ((Path(folder) / run / name).read_bytes() for run in ("a", "b"))
                self.assertEqual(first, second, name)
                self.assertLess(len(first), 150_000, name)

    def test_summary_names_every_case_and_what_it_went_without(self) -> None:
        text = summary("A run", ["Without FLIP."], [], cases_of(self.rows), ["time-psnr-db-still.svg"])
        self.assertIn("- Without FLIP.", text)
        self.assertIn("(time-psnr-db-still.svg)", text)
        for case in cases_of(self.rows):
            self.assertIn(f"`{case.name}`", text)


if __name__ == "__main__":
    unittest.main()
