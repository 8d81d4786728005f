#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/base/error.h"

namespace macula {

/// The detection experiment of Siekawa et al. 2019, section 4: a reference first, then masks that replace one another
/// at random times, and an observer who presses a key whenever the picture changes. What the paper leaves open, and
/// what was decided, is in tests/study/README.md.
struct StudySettings {
    /// Methods (server/METHODS.md); the published masks unless told otherwise.
    std::string reference = "full";
    std::vector<std::string> masks = {"mesh:paper-54/raster", "mesh:paper-41/raster", "mesh:paper-27/raster",
                                      "mesh:paper-18/raster"};
    double begin_s = 20.0;    ///< how long the reference is shown
    double interval_s = 5.0;  ///< between changes, on average
    double spread_s = 2.0;    ///< intervals are even in interval_s - spread_s .. interval_s + spread_s
    double length_s = 180.0;  ///< of the whole session
    std::uint64_t seed = 1;
};

/// Errors: `option`, naming what is wrong: masks that are fewer than one or not different, the reference as the only
/// mask, times that are not above 0, a spread that is not less than the interval.
Expected<void> check_study(const StudySettings& settings);

/// One mask replaces the other.
struct MaskChange {
    double at_s = 0.0;     ///< since the reference was first shown
    std::size_t mask = 0;  ///< index into StudySettings::masks: what is shown from now on
};

/// When which mask is shown: from begin_s on, until length_s. Each is drawn evenly from all masks but the one that it
/// would replace. The same settings give the same schedule on every machine: random numbers are those of SplitMix64
/// (Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, OOPSLA 2014), whose upper 53 bits are the
/// fraction of 1; for each change the mask is drawn first, then the interval after it. The settings are good.
std::vector<MaskChange> make_schedule(const StudySettings& settings);

}  // namespace macula
