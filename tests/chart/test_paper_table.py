"""The paper's table and the lines through it."""

import unittest

import paper_table
from line_fit import fit_line
from measured import Measured
from published import PERCENTS, TABLE_1


class LineFitTest(unittest.TestCase):
    def test_of_points_on_a_line_is_that_line(self):
        fit = fit_line([0.2, 0.5, 1.0], [3.0 + 7.0 * x for x in (0.2, 0.5, 1.0)])
        self.assertAlmostEqual(fit.fixed, 3.0)
        self.assertAlmostEqual(fit.slope, 7.0)
        self.assertAlmostEqual(fit.rms, 0.0)
        self.assertAlmostEqual(fit.fixed_share, 0.3)

    def test_leaves_what_is_off_the_line(self):
        # Deviations 1, -2, 1 at equal distances change neither mean nor slope.
        fit = fit_line([0.0, 1.0, 2.0], [1.0, 0.0, 5.0])
        self.assertAlmostEqual(fit.slope, 2.0)
        self.assertAlmostEqual(fit.fixed, 0.0)
        self.assertAlmostEqual(fit.rms, 2.0**0.5)

    def test_needs_two_places(self):
        with self.assertRaises(ValueError):
            fit_line([1.0, 1.0], [1.0, 2.0])


class PublishedTest(unittest.TestCase):
    """Against fits that were made by others from the same table."""

    def test_lines_with_swapped_rows(self):
        for table, fixed, slope in zip(TABLE_1, (6.5, 7.0), (42.3, 58.3), strict=True):
            fit = table.swapped().fit()
            self.assertAlmostEqual(fit.fixed, fixed, delta=0.05)
            self.assertAlmostEqual(fit.slope, slope, delta=0.05)

    def test_what_lies_off_the_lines(self):
        for table, printed, swapped in zip(TABLE_1, (2.9, 4.9), (0.9, 0.9), strict=True):
            self.assertAlmostEqual(table.fit().rms, printed, delta=0.05)
            self.assertAlmostEqual(table.swapped().fit().rms, swapped, delta=0.05)

    def test_speed_ups_are_those_of_the_times(self):
        for table in TABLE_1:
            for percent in PERCENTS:
                self.assertAlmostEqual(table.ms[100] / table.ms[percent], table.speed_up[percent], delta=0.06)

    def test_only_the_printed_order_is_faster_than_it_has_rays_to_save(self):
        for table in TABLE_1:
            self.assertGreater(table.speed_up[54], 1 / 0.54)
            for percent in PERCENTS:
                self.assertLessEqual(table.swapped().speed_up[percent], 100 / percent)


def row(name: str, ms: float, share: float) -> Measured:
    scene, _, method, *settings = name.split()
    without = next((s.partition("=")[2] for s in settings if s.startswith("without=")), "")
    cells = {"name": name, "scene": scene, "method": method, "without": without}
    return Measured(cells | {"server_p50_ms": f"{ms}", "traced_share": f"{share}"})


class ReportTest(unittest.TestCase):
    def test_finds_the_cost_that_the_rows_have(self):
        rows = []
        for number, name in enumerate(paper_table.names_of("bunny-box", "vive/4", 3)):
            percent = "100" if ":full/" in name else name.partition("/")[0].rpartition(":")[2].removeprefix("paper-")
            share = int(percent) / 100 * (1.0 if "without" in name else 0.8)
            rows.append(row(name, 5.0 + 40.0 * share * (1 + number % 2 * 1e-9), share))
        text = paper_table.report(rows)
        self.assertIn("## Bunny Box", text)
        self.assertNotIn("## Air Shed", text)
        fits = [line for line in text.splitlines() if line.startswith(("| paper's masks", "| tiles |"))]
        self.assertEqual(len(fits), 3)
        for line in fits:
            self.assertIn("| 5.0 ± 0.0 | 40.0 ± 0.0 | 0.00 ± 0.00 |", line)
        whole = next(line for line in text.splitlines() if line.startswith("| 18 | 5.56 |"))
        self.assertIn("| 3.69 ± 0.00 |", whole)  # (5 + 40) / (5 + 40 * .18)

    def test_rows_of_a_round_are_measured_once(self):
        names = paper_table.names_of("air-shed", "vive", 2)
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(len(names), 2 * (5 + 4 + 5))


if __name__ == "__main__":
    unittest.main()
