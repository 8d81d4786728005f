"""The schedule is the client's, and is what the paper describes."""

import unittest

from schedule import SplitMix64, make_schedule

MASKS = ["54", "41", "27", "18"]


class Schedule(unittest.TestCase):
    def test_random_numbers_are_the_published_ones(self):
        # The first outputs for this seed, as other implementations of SplitMix64 have them.
        random = SplitMix64(1234567)
        for expected in (6457827717110365317, 3203168211198807973, 9817491932198370423):
            self.assertEqual(random.next(), (expected >> 11) / 2.0**53)

    def test_it_is_the_same_everywhere(self):
        # The same table stands in tests/unit/study_test.cpp.
        expected = [(20.0, 1), (23.067153, 3), (28.398874, 1), (32.396600, 2), (36.708907, 0), (41.361473, 1)]
        schedule = make_schedule(MASKS, length_s=45.0, seed=7)
        self.assertEqual([MASKS.index(after) for _, _, after in schedule], [mask for _, mask in expected])
        for (at_s, _, _), (expected_s, _) in zip(schedule, expected):
            self.assertAlmostEqual(at_s, expected_s, places=6)

    def test_each_change_begins_where_the_one_before_ended(self):
        schedule = make_schedule(MASKS, seed=3)
        self.assertEqual(schedule[0][:2], (20.0, "full"))
        for before, after in zip(schedule, schedule[1:]):
            self.assertEqual(before[2], after[1])
            self.assertNotEqual(after[1], after[2])
            self.assertTrue(3.0 <= after[0] - before[0] <= 7.0)
        self.assertLess(schedule[-1][0], 180.0)

    def test_a_single_mask_comes_once(self):
        self.assertEqual(make_schedule(["18"], seed=1), [(20.0, "full", "18")])


if __name__ == "__main__":
    unittest.main()
