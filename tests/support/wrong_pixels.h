#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace macula::test {

/// Pixels of a picture that are not as a closed form says, of those that were compared. As a figure it is printed and
/// becomes a property of the running test.
struct WrongPixels {
    int wrong = 0;
    int compared = 0;

    void count(bool is_wrong) {
        wrong += is_wrong ? 1 : 0;
        ++compared;
    }
    void report(const std::string& what) const {
        std::printf("[  FIGURE  ] %s: %d of %d pixels wrong\n", what.c_str(), wrong, compared);
        testing::Test::RecordProperty(what, std::to_string(wrong) + " of " + std::to_string(compared));
    }
};

}  // namespace macula::test
