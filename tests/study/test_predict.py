"""What is summed up and compared, against cases worked by hand."""

import unittest
from dataclasses import dataclass

from prediction import Scores, agrees, mean_visibility, order

try:
    import numpy as np
except ImportError as error:
    np = None
    MISSING = str(error)
else:
    MISSING = ""


class Prediction(unittest.TestCase):
    SCHEDULES = [[(20.0, "full", "54"), (25.0, "54", "18"), (30.0, "18", "54")], [(20.0, "full", "18")]]

    def scores(self):
        states = [
            {"full": {"rms": 1.0}, "54": {"rms": 2.0}, "18": {"rms": 5.0}},
            {"full": {"rms": 1.0}, "54": {"rms": 4.0}, "18": {"rms": 9.0}},
        ]
        pairs = (("full", "54"), ("54", "18"), ("18", "54"), ("full", "18"))
        changes = [{pair: {"rms": 10.0 * (1 + i) + place} for i, pair in enumerate(pairs)} for place in (0, 1)]
        return Scores(states, changes)

    def test_by_hand(self):
        # Changes take turns at the two places: the first and third of the first schedule, and that of the second, at
        # the first.
        scores = self.scores()
        mean = {kind: mean_visibility(scores, self.SCHEDULES, kind, "rms") for kind in ("change", "worse", "state")}
        self.assertEqual(mean["change"], {"54": (10.0 + 30.0) / 2, "18": (21.0 + 40.0) / 2})
        self.assertEqual(mean["worse"], {"54": (1.0 + 0.0) / 2, "18": (5.0 + 4.0) / 2})
        self.assertEqual(mean["state"], {"54": 2.0, "18": (9.0 + 5.0) / 2})

    def test_agreement_is_that_of_groups(self):
        self.assertTrue(agrees({"54": 2.0, "41": 1.0, "27": 4.0, "18": 3.0}))
        self.assertFalse(agrees({"54": 1.0, "41": 3.0, "27": 3.0, "18": 4.0}))
        self.assertEqual(order({"54": 2.0, "41": 1.0, "27": 4.0, "18": 3.0}), ["41", "54", "18", "27"])


@dataclass
class FakeClip:
    test: object
    reference: object
    gaze_px: object


@unittest.skipIf(np is None, f"no NumPy: {MISSING}")
class Visibility(unittest.TestCase):
    def setUp(self):
        from visibility import Place

        # Two rows of two pixels, the second row hidden. "a" is still, "b" brighter by 51 of 255 and in every second
        # frame by 102.
        reference = np.zeros((1, 2, 2, 3), np.uint8)
        reference[:, 0] = 100
        still = np.repeat(reference, 4, axis=0)
        flickers = still.copy()
        flickers[0::2, 0] += 51
        flickers[1::2, 0] += 102
        self.seen = []

        def judge(clip):
            self.seen.append(clip)
            return {"jod": 7.5, "flip": 0.25}

        gaze = np.zeros((4, 2))
        clips = {"a": FakeClip(still, reference, gaze), "b": FakeClip(flickers, reference, gaze)}
        self.place = Place(clips, [judge])

    def test_states(self):
        still = self.place.state("a")
        self.assertEqual(still, {"rms": 0.0, "flicker": 0.0, "jod": 2.5, "flip": 0.25})
        flickers = self.place.state("b")
        self.assertAlmostEqual(flickers["rms"], 1000 * (0.5 * (0.2**2 + 0.4**2)) ** 0.5, places=3)
        self.assertAlmostEqual(flickers["flicker"], 200.0, places=3)

    def test_a_change_is_compared_with_none(self):
        change = self.place.change("a", "b")
        self.assertAlmostEqual(change["rms"], 1000 * (0.5 * (0.2**2 + 0.4**2)) ** 0.5, places=3)
        self.assertAlmostEqual(change["flicker"], 200.0, places=3)
        self.assertEqual(change["jod"], 2.5)
        judged = self.seen[-1]
        self.assertEqual(judged.test[:, 0, 0, 0].tolist(), [100, 100, 151, 202])
        self.assertEqual(judged.reference[:, 0, 0, 0].tolist(), [100] * 4)


if __name__ == "__main__":
    unittest.main()
