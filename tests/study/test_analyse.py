"""Detection and ranking against cases worked by hand, and observers whose probabilities are known."""

import os
import random
import tempfile
import unittest
from pathlib import Path

from analyse import report, standard_error
from detection import Event, Session, Window, judge, observer_of, rate, rates, read_events
from ranking import probability_worse, range_probability, range_quantile, rank_masks, ranks
from schedule import make_schedule

MASKS = ["54", "41", "27", "18"]


def events(changes, keys, end_s=180.0):
    rows = [Event(0.0, "shown", "", "full", "room")]
    rows += [Event(at_s, "shown", before, after, "room") for at_s, before, after in changes]
    rows += [Event(at_s, "key", "", "", "room") for at_s in keys]
    rows.append(Event(end_s, "end", "", "", "room"))
    return sorted(rows, key=lambda event: event.time_s)


class Detection(unittest.TestCase):
    CHANGES = [(20.0, "full", "54"), (25.0, "54", "18"), (30.0, "18", "54"), (31.0, "54", "27")]

    def test_by_hand(self):
        # 20.19 is too early to be an answer, 25.2 and 25.9 answer the second change, 31.1 can only answer the third,
        # 33.6 comes too late for the last one, 5 before all.
        session = judge(events(self.CHANGES, [5.0, 20.19, 25.2, 25.9, 31.1, 33.6], 40.0), "anna")
        self.assertEqual([change.after for change in session.changes], ["54", "18", "54", "27"])
        reactions = [change.reaction_s for change in session.changes]
        self.assertEqual([reaction is not None for reaction in reactions], [False, True, True, False])
        self.assertAlmostEqual(reactions[1], 0.2)
        self.assertAlmostEqual(reactions[2], 1.1)
        self.assertEqual((session.false_alarms, session.repeats, session.left_out), (3, 1, 0))
        # Windows: 2.3 s each, but 1 s of the third.
        self.assertAlmostEqual(session.idle_s, 40.0 - 3 * 2.3 - 1.0)
        self.assertEqual(rates([session]), {"54": {"anna": 0.0}, "18": {"anna": 1.0}, "27": {"anna": -1.0}})

    def test_a_change_without_its_whole_window_does_not_count(self):
        session = judge(events([(20.0, "full", "54"), (25.0, "54", "18")], [26.0], 27.0), "anna")
        self.assertEqual([change.after for change in session.changes], ["54"])
        self.assertEqual((session.left_out, session.false_alarms), (1, 0))

    def test_rates_are_the_papers(self):
        for noticed, expected in ((8, 1.0), (4, 0.0), (0, -1.0), (6, 0.5)):
            changes = [(20.0 + 5 * i, "full", "54") for i in range(8)]
            session = judge(events(changes, [at_s + 1.0 for at_s, _, _ in changes[:noticed]]), "anna")
            self.assertEqual(rate(session.changes), expected)

    def test_tables_are_read_as_the_client_writes_them(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "anna.room.csv"
            path.write_text(
                "time_s,event,from,to,scene\n0.0000,shown,,full,room\n20.1000,shown,full,mesh:paper-18/raster,room\n"
                "21.0000,key,mesh:paper-18/raster,,room\n30.0000,end,mesh:paper-18/raster,,room\n"
            )
            self.assertEqual(observer_of(path), "anna")
            session = judge(read_events(path), "anna")
            self.assertEqual(session.scene, "room")
            self.assertEqual([change.after for change in session.changes], ["mesh:paper-18/raster"])
            self.assertAlmostEqual(session.changes[0].reaction_s, 0.9)
            path.write_text("frame,track\n1,2\n")
            with self.assertRaises(ValueError):
                read_events(path)


class RankingOfMasks(unittest.TestCase):
    def test_studentised_range_is_that_of_tables(self):
        # Infinitely many degrees of freedom (Harter 1960).
        for alpha, count, expected in (
            (0.05, 2, 2.772), (0.05, 3, 3.314), (0.05, 4, 3.633), (0.05, 5, 3.858), (0.01, 4, 4.403), (0.01, 10, 5.157),
        ):  # fmt: skip
            self.assertAlmostEqual(range_quantile(1.0 - alpha, count), expected, places=3)
        self.assertAlmostEqual(range_probability(12.0, 3), 1.0, places=9)

    def test_ranks(self):
        self.assertEqual(ranks([0.5, -1.0, 0.5, 1.0]), [2.5, 1.0, 2.5, 4.0])

    def test_probability(self):
        self.assertEqual(probability_worse([0.0, 0.0]), 0.5)
        self.assertEqual(probability_worse([0.25, 0.25]), 1.0)
        # Mean .5, deviation .5: Phi(1).
        self.assertAlmostEqual(probability_worse([0.0, 0.5, 1.0]), 0.841345, places=6)
        self.assertAlmostEqual(probability_worse([-0.5, 0.5]), 0.5)

    def test_by_hand(self):
        # Six observers of one mind: mean ranks 1, 2, 3, 4, and a critical difference of 2.569 sqrt(20/36) = 1.915
        # (Demsar 2006, table 5a has q = 2.569 for four).
        rates_by_mask = {
            mask: {f"o{i}": value + 0.01 * i for i in range(6)}
            for mask, value in (("27", 0.4), ("54", -0.8), ("18", 0.6), ("41", -0.7))
        }
        rates_by_mask["54"]["without the others"] = 1.0
        ranking = rank_masks(rates_by_mask)
        self.assertEqual(ranking.order, ["54", "41", "27", "18"])
        self.assertEqual(len(ranking.observers), 6)
        self.assertAlmostEqual(ranking.critical_difference, 2.569 * (20 / 36) ** 0.5, places=3)
        significant = {(pair.left, pair.right): pair.significant for pair in ranking.pairs}
        self.assertEqual(
            significant,
            {("54", "41"): False, ("54", "27"): True, ("54", "18"): True, ("41", "27"): False, ("41", "18"): True,
             ("27", "18"): False},
        )  # fmt: skip
        for pair in ranking.pairs:
            self.assertEqual(pair.significant, pair.p_value < 0.05)
            self.assertEqual(pair.worse, 6)
            self.assertEqual(pair.probability, 1.0)

    def test_too_few(self):
        self.assertIsNone(rank_masks({}))
        self.assertIsNone(rank_masks({"54": {"anna": 0.0}, "18": {"anna": 1.0}}))
        self.assertIsNone(rank_masks({"54": {"anna": 0.0}, "18": {"bert": 1.0}}))


class SimulatedObservers(unittest.TestCase):
    """Observers who notice each mask with a known probability, react within .4 to 1.6 s, and press at random times."""

    PROBABILITY = {"54": 0.15, "41": 0.25, "27": 0.7, "18": 0.85}
    ALARMS_PER_S = 0.01

    def setUp(self):
        self.seed = int(os.environ.get("MACULA_SEED", random.randrange(1 << 32)))
        print(f"MACULA_SEED={self.seed}")
        self.random = random.Random(self.seed)

    def observe(self, observer, seed, length_s):
        changes = make_schedule(MASKS, seed=seed, length_s=length_s)
        keys = []
        for at_s, _, after in changes:
            if self.random.random() < self.PROBABILITY[after]:
                keys.append(at_s + self.random.uniform(0.4, 1.6))
        at_s = self.random.expovariate(self.ALARMS_PER_S)
        while at_s < length_s:
            keys.append(at_s)
            at_s += self.random.expovariate(self.ALARMS_PER_S)
        return judge(events(changes, keys, length_s), observer)

    def test_rates_come_out(self):
        sessions = [self.observe(f"o{i}", self.seed + i, 20_000.0) for i in range(4)]
        by_mask = rates(sessions)
        chance = 1.0 - 2.718281828 ** (-self.ALARMS_PER_S * 2.3)
        for mask, probability in self.PROBABILITY.items():
            noticed = probability + (1.0 - probability) * chance
            values = list(by_mask[mask].values())
            count = sum(len([c for c in session.changes if c.after == mask]) for session in sessions)
            deviation = 2.0 * (noticed * (1.0 - noticed) / count) ** 0.5
            self.assertAlmostEqual(sum(values) / 4, 2.0 * noticed - 1.0, delta=6.0 * deviation)
            # The spread of observers who do not differ is that of chance.
            self.assertLess(standard_error(values), 5.0 * deviation)
        idle_s = sum(session.idle_s for session in sessions)
        alarms = sum(session.false_alarms for session in sessions)
        self.assertAlmostEqual(alarms / idle_s, self.ALARMS_PER_S, delta=6.0 * (self.ALARMS_PER_S / idle_s) ** 0.5)
        ranking = rank_masks(by_mask)
        self.assertEqual(ranking.order, MASKS)

    def test_a_report_of_the_papers_size(self):
        sessions = [self.observe(f"o{i}", 1 + i, 180.0) for i in range(6)]  # schedules that hold every mask
        text = report(sessions, Window(), 0.05)
        for mask in MASKS:
            self.assertIn(f"| `{mask}` |", text)
        self.assertIn("6 observers", text)
        self.assertIsInstance(sessions[0], Session)


class Plots(unittest.TestCase):
    def test_the_figure_is_drawn(self):
        try:
            from plots import draw
        except ImportError as error:
            self.skipTest(f"no matplotlib: {error}")
        changes = make_schedule(MASKS, seed=2)
        sessions = [judge(events(changes, [c[0] + 1.0 for c in changes[::i]]), f"o{i}") for i in (1, 2, 3)]
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "figure.svg"
            draw(sessions, rank_masks(rates(sessions)), path)
            self.assertIn("<svg", path.read_text())


if __name__ == "__main__":
    unittest.main()
