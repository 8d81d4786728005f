"""Pairs of rows, and what they say of a model."""

import math
import unittest

import ablation
from effects import WATCHED, Pair, change_of
from measured import Measured


def row(scene: str, model: str, seed: int, **figures: float) -> Measured:
    cells = {"name": f"{scene} pan seed={seed} {model}", "scene": scene, "scenario": "pan", "without": model}
    return Measured(cells | {"seed": str(seed)} | {column: f"{figure!r}" for column, figure in figures.items()})


def watched(column: str):
    return next(each for each in WATCHED if each.figure.column == column)


class ChangeTest(unittest.TestCase):
    def pairs(self, column: str, on: list[float], off: list[float]) -> list[Pair]:
        return [
            Pair(row("box", "", seed, **{column: a}), row("box", "hysteresis", seed, **{column: b}))
            for seed, (a, b) in enumerate(zip(on, off, strict=True))
        ]

    def test_of_quality_is_a_difference(self):
        change = change_of(watched("psnr_db"), self.pairs("psnr_db", [30.0, 31.0, 32.0], [29.0, 30.5, 31.5]))
        self.assertAlmostEqual(change.mean, -2.0 / 3.0)
        self.assertAlmostEqual(change.error, 1.0 / 6.0)  # deviation .2887 over the root of 3
        self.assertFalse(change.counts)  # 4 times its error; three pairs ask for 4.3
        self.assertEqual(change.text, "-0.67 ± 0.17")
        change = change_of(watched("psnr_db"), self.pairs("psnr_db", [30.0, 31.0, 32.0], [29.0, 30.1, 31.0]))
        self.assertTrue(change.counts)
        self.assertEqual(change.text, "**-0.97 ± 0.03**")

    def test_of_times_is_in_percent(self):
        change = change_of(watched("server_p50_ms"), self.pairs("server_p50_ms", [10.0, 20.0], [11.0, 22.0]))
        self.assertAlmostEqual(change.mean, 10.0)
        self.assertAlmostEqual(change.error, 0.0)

    def test_does_not_count_if_it_is_small_or_uncertain(self):
        self.assertFalse(change_of(watched("psnr_db"), self.pairs("psnr_db", [30.0, 31.0], [30.05, 31.05])).counts)
        self.assertFalse(change_of(watched("psnr_db"), self.pairs("psnr_db", [30.0, 31.0], [29.0, 32.1])).counts)

    def test_of_a_single_pair_is_never_certain(self):
        self.assertFalse(change_of(watched("psnr_db"), self.pairs("psnr_db", [30.0], [20.0])).counts)

    def test_leaves_out_what_is_not_there(self):
        pairs = self.pairs("flicker", [0.01, math.inf, 0.0], [0.02, 0.01, 0.01])
        change = change_of(watched("flicker"), pairs)
        self.assertAlmostEqual(change.mean, 100.0)
        self.assertTrue(math.isnan(change.error))
        self.assertEqual(change_of(watched("jod"), pairs).text, "")


class ReportTest(unittest.TestCase):
    def rows(self) -> list[Measured]:
        rows = []
        for seed in (1, 2, 3):
            on = {"server_p50_ms": 10.0 + seed, "psnr_db": 30.0 + seed, "accumulate_p50_ms": 5.0}
            rows += [row("box", "", seed, **on), row("box", "hysteresis", seed, **on)]
            off = on | {"psnr_db": 27.0 + seed}
            rows += [row("box", "", seed, **on), row("box", "eccentricity-weight", seed, **off)]
        return rows

    def test_names_what_moves_and_what_does_not(self):
        text = ablation.report(self.rows(), ["a run"])
        self.assertIn("| hysteresis | **none of 11** | |", text)
        self.assertIn("| eccentricity-weight | 1 of 11 | PSNR, dB: -3.00 ± 0.00 (box, pan) |", text)

    def test_shows_the_time_of_the_program_that_a_model_is_in(self):
        text = ablation.report(self.rows(), [])
        self.assertIn("| hysteresis | pan | +0.0 ± 0.0 |  | +0.00 ± 0.00 |", text)
        self.assertIn("| eccentricity-weight | pan |  | +0.0 ± 0.0 | **-3.00 ± 0.00** |", text)

    def test_refuses_halves_that_do_not_belong_together(self):
        with self.assertRaises(ValueError):
            ablation.pairs_of(self.rows()[1:])

    def test_names_of_rows_alternate(self):
        names = ablation.names_of("box", "pan", "tiles:27 display=vive/8", ("hysteresis", "eccentricity-weight"), 2)
        self.assertEqual(names[0], names[2])
        self.assertEqual(names[0], "box pan tiles:27 display=vive/8 seed=2")
        self.assertEqual(names[3], "box pan tiles:27 display=vive/8 seed=2 without=eccentricity-weight")


if __name__ == "__main__":
    unittest.main()
