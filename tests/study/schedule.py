"""The schedule of the detection experiment, the same as client/study/schedule.cpp makes from the same seed."""


class SplitMix64:
    """Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014."""

    MASK = (1 << 64) - 1

    def __init__(self, seed):
        self.state = seed & self.MASK

    def next(self):
        """In [0, 1): the upper 53 bits."""
        self.state = (self.state + 0x9E3779B97F4A7C15) & self.MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & self.MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & self.MASK
        return ((z ^ (z >> 31)) >> 11) / 2.0**53


def make_schedule(masks, reference="full", begin_s=20.0, interval_s=5.0, spread_s=2.0, length_s=180.0, seed=1):
    """Changes as (seconds since the reference was first shown, mask before, mask after)."""
    random = SplitMix64(seed)
    changes = []
    shown = reference
    at_s = begin_s
    while at_s < length_s:
        others = [mask for mask in masks if mask != shown]
        drawn = random.next()
        if not others:
            break
        mask = others[int(drawn * len(others))]
        changes.append((at_s, shown, mask))
        shown = mask
        at_s += interval_s + spread_s * (2.0 * random.next() - 1.0)
    return changes
